// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/block_source.h>
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/chunk_map.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/header_bytes.h>
#include <formats/exr/limits.h>
#include <formats/exr/part_bands.h>
#include <formats/exr/scaled_source.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/openexr_base.h>
#include <OpenEXR/openexr_part.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <sys/stat.h>
#include <utility>

namespace osio::exr {

namespace {

/// OpenEXRCore reports errors on the thread that met them.
thread_local std::string t_core_message;

void keep_core_message(exr_const_context_t, exr_result_t, const char* message) {
    t_core_message = message;
}

constexpr std::array<std::pair<std::string_view, Imf::Compression>, 10> kCompressions{{
    {"none", Imf::NO_COMPRESSION},
    {"rle", Imf::RLE_COMPRESSION},
    {"zips", Imf::ZIPS_COMPRESSION},
    {"zip", Imf::ZIP_COMPRESSION},
    {"piz", Imf::PIZ_COMPRESSION},
    {"pxr24", Imf::PXR24_COMPRESSION},
    {"b44", Imf::B44_COMPRESSION},
    {"b44a", Imf::B44A_COMPRESSION},
    {"dwaa", Imf::DWAA_COMPRESSION},
    {"dwab", Imf::DWAB_COMPRESSION},
}};

/// The size of a readable regular OpenEXR file.
Result<std::uint64_t> check_file(const std::string& path) {
    struct stat status {};

    if (::stat(path.c_str(), &status) != 0)
        return fail(ErrorCode::Io, std::strerror(errno), path);
    if (S_ISDIR(status.st_mode))
        return fail(ErrorCode::Io, "is a folder, expected an OpenEXR file", path);
    std::ifstream in(path, std::ios::binary);
    if (!in)
        return fail(ErrorCode::Io, std::strerror(errno), path);
    if (!starts_like_exr(path))
        return fail(ErrorCode::NotSpectral, "is no OpenEXR file (its first bytes are not 76 2F 31 01)", path);
    return static_cast<std::uint64_t>(status.st_size);
}

Window window_of(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, box.max.x, box.max.y};
}

/// Width and height as differences that do not overflow an int.
bool plausible(const Imath::Box2i& box) {
    const auto width = std::int64_t{box.max.x} - box.min.x + 1;
    const auto height = std::int64_t{box.max.y} - box.min.y + 1;
    return width > 0 && height > 0 && width <= image::kMostSidePixels && height <= image::kMostSidePixels;
}

SampleType sample_type(Imf::PixelType type) {
    return type == Imf::HALF ? SampleType::Half : type == Imf::FLOAT ? SampleType::Float : SampleType::Uint;
}

std::vector<image::Channel> channels_of(const Imf::Header& header) {
    std::vector<image::Channel> out;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const Imf::Channel& channel = c.channel();
        out.push_back(
            {c.name(), sample_type(channel.type), channel.xSampling != 1 || channel.ySampling != 1});
    }
    return out;
}

/// A part's header but for its bands.
Result<image::Part> understand(const Imf::Header& header, std::uint64_t file_bytes) {
    image::Part part;
    part.header = header;
    if (!plausible(header.dataWindow()) || !plausible(header.displayWindow()))
        return fail(ErrorCode::Damaged, "the data or display window is empty or too large");
    part.name = header.hasName() ? header.name() : std::string();
    part.data_window = window_of(header.dataWindow());
    part.display_window = window_of(header.displayWindow());
    part.deep = header.hasType() && Imf::isDeepData(header.type());
    part.tiled = header.hasType() ? Imf::isTiled(header.type()) : header.hasTileDescription();
    part.compression = compression_name(header.compression());
    part.channels = channels_of(header);
    if (part.channels.size() > image::kMostChannels)
        return fail(ErrorCode::Damaged, std::to_string(part.channels.size()) +
                                            " channels, more than the limit of " +
                                            std::to_string(image::kMostChannels));
    OSIO_CHECK_OK(check_limits(part, file_bytes));
    return part;
}

}  // namespace

ExrFile::~ExrFile() {
    if (m_context != nullptr)
        exr_finish(&m_context);
}

Result<std::shared_ptr<const ExrFile>> ExrFile::open(const std::string& path, const OpenWords& words) {
    OSIO_TRY(const std::uint64_t bytes, check_file(path));
    const std::shared_ptr<ExrFile> file(new ExrFile(path));
    OSIO_TRY(files::RawFile raw, files::RawFile::open(path));
    std::string header_bytes;
    const auto headers = read_raw_headers(raw, header_bytes);
    if (!headers)
        return fail_in(path, headers.error());
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.error_handler_fn = keep_core_message;
    const exr_result_t code = exr_start_read(&file->m_context, path.c_str(), &init);
    if (code != EXR_ERR_SUCCESS)
        file->m_context = nullptr;
    // Core 3.1.5 refuses some sound files (flat parts beside deep ones); then the C++ API decides.
    if (code != EXR_ERR_SUCCESS && code != EXR_ERR_MISSING_REQ_ATTR)
        return core_failure(code, path);
    if (auto result = file->check_chunks(bytes); !result)
        return fail_in(path, std::move(result).error());
    if (auto result = file->read_headers(bytes, words); !result)
        return fail_in(path, std::move(result).error());
    auto chunks = ChunkMap::load(std::move(raw), *headers, file->parts(), file->chunk_counts());
    if (!chunks)
        return fail_in(path, std::move(chunks).error());
    file->m_chunks = std::move(*chunks);
    return file;
}

