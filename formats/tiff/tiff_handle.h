// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/raw_file.h>
#include <formats/tiff/tiff_messages.h>

#include <osio/base/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace osio::tiff {

/// A reader's own libtiff handle on a file that others share. For one thread.
class Handle {
  public:
    /// Stands before the first directory. Damaged where the first bytes are no TIFF's.
    [[nodiscard]] static Result<std::unique_ptr<Handle>> open(std::shared_ptr<const files::RawFile> file);

    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle();

    [[nodiscard]] TIFF* get() const { return m_tiff; }

    [[nodiscard]] const files::RawFile& file() const { return *m_file; }

    /// Reads the next directory; false where there is none. Damaged where it is broken.
    [[nodiscard]] Result<bool> next();

    /// Goes to the directory at an offset of the file; does nothing where it stands there.
    [[nodiscard]] Result<void> go_to(std::uint64_t directory);

    /// Damaged where `ok` is false or libtiff complained since it was last asked: pixels about which it only warns
    /// are lost too.
    [[nodiscard]] Result<void> check(bool ok, const std::string& what);

    /// The warnings since it was last asked.
    [[nodiscard]] std::vector<std::string> take_warnings();

  private:
    explicit Handle(std::shared_ptr<const files::RawFile> file) : m_file(std::move(file)) {}

    static tmsize_t read(void* self, void* bytes, tmsize_t count);
    static tmsize_t refuse_writing(void* self, void* bytes, tmsize_t count);
    static toff_t seek(void* self, toff_t offset, int whence);
    static toff_t size(void* self);

    std::shared_ptr<const files::RawFile> m_file;
    Messages m_messages;
    TIFF* m_tiff = nullptr;
    std::uint64_t m_position = 0;
    std::uint64_t m_directory = 0;  ///< where it stands; none at 0
};

}  // namespace osio::tiff
