// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/tiff_handle.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace osio::tiff {

tmsize_t Handle::read(void* self, void* bytes, tmsize_t count) {
    auto& handle = *static_cast<Handle*>(self);
    const std::uint64_t size = handle.m_file->size();
    const std::uint64_t at = std::min(handle.m_position, size);
    const std::uint64_t there = std::min(static_cast<std::uint64_t>(std::max<tmsize_t>(count, 0)), size - at);
    if (!handle.m_file->read(at, there, static_cast<std::byte*>(bytes)))
        return -1;
    handle.m_position = at + there;
    return static_cast<tmsize_t>(there);
}

tmsize_t Handle::refuse_writing(void*, void*, tmsize_t) {
    return -1;
}

toff_t Handle::seek(void* self, toff_t offset, int whence) {
    auto& handle = *static_cast<Handle*>(self);
    if (whence == SEEK_CUR)
        offset += handle.m_position;
    else if (whence == SEEK_END)
        offset += handle.m_file->size();
    handle.m_position = offset;
    return offset;
}

toff_t Handle::size(void* self) {
    return static_cast<Handle*>(self)->m_file->size();
}

Result<std::unique_ptr<Handle>> Handle::open(std::shared_ptr<const files::RawFile> file) {
    std::unique_ptr<Handle> out(new Handle(std::move(file)));
    // h: no directory yet; m: never mapped, a file that shrinks must not end the host; D, O: of the strips' places
    // only those that are asked for.
    out->m_tiff = out->m_messages.open("rhmDO", out.get(), &read, &refuse_writing, &seek, &size);
    OSIO_CHECK_OK(out->check(out->m_tiff != nullptr, "is no TIFF file"));
    return out;
}

Handle::~Handle() {
    if (m_tiff != nullptr)
        TIFFClose(m_tiff);
}

Result<bool> Handle::next() {
    m_messages = {};
    const bool read = TIFFReadDirectory(m_tiff) == 1;
    if (!read && m_messages.error.empty())
        return false;
    if (!m_messages.error.empty())
        return tl::unexpected(check(false, "its directory cannot be read").error());
    // Tags that could not be read are left out with a warning.
    for (const std::string& warning : m_messages.warnings)
        if (warning.starts_with("IO error") || warning.starts_with("Out of memory"))
            return fail(ErrorCode::Damaged, "its directory cannot be read: " + warning);
    m_directory = TIFFCurrentDirOffset(m_tiff);
    return true;
}

Result<void> Handle::go_to(std::uint64_t directory) {
    if (m_directory == directory)
        return {};
    m_messages = {};
    m_directory = 0;
    const bool there = TIFFSetSubDirectory(m_tiff, directory) == 1;
    const auto warnings = take_warnings();  // were told when the file was opened
    OSIO_CHECK_OK(check(there, "has no directory at " + std::to_string(directory)));
    m_directory = directory;
    return {};
}

Result<void> Handle::check(bool ok, const std::string& what) {
    const Messages said = std::exchange(m_messages, {});
    if (ok && said.error.empty() && said.warnings.empty())
        return {};
    const std::string& words = !said.error.empty()      ? said.error
                               : !said.warnings.empty() ? said.warnings.front()
                                                        : what;
    return fail(ErrorCode::Damaged, words == what ? what : what + ": " + words);
}

std::vector<std::string> Handle::take_warnings() {
    return std::exchange(m_messages.warnings, {});
}

}  // namespace osio::tiff