Result<void> ExrFile::check_chunks(std::uint64_t file_bytes) const {
    if (m_context == nullptr)
        return {};
    int count = 0;
    exr_get_count(m_context, &count);
    for (int part = 0; part < count; ++part) {
        int32_t chunks = 0;
        const exr_result_t code = exr_get_chunk_count(m_context, part, &chunks);
        if (code != EXR_ERR_SUCCESS)
            return core_failure(code, {});
        // Each chunk has 8 bytes in the offset table.
        if (static_cast<std::uint64_t>(chunks) * 8 > file_bytes)
            return fail(ErrorCode::Damaged, "the header promises " + std::to_string(chunks) +
                                                " chunks, more than " + std::to_string(file_bytes) +
                                                " bytes can hold; the file is cut short or damaged");
    }
    return {};
}

std::vector<std::uint64_t> ExrFile::chunk_counts() const {
    std::vector<std::uint64_t> out;
    for (std::size_t part = 0; part < parts().size(); ++part) {
        const Imf::Header& header = parts()[part].header;
        std::int64_t count = 0;
        if (int32_t told = 0; m_context != nullptr) {
            exr_get_chunk_count(m_context, static_cast<int>(part), &told);
            count = told;
        } else {
            count = header.hasChunkCount() ? header.chunkCount()
                                           : static_cast<std::int64_t>(full_resolution_chunks(parts()[part]));
        }
        out.push_back(static_cast<std::uint64_t>(std::max<std::int64_t>(count, 0)));
    }
    return out;
}

Result<void> ExrFile::read_headers(std::uint64_t file_bytes, const OpenWords& words) {
    try {
        // 0: no threads of OpenEXR's global pool, which belongs to the host.
        const Imf::MultiPartInputFile file(path().c_str(), 0, false);
        std::vector<image::Part> parts;
        for (int i = 0; i < file.parts(); ++i) {
            OSIO_TRY(parts.emplace_back(), understand(file.header(i), file_bytes));
        }
        OSIO_CHECK_OK(understand_bands(parts, words));
        for (image::Part& part : parts)
            add(std::move(part));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::Io, "out of memory");
    } catch (const std::exception& error) {
        return fail(ErrorCode::Damaged, error.what());
    }
    return {};
}

Result<std::unique_ptr<BlockSource>> ExrFile::make_block_source(std::size_t part, PlaneChannels planes,
                                                                Grain grain) const {
    std::vector<double> factors;
    for (const auto& channel : planes)
        factors.push_back(channel ? parts()[part].channels[*channel].scale : 1);
    OSIO_TRY(auto source, exr::make_block_source(shared_from_this(), part, std::move(planes), grain));
    if (std::all_of(factors.begin(), factors.end(), [](double factor) { return factor == 1; }))
        return source;
    return with_factors(std::move(source), std::move(factors));
}

bool starts_like_exr(const std::string& path) {
    constexpr std::array<char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
    std::array<char, 4> head{};
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), head.size());
    return in.gcount() == static_cast<std::streamsize>(head.size()) && head == kMagic;
}

tl::unexpected<Error> core_failure(exr_result_t code, const std::string& path) {
    std::string message = std::exchange(t_core_message, {});
    if (message.empty())
        message = exr_get_default_error_message(code);
    // Core prefixes the path; so does whoever adds `where`.
    if (!path.empty() && message.starts_with("'" + path + "': "))
        message.erase(0, path.size() + 4);
    const bool system = code == EXR_ERR_FILE_ACCESS || code == EXR_ERR_OUT_OF_MEMORY;
    return fail(system ? ErrorCode::Io : ErrorCode::Damaged, message, path);
}

std::string compression_name(Imf::Compression compression) {
    for (const auto& [name, known] : kCompressions)
        if (known == compression)
            return std::string(name);
    return "unknown";
}

Result<Imf::Compression> find_compression(std::string_view name) {
    std::vector<std::string> known;
    for (const auto& [word, compression] : kCompressions) {
        if (iequals(word, name))
            return compression;
        known.emplace_back(word);
    }
    return fail(ErrorCode::UnknownName,
                "no compression is called \"" + std::string(name) + "\"" + suggestion(name, known));
}

Imf::PixelType pixel_type(SampleType type) {
    switch (type) {
    case SampleType::Half: return Imf::HALF;
    case SampleType::Float: return Imf::FLOAT;
    case SampleType::Uint: break;
    }
    return Imf::UINT;
}

std::string library_version() {
    int major = 0, minor = 0, patch = 0;
    exr_get_library_version(&major, &minor, &patch, nullptr);
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace osio::exr
