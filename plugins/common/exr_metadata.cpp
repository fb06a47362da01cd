// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/exr_metadata.h>

#include <formats/exr/output_header.h>
#include <formats/image/colour_attributes.h>

#include <osio/base/text.h>

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfKeyCodeAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOpaqueAttribute.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTimeCodeAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace osio::plugin {

namespace {

using OIIO::TypeDesc;

/// Names that differ between OpenEXR and OIIO (OIIO's documentation, "OpenEXR").
struct Renamed {
    std::string_view exr;
    std::string_view oiio;
};

constexpr std::array<Renamed, 9> kRenamed{{
    {"capDate", "DateTime"},
    {"comments", "ImageDescription"},
    {"owner", "Copyright"},
    {"pixelAspectRatio", "PixelAspectRatio"},
    {"xDensity", "XResolution"},
    {"expTime", "ExposureTime"},
    {"aperture", "FNumber"},
    {"timeCode", "smpte:TimeCode"},
    {"keyCode", "smpte:KeyCode"},
}};

/// Names that OIIO writes in lower case.
constexpr std::array<std::string_view, 3> kMatrices{"worldToCamera", "worldToNDC", "worldToScreen"};

/// Metadata of OIIO that follows from something else in the file.
constexpr std::array<std::string_view, 6> kDerived{"YResolution",       "ResolutionUnit",
                                                   "planarconfig",      "textureformat",
                                                   "openexr:lineOrder", "openexr:roundingmode"};

/// Prefixes of metadata that belongs to other formats.
constexpr std::array<std::string_view, 20> kOtherFormats{
    "bmp", "cineon",  "dpx", "fits", "gif",  "heif", "hdr", "ico", "iff",  "jpeg",
    "jpg", "openexr", "png", "psd",  "ptex", "raw",  "rla", "sgi", "tiff", "webp"};

/// Attributes of a type unknown to OpenEXR travel as bytes under `prefix + type + "/" + name`.
constexpr std::string_view kOpaquePrefix = "exr:opaque/";

constexpr TypeDesc kV2i(TypeDesc::INT, TypeDesc::VEC2);
constexpr TypeDesc kV2f(TypeDesc::FLOAT, TypeDesc::VEC2);
constexpr TypeDesc kV2d(TypeDesc::DOUBLE, TypeDesc::VEC2);
constexpr TypeDesc kV3i(TypeDesc::INT, TypeDesc::VEC3, TypeDesc::VECTOR);
constexpr TypeDesc kV3f(TypeDesc::FLOAT, TypeDesc::VEC3, TypeDesc::VECTOR);
constexpr TypeDesc kV3d(TypeDesc::DOUBLE, TypeDesc::VEC3, TypeDesc::VECTOR);
constexpr TypeDesc kM33f(TypeDesc::FLOAT, TypeDesc::MATRIX33);
constexpr TypeDesc kM44f(TypeDesc::FLOAT, TypeDesc::MATRIX44);
constexpr TypeDesc kM33d(TypeDesc::DOUBLE, TypeDesc::MATRIX33);
constexpr TypeDesc kM44d(TypeDesc::DOUBLE, TypeDesc::MATRIX44);
constexpr TypeDesc kBox2i(TypeDesc::INT, TypeDesc::VEC2, 2);
constexpr TypeDesc kBox2f(TypeDesc::FLOAT, TypeDesc::VEC2, 2);
constexpr TypeDesc kChromaticities(TypeDesc::FLOAT, 8);

std::string oiio_name(std::string_view exr) {
    for (const Renamed& name : kRenamed)
        if (name.exr == exr)
            return std::string(name.oiio);
    return exr == "cameraTransform" ? "worldtocamera" : std::string(exr);
}

std::string exr_name(std::string_view oiio) {
    for (const Renamed& name : kRenamed)
        if (iequals(name.oiio, oiio))
            return std::string(name.exr);
    for (const std::string_view name : kMatrices)
        if (iequals(name, oiio))
            return std::string(name);
    return iequals(oiio, "description") ? "comments" : std::string(oiio);
}

/// Hands an attribute of type A to the spec as `type`, whose memory layout is the same.
template <class A>
bool add_plain(const Imf::Attribute& attribute, const std::string& name, TypeDesc type,
               OIIO::ImageSpec& spec) {
    const auto* typed = dynamic_cast<const A*>(&attribute);
    if (typed != nullptr)
        spec.attribute(name, type, &typed->value());
    return typed != nullptr;
}

template <class A>
const A* as(const Imf::Attribute& attribute) {
    return dynamic_cast<const A*>(&attribute);
}

bool add_lists(const Imf::Attribute& attribute, const std::string& name, OIIO::ImageSpec& spec) {
    if (const auto* text = as<Imf::StringAttribute>(attribute)) {
        spec.attribute(name, text->value());
        return true;
    }
    if (const auto* floats = as<Imf::FloatVectorAttribute>(attribute)) {
        if (!floats->value().empty())
            spec.attribute(name, TypeDesc(TypeDesc::FLOAT, static_cast<int>(floats->value().size())),
                           floats->value().data());
        return true;
    }
    if (const auto* texts = as<Imf::StringVectorAttribute>(attribute)) {
        std::vector<OIIO::ustring> strings(texts->value().begin(), texts->value().end());
        if (!strings.empty())
            spec.attribute(name, TypeDesc(TypeDesc::STRING, static_cast<int>(strings.size())),
                           strings.data());
        return true;
    }
    return false;
}

bool add_codes(const Imf::Attribute& attribute, const std::string& name, OIIO::ImageSpec& spec) {
    if (const auto* time = as<Imf::TimeCodeAttribute>(attribute)) {
        const std::array<unsigned, 2> code{time->value().timeAndFlags(Imf::TimeCode::TV60_PACKING),
                                           time->value().userData()};
        spec.attribute(name, OIIO::TypeTimeCode, code.data());
        return true;
    }
    if (const auto* key = as<Imf::KeyCodeAttribute>(attribute)) {
        const Imf::KeyCode& k = key->value();
        const std::array<int, 7> code{k.filmMfcCode(), k.filmType(),      k.prefix(),       k.count(),
                                      k.perfOffset(),  k.perfsPerFrame(), k.perfsPerCount()};
        spec.attribute(name, OIIO::TypeKeyCode, code.data());
        return true;
    }
    if (const auto* rational = as<Imf::RationalAttribute>(attribute)) {
        // OIIO's rational has a signed denominator.
        if (rational->value().d <= INT32_MAX) {
            const std::array<int, 2> value{rational->value().n, static_cast<int>(rational->value().d)};
            spec.attribute(name, OIIO::TypeRational, value.data());
        }
        return true;
    }
    if (const auto* map = as<Imf::EnvmapAttribute>(attribute)) {
        const bool cube = map->value() == Imf::ENVMAP_CUBE;
        spec.attribute("textureformat", cube ? "CubeFace Environment" : "LatLong Environment");
        return true;
    }
    return false;
}

void add_attribute(const std::string& exr, const Imf::Attribute& attribute, OIIO::ImageSpec& spec) {
    const std::string name = oiio_name(exr);
    const bool added = add_lists(attribute, name, spec) || add_codes(attribute, name, spec) ||
                       add_plain<Imf::IntAttribute>(attribute, name, TypeDesc::INT, spec) ||
                       add_plain<Imf::FloatAttribute>(attribute, name, TypeDesc::FLOAT, spec) ||
                       add_plain<Imf::DoubleAttribute>(attribute, name, TypeDesc::DOUBLE, spec) ||
                       add_plain<Imf::ChromaticitiesAttribute>(attribute, name, kChromaticities, spec) ||
                       add_plain<Imf::V2iAttribute>(attribute, name, kV2i, spec) ||
                       add_plain<Imf::V2fAttribute>(attribute, name, kV2f, spec) ||
                       add_plain<Imf::V2dAttribute>(attribute, name, kV2d, spec) ||
                       add_plain<Imf::V3iAttribute>(attribute, name, kV3i, spec) ||
                       add_plain<Imf::V3fAttribute>(attribute, name, kV3f, spec) ||
                       add_plain<Imf::V3dAttribute>(attribute, name, kV3d, spec) ||
                       add_plain<Imf::M33fAttribute>(attribute, name, kM33f, spec) ||
                       add_plain<Imf::M44fAttribute>(attribute, name, kM44f, spec) ||
                       add_plain<Imf::M33dAttribute>(attribute, name, kM33d, spec) ||
                       add_plain<Imf::M44dAttribute>(attribute, name, kM44d, spec) ||
                       add_plain<Imf::Box2iAttribute>(attribute, name, kBox2i, spec) ||
                       add_plain<Imf::Box2fAttribute>(attribute, name, kBox2f, spec);
    if (added)
        return;
    if (const auto* opaque = as<Imf::OpaqueAttribute>(attribute))
        spec.attribute(std::string(kOpaquePrefix) + attribute.typeName() + "/" + exr,
                       TypeDesc(TypeDesc::UINT8, opaque->dataSize()), &opaque->data()[0]);
}

/// Reads an OpaqueAttribute back: its class offers no constructor from bytes.
class BytesAttribute final : public Imf::Attribute {
  public:
    BytesAttribute(std::string type, std::vector<char> bytes)
        : m_type(std::move(type)), m_bytes(std::move(bytes)) {}

    [[nodiscard]] const char* typeName() const override { return m_type.c_str(); }

    [[nodiscard]] Attribute* copy() const override { return new BytesAttribute(m_type, m_bytes); }

    void writeValueTo(Imf::OStream& stream, int) const override {
        stream.write(m_bytes.data(), static_cast<int>(m_bytes.size()));
    }

    void readValueFrom(Imf::IStream& stream, int size, int) override {
        m_bytes.resize(static_cast<std::size_t>(size));
        stream.read(m_bytes.data(), size);
    }

    void copyValueFrom(const Attribute& other) override {
        if (const auto* same = dynamic_cast<const BytesAttribute*>(&other))
            m_bytes = same->m_bytes;
    }

  private:
    std::string m_type;
    std::vector<char> m_bytes;
};

/// The value at `data`, copied: OIIO promises no alignment.
template <class T>
T value_at(const void* data) {
    T out{};
    std::memcpy(static_cast<void*>(&out), data, sizeof out);
    return out;
}

template <class A, class T>
bool insert_plain(TypeDesc type, TypeDesc wanted, const std::string& name, const void* data,
                  Imf::Header& header) {
    const bool same = type.basetype == wanted.basetype && type.aggregate == wanted.aggregate &&
                      type.arraylen == wanted.arraylen;
    if (same)
        header.insert(name, A(value_at<T>(data)));
    return same;
}

bool insert_scalar(const OIIO::ParamValue& value, const std::string& name, Imf::Header& header) {
    const TypeDesc type = value.type();
    if (type.arraylen != 0 || type.aggregate != TypeDesc::SCALAR)
        return false;
    switch (type.basetype) {
    case TypeDesc::STRING: header.insert(name, Imf::StringAttribute(value.get_string())); return true;
    case TypeDesc::FLOAT:
    case TypeDesc::HALF: header.insert(name, Imf::FloatAttribute(value.get_float())); return true;
    case TypeDesc::DOUBLE:
        header.insert(name, Imf::DoubleAttribute(value_at<double>(value.data())));
        return true;
    case TypeDesc::INT64:
    case TypeDesc::UINT64: return false;
    default: header.insert(name, Imf::IntAttribute(value.get_int())); return true;
    }
}

bool insert_codes(const OIIO::ParamValue& value, const std::string& name, Imf::Header& header) {
    const TypeDesc type = value.type();
    if (type == OIIO::TypeTimeCode) {
        const auto code = value_at<std::array<unsigned, 2>>(value.data());
        header.insert(name, Imf::TimeCodeAttribute(Imf::TimeCode(code[0], code[1])));
        return true;
    }
    if (type == OIIO::TypeKeyCode) {
        const auto k = value_at<std::array<int, 7>>(value.data());
        header.insert(name, Imf::KeyCodeAttribute(Imf::KeyCode(k[0], k[1], k[2], k[3], k[4], k[5], k[6])));
        return true;
    }
    if (type == OIIO::TypeRational) {
        const auto r = value_at<std::array<int, 2>>(value.data());
        header.insert(name, Imf::RationalAttribute(Imf::Rational(r[0], r[1])));
        return true;
    }
    if (name == image::attribute::kChromaticities && type == kChromaticities) {
        const auto c = value_at<std::array<float, 8>>(value.data());
        header.insert(name, Imf::ChromaticitiesAttribute(
                                Imf::Chromaticities({c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]})));
        return true;
    }
    return false;
}

bool insert_lists(const OIIO::ParamValue& value, const std::string& name, Imf::Header& header) {
    const TypeDesc type = value.type();
    if (type.arraylen <= 0 || type.aggregate != TypeDesc::SCALAR)
        return false;
    const auto count = static_cast<std::size_t>(type.arraylen);
    if (type.basetype == TypeDesc::FLOAT) {
        Imf::FloatVector floats(count);
        std::memcpy(floats.data(), value.data(), count * sizeof(float));
        header.insert(name, Imf::FloatVectorAttribute(floats));
        return true;
    }
    if (type.basetype == TypeDesc::STRING) {
        Imf::StringVector strings;
        for (int i = 0; i < type.arraylen; ++i)
            strings.push_back(value.get_string_indexed(i));
        header.insert(name, Imf::StringVectorAttribute(strings));
        return true;
    }
    return false;
}

bool insert_opaque(const OIIO::ParamValue& value, std::string_view name, Imf::Header& header) {
    if (!name.starts_with(kOpaquePrefix) || value.type().basetype != TypeDesc::UINT8)
        return false;
    const std::string_view rest = name.substr(kOpaquePrefix.size());
    const auto slash = rest.find('/');
    if (slash == std::string_view::npos)
        return false;
    const auto* bytes = static_cast<const char*>(value.data());
    header.insert(std::string(rest.substr(slash + 1)),
                  BytesAttribute(std::string(rest.substr(0, slash)),
                                 std::vector<char>(bytes, bytes + value.type().size())));
    return true;
}

void insert_value(const OIIO::ParamValue& value, const std::string& name, Imf::Header& header) {
    if (exr::is_structural(name))
        return;
    const TypeDesc type = value.type();
    const void* const data = value.data();
    // The first that fits inserts; a type that OpenEXR has no attribute for is left out.
    [[maybe_unused]] const bool inserted =
        insert_codes(value, name, header) || insert_scalar(value, name, header) ||
        insert_lists(value, name, header) ||
        insert_plain<Imf::V2iAttribute, Imath::V2i>(type, kV2i, name, data, header) ||
        insert_plain<Imf::V2fAttribute, Imath::V2f>(type, kV2f, name, data, header) ||
        insert_plain<Imf::V2dAttribute, Imath::V2d>(type, kV2d, name, data, header) ||
        insert_plain<Imf::V3iAttribute, Imath::V3i>(type, kV3i, name, data, header) ||
        insert_plain<Imf::V3fAttribute, Imath::V3f>(type, kV3f, name, data, header) ||
        insert_plain<Imf::V3dAttribute, Imath::V3d>(type, kV3d, name, data, header) ||
        insert_plain<Imf::M33fAttribute, Imath::M33f>(type, kM33f, name, data, header) ||
        insert_plain<Imf::M44fAttribute, Imath::M44f>(type, kM44f, name, data, header) ||
        insert_plain<Imf::M33dAttribute, Imath::M33d>(type, kM33d, name, data, header) ||
        insert_plain<Imf::M44dAttribute, Imath::M44d>(type, kM44d, name, data, header) ||
        insert_plain<Imf::Box2iAttribute, Imath::Box2i>(type, kBox2i, name, data, header) ||
        insert_plain<Imf::Box2fAttribute, Imath::Box2f>(type, kBox2f, name, data, header);
}

bool is_foreign(std::string_view name) {
    const auto colon = name.find(':');
    if (colon == std::string_view::npos)
        return false;
    const std::string prefix = to_lower(name.substr(0, colon));
    return prefix == "oiio" ||
           std::find(kOtherFormats.begin(), kOtherFormats.end(), prefix) != kOtherFormats.end();
}

bool is_derived(std::string_view name) {
    return std::any_of(kDerived.begin(), kDerived.end(),
                       [name](std::string_view known) { return iequals(known, name); });
}

}  // namespace

