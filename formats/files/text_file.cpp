// SPDX-License-Identifier: Apache-2.0
#include <formats/files/checked_file.h>
#include <formats/files/text_file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sys/stat.h>
#include <utility>

namespace osio::files {

Result<std::string> read_text(const std::string& path) {
    struct stat status {};

    if (::stat(path.c_str(), &status) != 0)
        return fail(ErrorCode::Io, std::strerror(errno), path);
    if (!S_ISREG(status.st_mode))
        return fail(ErrorCode::Io, "is no ordinary file", path);
    std::ifstream in(path, std::ios::binary);
    if (!in)
        return fail(ErrorCode::Io, std::strerror(errno), path);
    std::string text(kMostTextBytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMostTextBytes)
        return fail(ErrorCode::Io,
                    "is longer than " + std::to_string(kMostTextBytes) + " bytes, expected a table", path);
    if (in.bad())
        return fail(ErrorCode::Io, "cannot be read", path);
    return text;
}

Result<void> write_text(const std::string& path, std::string_view text) {
    OSIO_TRY(ReplacementFile file, ReplacementFile::create(path));
    return write_text(std::move(file), text);
}

Result<void> write_text(ReplacementFile file, std::string_view text) {
    CheckedFile out(file.path());
    out.write(text.data(), text.size());
    if (out.close() != 0)
        return fail(ErrorCode::Io, out.failure(), file.target());
    return file.commit();
}

std::string seen_from(const std::string& folder, std::string_view path) {
    if (folder.empty() || path.starts_with('/'))
        return std::string(path);
    return folder + "/" + std::string(path);
}

TextLoader text_loader(std::string folder) {
    return [folder = std::move(folder)](std::string_view path) { return read_text(seen_from(folder, path)); };
}

std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? std::string() : path.substr(0, slash == 0 ? 1 : slash);
}

}  // namespace osio::files
