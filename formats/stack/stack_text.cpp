// SPDX-License-Identifier: Apache-2.0
#include <formats/image/limits.h>
#include <formats/stack/stack_text.h>

#include <osio/base/text.h>
#include <osio/spectra/wavelength.h>

#include <algorithm>
#include <set>

namespace osio::stack {

namespace {

/// The fields of a line between commas; one in double quotes may hold them.
Result<std::vector<std::string>> fields_of(std::string_view line) {
    std::vector<std::string> out{{}};
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            out.emplace_back();
        else
            out.back() += c;
    }
    if (quoted)
        return fail(ErrorCode::Usage, "a quotation mark is never closed");
    for (std::string& field : out)
        field = trim(field);
    return out;
}

/// A length above 0 in nm: a number, or one with a unit, a space between or none.
Result<double> length_nm(const std::string& text, std::string_view what) {
    std::string spelt = text;
    std::erase(spelt, ' ');
    if (parse_double(spelt))
        spelt += "nm";
    const auto nm = parse_wavelength_nm(spelt, DecimalMark::Point);
    if (!nm)
        return fail(ErrorCode::Usage, "found \"" + text.substr(0, 40) + "\", expected a " +
                                          std::string(what) + " such as 450 or 0.45um");
    return *nm;
}

Result<StackFile> file_of(std::string_view line) {
    OSIO_TRY(const auto fields, fields_of(line));
    if (fields[0].empty() || fields.size() > 3)
        return fail(ErrorCode::Usage, "expected file, file,nm or file,nm,fwhm");
    StackFile out{fields[0], 0, 0};
    if (fields.size() > 1 && !fields[1].empty()) {
        OSIO_TRY(out.wavelength_nm, length_nm(fields[1], "wavelength"));
    }
    if (fields.size() > 2 && !fields[2].empty()) {
        OSIO_TRY(out.fwhm_nm, length_nm(fields[2], "full width at half maximum"));
    }
    return out;
}

/// A line `key = value`, which no file's name looks like: those with '=' stand in quotes.
Result<void> read_key(std::string_view line, StackText& out) {
    const auto equals = line.find('=');
    const std::string_view key = trim(line.substr(0, equals)), value = trim(line.substr(equals + 1));
    if (key != "scale")
        return fail(ErrorCode::Usage,
                    "there is no key \"" + std::string(key.substr(0, 40)) +
                        "\"; expected scale, or a file, whose name stands in double quotes where "
                        "it holds '='");
    const auto number = parse_double(value);
    if (!number || !(*number > 0))
        return fail(ErrorCode::Usage,
                    "found scale \"" + std::string(value.substr(0, 40)) + "\", expected a number above 0");
    if (out.scale)
        return fail(ErrorCode::Usage, "scale is there for a second time");
    out.scale = number;
    return {};
}

}  // namespace

Result<StackText> parse_stack(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF"))
        text.remove_prefix(3);
    const auto lines = split(text, '\n');
    if (trim(lines.front()) != kStackMagic)
        return fail(ErrorCode::NotSpectral, "its first line is not \"" + std::string(kStackMagic) + "\"");
    StackText out;
    std::set<std::string> seen;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::string_view line = trim(lines[i]);
        if (line.empty() || line.front() == '#')
            continue;
        const std::string where = "line " + std::to_string(i + 1);
        const bool key = line.front() != '"' && line.find('=') != std::string_view::npos;
        if (key) {
            if (auto result = read_key(line, out); !result)
                return fail_in(where, result.error());
            continue;
        }
        auto file = file_of(line);
        if (!file)
            return fail_in(where, file.error());
        if (!seen.insert(file->path).second)
            return fail(ErrorCode::Usage,
                        "names the file \"" + file->path.substr(0, 80) + "\" for a second time", where);
        out.files.push_back(std::move(*file));
    }
    if (out.files.empty())
        return fail(ErrorCode::Usage, "names no file");
    if (out.files.size() > image::kMostChannels)
        return fail(ErrorCode::Usage, "names " + std::to_string(out.files.size()) + " files, more than " +
                                          std::to_string(image::kMostChannels));
    return out;
}

}  // namespace osio::stack
