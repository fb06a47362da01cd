// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/replacement_file.h>

#include <osio/base/result.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace osio::stack {

/// A grey PNG of 16 bits a sample that is being written from its top. It takes its target's place when it is finished.
class PngWriter {
  public:
    /// Sizes in pixels, at least 1. Io where the system refuses.
    [[nodiscard]] static Result<std::unique_ptr<PngWriter>> create(const std::string& target,
                                                                   std::uint32_t width, std::uint32_t height);
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter();

    /// The next rows, whole ones: samples row after row, the high byte first. Io where the system refuses.
    [[nodiscard]] Result<void> write_rows(std::span<const std::byte> samples);

    /// After the last row.
    [[nodiscard]] Result<void> finish(files::Durability durability);

  private:
    struct Writing;
    explicit PngWriter(std::unique_ptr<Writing> writing);
    [[nodiscard]] tl::unexpected<Error> failure() const;

    std::unique_ptr<Writing> m_writing;
};

}  // namespace osio::stack
