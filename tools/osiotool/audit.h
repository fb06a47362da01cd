// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/collapse/basis_choice.h>
#include <osio/layout/writer.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osio::tool {

/// How a set's bands become a spectrum where nobody says otherwise.
struct AuditedSet {
    std::string name;
    Quantity quantity = Quantity::Reflectance;
    std::vector<double> wavelengths_nm;
    BasisChoice basis;
};

/// What is known, taken for granted and wrong of a part.
struct AuditedPart {
    std::string name;
    Writer writer;
    Dialect dialect;
    std::vector<AuditedSet> sets;
    std::vector<std::string> assumed;
    std::vector<Quirk> quirks;
    std::vector<std::string> problems;
};

struct AuditedFile {
    std::string path;
    std::string format;  ///< empty where it could not be opened
    std::vector<AuditedPart> parts;
    std::optional<Error> failure;
};

[[nodiscard]] AuditedPart audit_part(const image::Part& part);

[[nodiscard]] std::string audit_text(const AuditedFile& file);
[[nodiscard]] std::string audit_json(const std::vector<AuditedFile>& files);

}  // namespace osio::tool
