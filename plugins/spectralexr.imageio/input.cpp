// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/host_rows.h>
#include <plugins/common/host_runner.h>
#include <plugins/spectralexr.imageio/input.h>

#include <formats/files/text_file.h>
#include <formats/image/certificate.h>
#include <formats/image/open_image.h>

#include <osio/collapse/selection.h>
#include <osio/collapse/text_loader.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>

namespace osio::plugin {

namespace {

/// Hosts throw away what a reader says of a name with a query; this prints it.
bool debug_wanted() {
    const char* const value = std::getenv("OSIO_DEBUG");
    return value != nullptr && *value != '\0' && std::strcmp(value, "0") != 0;
}

/// OIIO tries every reader on files that their own reader refused, and says so with this hint.
bool is_last_resort(const OIIO::ImageSpec* config) {
    return config != nullptr && config->get_int_attribute("nowait") != 0 && !has_spectral_hint(*config);
}

/// Options of a collapse mean nothing without a space to collapse to.
Result<void> check_raw_request(const CollapseRequest& request) {
    const auto needs_space = [](std::string_view option) {
        return fail(ErrorCode::Usage, std::string(option) +
                                          " was given without a space to collapse to; add to=lin_rec709 "
                                          "(osiotool list spaces)");
    };
    if (!request.illuminant.empty())
        return needs_space("illuminant=" + request.illuminant);
    if (!request.white.empty())
        return needs_space("white=" + request.white);
    if (request.max_delta_e || request.white_luminance)
        return needs_space(request.max_delta_e ? "max-delta-e" : "white-luminance");
    if (!request.set.empty())
        return needs_space("set=" + request.set);
    if (request.exposure_stops != 0)
        return needs_space("exposure");
    if (request.names == OutputNames::Xyz || request.names == OutputNames::Rgb)
        return needs_space("names");
    return {};
}

}  // namespace

int SpectralExrInput::supports(OIIO::string_view feature) const {
    return feature == "arbitrary_metadata" || feature == "multiimage";
}

bool SpectralExrInput::valid_file(const std::string& filename) const {
    try {
        return names_our_file(filename);
    } catch (const std::exception&) {
        return false;
    }
}

bool SpectralExrInput::open(const std::string& name, OIIO::ImageSpec& spec) {
    return open_with(name, spec, nullptr);
}

bool SpectralExrInput::open(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) {
    return open_with(name, spec, &config);
}

bool SpectralExrInput::open_with(const std::string& name, OIIO::ImageSpec& spec,
                                 const OIIO::ImageSpec* config) {
    close();
    try {
        if (kind_of(name) == NameKind::Other && is_last_resort(config)) {
            errorfmt("{} is not a spectral name", name);
            return false;
        }
        if (auto result = load(name, config); !result)
            return report(name, result.error());
    } catch (const std::exception& error) {
        return report(name, {ErrorCode::Io, error.what(), name});
    }
    if (!seek_subimage(0, 0))
        return false;
    spec = m_spec;
    return true;
}

bool SpectralExrInput::report(const std::string& name, const Error& error) {
    close();
    errorfmt("{}", error.text());
    if (debug_wanted())
        std::fprintf(stderr, "osio: %s: %s\n", name.c_str(), error.text().c_str());
    return false;
}

Result<void> SpectralExrInput::load(const std::string& name, const OIIO::ImageSpec* config) {
    OSIO_TRY(const OpenRequest open, resolve_open(name, config));
    if (!open.request.to)
        OSIO_CHECK_OK(check_raw_request(open.request));
    const TextLoader load_text = files::text_loader({});
    OSIO_TRY(const OpenWords words, load_open_words(open.request, load_text));
    OSIO_TRY(auto file, image::open_image(open.path, words));
    if (!open.request.to)
        return add_raw_subimages(file, open.request);
    if (open.request.white_luminance && !open.request.max_delta_e)
        return fail(ErrorCode::Usage, "white-luminance is for max-delta-e");
    OSIO_TRY(auto jobs, image::prepare_collapses(file, open.request, load_text));
    for (image::CollapseJob& job : jobs) {
        OSIO_TRY(std::string certificate, certify(job));
        OSIO_TRY(auto subimage, make_collapsed_subimage(std::move(job), static_cast<int>(jobs.size()),
                                                        std::move(certificate)));
        m_subimages.push_back(std::move(subimage));
    }
    return {};
}

Result<std::string> SpectralExrInput::certify(const image::CollapseJob& job) {
    if (!job.plan.request.max_delta_e)
        return std::string();
    OSIO_TRY(const auto source, job.open_source());
    HostRunner runner(threads(), source->block_count());
    OSIO_TRY(const image::Certificate certificate,
             image::certify_for_host(job, files::text_loader({}), runner));
    return image::certificate_json(job, certificate, true);
}

Result<void> SpectralExrInput::add_raw_subimages(const std::shared_ptr<const image::SpectralImage>& file,
                                                 const CollapseRequest& request) {
    const BandNames names = request.names == OutputNames::Layout ? BandNames::AsStored : BandNames::CommaFree;
    std::size_t first = 0, end = file->parts().size();
    if (!request.part.empty()) {
        OSIO_TRY(first, select_part(file->summaries(), request.part));
        end = first + 1;
    }
    for (std::size_t part = first; part < end; ++part) {
        OSIO_TRY(auto subimage, make_raw_subimage(file, part, names, static_cast<int>(end - first)));
        m_subimages.push_back(std::move(subimage));
    }
    return {};
}

bool SpectralExrInput::close() {
    m_subimages.clear();
    m_cache = {};
    m_current = -1;
    m_spec = OIIO::ImageSpec();
    return true;
}

bool SpectralExrInput::seek_subimage(int subimage, int miplevel) {
    // An index out of range is how hosts find the end; it is no error.
    if (subimage < 0 || static_cast<std::size_t>(subimage) >= m_subimages.size() || miplevel != 0)
        return false;
    if (subimage != m_current) {
        m_current = subimage;
        m_spec = m_subimages[static_cast<std::size_t>(subimage)]->spec();
    }
    return true;
}

bool SpectralExrInput::read_native_scanline(int subimage, int miplevel, int y, int z, void* data) {
    return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
}

bool SpectralExrInput::read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int,
                                             void* data) {
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel))
        return false;
    return read_host_rows(*this, m_spec, ybegin, yend,
                          [&](RowRange rows) { return read(rows, static_cast<std::byte*>(data)); });
}

