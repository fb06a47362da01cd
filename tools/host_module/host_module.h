// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/exr_file.h>
#include <formats/files/replacement_file.h>

#include <osio/base/result.h>
#include <osio/collapse/collapse_stream.h>

#include <OpenEXR/ImfHeader.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// What osiotool needs OpenImageIO for, in a shared object of its own that is opened only then:
/// loading OpenImageIO costs a quarter of a second and over 100 MB.
namespace osio::host {

/// How samples are stored in the other file.
enum class StoredType { Uint8, Uint16, Half, Float };

/// An image in a format of OpenImageIO's.
struct HostImage {
    std::string path;
    StoredType type = StoredType::Float;
    std::vector<std::string> channel_names;
    const Imf::Header* header = nullptr;  ///< windows and metadata
    files::Durability durability = files::Durability::Handed;
};

/// Takes finished rows; the file appears under its name in finish().
class HostSink : public RowSink {
  public:
    [[nodiscard]] virtual Result<void> finish() = 0;

    /// Pixels of integer images with a channel outside 0 to 1, stored as 0 or 1.
    [[nodiscard]] virtual std::uint64_t clipped_pixels() const = 0;
};

/// One thing that was looked at, for people.
struct Finding {
    enum class Kind { Good, Note, Problem };

    Kind kind = Kind::Good;
    std::string text;
};

/// The interface behind the shared object.
class HostModule {
  public:
    virtual ~HostModule() = default;

    /// Refuses (Usage) a type that the format would silently store as another.
    [[nodiscard]] virtual Result<std::unique_ptr<HostSink>> open_sink(const HostImage& image) const = 0;

    /// The names of an OpenEXR part's channels in the order in which OpenImageIO's own reader has them.
    [[nodiscard]] virtual Result<std::vector<std::string>> channel_order(const std::string& path,
                                                                         std::size_t part) const = 0;

    /// Looks whether the OpenImageIO of this machine sees our plugin in `plugin_folder`, and if not,
    /// why.
    [[nodiscard]] virtual std::vector<Finding> examine(const std::string& plugin_folder) const = 0;
};

/// The one symbol of the shared object.
inline constexpr const char* kEntry = "osio_host_module";
using Entry = const HostModule* (*)();

}  // namespace osio::host