void add_metadata(const Imf::Header& header, OIIO::ImageSpec& spec) {
    for (auto a = header.begin(); a != header.end(); ++a)
        if (!exr::is_structural(a.name()))
            add_attribute(a.name(), a.attribute(), spec);
    const float aspect = spec.get_float_attribute("PixelAspectRatio", 1.0F);
    const float density = spec.get_float_attribute("XResolution", 0.0F);
    if (density != 0) {
        spec.attribute("YResolution", density * (aspect != 0 ? aspect : 1.0F));
        spec.attribute("ResolutionUnit", "in");
    }
    if (header.hasName() && !header.name().empty())
        spec.attribute("oiio:subimagename", header.name());
}

void insert_metadata(const OIIO::ImageSpec& spec, Imf::Header& header) {
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
        const std::string given = value.name().string();
        if (is_derived(given) || iequals(given, "compression"))
            continue;
        try {
            if (iequals(given, "oiio:subimagename"))
                header.insert("name", Imf::StringAttribute(value.get_string()));
            else if (!insert_opaque(value, given, header) && !is_foreign(given))
                insert_value(value, exr_name(given), header);
        } catch (const Iex::TypeExc&) {
            // The name has a meaning in OpenEXR, and with it a type that this value is not.
        }
    }
}

}  // namespace osio::plugin