Result<void> SpectralExrInput::read(RowRange rows, std::byte* out) {
    Subimage& image = *m_subimages[static_cast<std::size_t>(m_current)];
    HostRunner runner(threads(), image.block_count());
    const RowRange around = image.rows_around(rows.first);
    if (rows.last > around.last || (rows.first == around.first && rows.last == around.last))
        return image.read_rows(rows, out, runner);

    OSIO_CHECK_OK(fill_cache(around));
    const std::size_t bytes = image.row_bytes();
    std::memcpy(out, m_cache.pixels.data() + static_cast<std::size_t>(rows.first - around.first) * bytes,
                static_cast<std::size_t>(rows.last - rows.first + 1) * bytes);
    return {};
}

Result<void> SpectralExrInput::fill_cache(RowRange around) {
    if (m_cache.subimage == m_current && m_cache.rows.first == around.first)
        return {};
    Subimage& image = *m_subimages[static_cast<std::size_t>(m_current)];
    HostRunner runner(threads(), image.block_count());
    m_cache.subimage = -1;
    m_cache.pixels.resize(static_cast<std::size_t>(around.last - around.first + 1) * image.row_bytes());
    OSIO_CHECK_OK(image.read_rows(around, m_cache.pixels.data(), runner));
    m_cache.subimage = m_current;
    m_cache.rows = around;
    return {};
}

bool SpectralExrInput::read_native_tile(int subimage, int miplevel, int x, int y, int, void* data) {
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel))
        return false;
    if (m_spec.tile_width <= 0 || x < m_spec.x || x >= m_spec.x + m_spec.width ||
        (x - m_spec.x) % m_spec.tile_width != 0 || (y - m_spec.y) % m_spec.tile_height != 0) {
        errorfmt("there is no tile at {}, {}", x, y);
        return false;
    }
    const int end = std::min(y + m_spec.tile_height, m_spec.y + m_spec.height);
    return read_host_rows(*this, m_spec, y, end,
                          [&](RowRange) { return read_tile(x, y, static_cast<std::byte*>(data)); });
}

/// Blocks of a tiled part are rows of tiles. Beyond the image a tile keeps what the host had there.
Result<void> SpectralExrInput::read_tile(int x, int y, std::byte* out) {
    const Subimage& image = *m_subimages[static_cast<std::size_t>(m_current)];
    const RowRange around = image.rows_around(y);
    OSIO_CHECK_OK(fill_cache(around));
    const std::size_t pixel = m_spec.pixel_bytes(true), row = image.row_bytes();
    const auto pixels = static_cast<std::size_t>(std::min(m_spec.tile_width, m_spec.x + m_spec.width - x));
    const std::byte* from = m_cache.pixels.data() + static_cast<std::size_t>(x - m_spec.x) * pixel;
    for (int line = around.first; line <= around.last; ++line) {
        std::memcpy(out, from, pixels * pixel);
        from += row;
        out += static_cast<std::size_t>(m_spec.tile_width) * pixel;
    }
    return {};
}

}  // namespace osio::plugin
