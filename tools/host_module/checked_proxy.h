// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/checked_file.h>

#include <OpenImageIO/filesystem.h>

#include <cstdint>
#include <string>

namespace osio::host {

/// OpenImageIO's view of a checked file. Its PNG writer, for one, reports no failed write.
class CheckedProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit CheckedProxy(const std::string& path) : IOProxy(path, Write), m_file(path) {}

    [[nodiscard]] const char* proxytype() const override { return "checked file"; }

    void close() override { m_file.close(); }

    [[nodiscard]] std::int64_t tell() override { return static_cast<std::int64_t>(m_file.position()); }

    bool seek(std::int64_t offset) override { return m_file.seek(static_cast<std::uint64_t>(offset)); }

    [[nodiscard]] std::size_t size() const override { return m_file.size(); }

    std::size_t write(const void* bytes, std::size_t count) override {
        return m_file.write(bytes, count) ? count : 0;
    }

    [[nodiscard]] files::CheckedFile& file() { return m_file; }

  private:
    files::CheckedFile m_file;
};

}  // namespace osio::host
