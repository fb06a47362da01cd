// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/xmp_bands.h>

#include <osio/base/text.h>
#include <osio/spectra/wavelength_unit.h>

#include <pugixml.hpp>

namespace osio::tiff {

namespace {

/// An attribute or a child of that name; of a list in a child the first text.
std::string value_of(const pugi::xml_node& description, const char* name) {
    if (const pugi::xml_attribute attribute = description.attribute(name))
        return attribute.value();
    const pugi::xml_node child = description.child(name);
    const pugi::xml_node item = child.first_child().first_child();  // rdf:Seq, rdf:li
    return item ? item.child_value() : child.child_value();
}

double nm_value(const pugi::xml_node& description, const char* name) {
    return nm_of(value_of(description, name), "nm");
}

}  // namespace

XmpBand read_xmp_band(const std::string& packet) {
    XmpBand out;
    pugi::xml_document document;
    if (packet.empty() || !document.load_buffer(packet.data(), packet.size()))
        return out;
    for (const pugi::xml_node description :
         document.child("x:xmpmeta").child("rdf:RDF").children("rdf:Description")) {
        if (out.wavelength_nm == 0)
            out.wavelength_nm = nm_value(description, "Camera:CentralWavelength");
        if (out.fwhm_nm == 0)
            out.fwhm_nm = nm_value(description, "Camera:WavelengthFWHM");
        if (out.name.empty())
            out.name = trim(value_of(description, "Camera:BandName"));
    }
    return out;
}

}  // namespace osio::tiff
