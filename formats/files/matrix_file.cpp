// SPDX-License-Identifier: Apache-2.0
#include <formats/files/matrix_file.h>
#include <formats/files/text_file.h>

#include <osio/base/fingerprint.h>
#include <osio/base/text.h>

namespace osio::files {

namespace {

constexpr int kLargestCube = 129;

std::string row_text(const Vector3& row) {
    return format_double(row[0]) + " " + format_double(row[1]) + " " + format_double(row[2]);
}

std::string clf(const BakedMatrix& baked) {
    Fingerprint id;
    for (const std::string& line : baked.description())
        id.add(line);
    for (const Vector3& row : baked.matrix.rows)
        for (const double value : row)
            id.add(value);
    std::string out =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ProcessList compCLFversion=\"3.0\" id=\"" + id.hex() +
        "\" name=\"" + escaped_xml(baked.title) + "\">\n";
    for (const std::string& line : baked.description())
        out += "    <Description>" + escaped_xml(line) + "</Description>\n";
    out += "    <InputDescriptor>" + escaped_xml(baked.input) + "</InputDescriptor>\n";
    out += "    <OutputDescriptor>" + escaped_xml(baked.output) + "</OutputDescriptor>\n";
    out += "    <Matrix inBitDepth=\"32f\" outBitDepth=\"32f\">\n        <Array dim=\"3 3\">\n";
    for (const Vector3& row : baked.matrix.rows)
        out += "            " + row_text(row) + "\n";
    return out + "        </Array>\n    </Matrix>\n</ProcessList>\n";
}

std::string spimtx(const BakedMatrix& baked) {
    std::string out;
    for (const Vector3& row : baked.matrix.rows)
        out += row_text(row) + " 0\n";
    return out;
}

std::string cube(const BakedMatrix& baked, const CubeDomain& domain) {
    std::string out;
    for (const std::string& line : baked.description())
        out += "# " + line + "\n";
    out += "# the matrix from " + format_double(domain.low) + " to " + format_double(domain.high) +
           "; readers clip what lies outside\n";
    std::string title = baked.title;
    for (char& c : title)
        c = c == '"' ? '\'' : c;
    out += "TITLE \"" + title + "\"\nLUT_3D_SIZE " + std::to_string(domain.size) + "\n";
    for (const auto& [key, value] :
         {std::pair("DOMAIN_MIN ", domain.low), std::pair("DOMAIN_MAX ", domain.high)})
        out += key + row_text({value, value, value}) + "\n";
    const auto at = [&domain](int i) {
        return domain.low + (domain.high - domain.low) * i / (domain.size - 1);
    };
    for (int b = 0; b < domain.size; ++b)
        for (int g = 0; g < domain.size; ++g)
            for (int r = 0; r < domain.size; ++r)  // red runs fastest
                out += row_text(baked.matrix * Vector3{at(r), at(g), at(b)}) + "\n";
    return out;
}

}  // namespace

Result<std::string> matrix_file_text(const BakedMatrix& baked, const std::string& path,
                                     const CubeDomain& domain) {
    const std::string name = to_lower(path);
    if (name.ends_with(".clf"))
        return clf(baked);
    if (name.ends_with(".spimtx"))
        return spimtx(baked);
    if (!name.ends_with(".cube"))
        return fail(ErrorCode::Usage, "a matrix is written as .clf, .spimtx or .cube", path);
    if (!(domain.low < domain.high) || domain.size < 2 || domain.size > kLargestCube)
        return fail(ErrorCode::Usage, "a .cube of " + std::to_string(domain.size) + " points from " +
                                          format_double(domain.low) + " to " + format_double(domain.high) +
                                          "; expected 2 to " + std::to_string(kLargestCube) +
                                          " points, from a number to a larger one");
    return cube(baked, domain);
}

Result<void> write_matrix_file(const BakedMatrix& baked, const std::string& path, const CubeDomain& domain) {
    OSIO_TRY(const std::string text, matrix_file_text(baked, path, domain));
    return write_text(path, text);
}

}  // namespace osio::files
