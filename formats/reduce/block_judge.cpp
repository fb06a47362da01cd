// SPDX-License-Identifier: Apache-2.0
#include <formats/reduce/block_judge.h>

#include <osio/collapse/kernel.h>
#include <osio/reduce/colour_check.h>

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace osio::reduce {

namespace {

constexpr float kHalfMax = 65504.0F;

std::vector<float*> pointers_into(std::vector<std::vector<float>>& planes, std::size_t first) {
    std::vector<float*> out;
    for (std::vector<float>& plane : planes)
        out.push_back(plane.data() + first);
    return out;
}

void resize(std::vector<std::vector<float>>& planes, std::size_t pixels) {
    for (std::vector<float>& plane : planes)
        plane.resize(pixels);
}

bool any_negative(std::span<const BandView> bands, std::size_t pixel) {
    return std::any_of(bands.begin(), bands.end(), [pixel](const BandView& band) {
        return band.data != nullptr && sample_at(band, pixel) < 0;
    });
}

}  // namespace

StoredCounts& StoredCounts::operator+=(const StoredCounts& other) {
    changed += other.changed;
    negative += other.negative;
    clamped += other.clamped;
    return *this;
}

BlockJudge::BlockJudge(const Subject& subject, const Candidate& candidate)
    : m_subject(subject), m_candidate(candidate), m_original(subject.weights.rows()),
      m_reduced(subject.weights.rows()), m_samples(candidate.matrix.rows()),
      m_stored(candidate.matrix.rows()), m_expanded(candidate.expansion.rows()),
      m_differences(subject.demands.size()), m_non_negative(candidate.metric),
      m_pixel(candidate.matrix.rows()) {}

void BlockJudge::judge(const PlanarBlock& block) {
    const std::size_t pixels =
        static_cast<std::size_t>(block.row_count) * static_cast<std::size_t>(block.width);
    m_counts = {};
    resize(m_original, pixels);
    resize(m_reduced, pixels);
    resize(m_samples, pixels);
    block.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> planes) {
        const auto bands = planes.first(m_subject.columns());
        collapse_run(bands, m_subject.weights, count, pointers_into(m_original, first));
        collapse_run(bands, m_candidate.matrix, count, pointers_into(m_samples, first));
        if (m_expanded.empty())
            keep_non_negative(first, count, bands);
    });
    store(pixels);
    m_bands.clear();
    for (const std::vector<std::byte>& plane : m_stored)
        m_bands.push_back(
            {plane.data(), m_candidate.type, static_cast<std::ptrdiff_t>(sample_bytes(m_candidate.type))});
    if (!m_expanded.empty())
        expand(pixels);
    collapse_run(m_bands, m_candidate.weights, pixels, pointers_into(m_reduced, 0));
    for (std::size_t d = 0; d < m_differences.size(); ++d) {
        std::array<const float*, 3> original{}, reduced{};
        for (std::size_t c = 0; c < 3; ++c) {
            original[c] = m_original[3 * d + c].data();
            reduced[c] = m_reduced[3 * d + c].data();
        }
        m_differences[d].resize(pixels);
        colour_differences(original, reduced, m_subject.demands[d].white, pixels, m_differences[d]);
    }
}

void BlockJudge::keep_non_negative(std::size_t first, std::size_t count, std::span<const BandView> original) {
    for (std::size_t i = 0; i < count; ++i) {
        std::uint64_t below = 0;
        bool defined = true;
        for (const std::vector<float>& plane : m_samples) {
            below += plane[first + i] < 0;
            defined = defined && std::isfinite(plane[first + i]);
        }
        if (below == 0 || !defined)
            continue;
        if (any_negative(original, i)) {
            m_counts.negative += below;
            continue;
        }
        ++m_counts.changed;
        for (std::size_t band = 0; band < m_pixel.size(); ++band)
            m_pixel[band] = static_cast<double>(m_samples[band][first + i]);
        m_non_negative.project(m_pixel);
        for (std::size_t band = 0; band < m_pixel.size(); ++band)
            m_samples[band][first + i] = static_cast<float>(m_pixel[band]);
    }
}

void BlockJudge::expand(std::size_t pixels) {
    resize(m_expanded, pixels);
    collapse_run(m_bands, m_candidate.expansion, pixels, pointers_into(m_expanded, 0));
    m_bands.clear();
    for (const std::vector<float>& plane : m_expanded) {
        for (const float sample : plane)
            m_counts.negative += sample < 0;
        m_bands.push_back(
            {reinterpret_cast<const std::byte*>(plane.data()), SampleType::Float, sizeof(float)});
    }
}

void BlockJudge::store(std::size_t pixels) {
    const std::size_t bytes = sample_bytes(m_candidate.type);
    for (std::size_t band = 0; band < m_samples.size(); ++band) {
        m_stored[band].resize(pixels * bytes);
        const std::vector<float>& from = m_samples[band];
        if (m_candidate.type == SampleType::Float) {
            std::memcpy(m_stored[band].data(), from.data(), pixels * bytes);
            continue;
        }
        for (std::size_t i = 0; i < pixels; ++i) {
            const bool beyond = std::abs(from[i]) > kHalfMax && std::isfinite(from[i]);
            m_counts.clamped += beyond;
            const std::uint16_t half =
                Imath::half(beyond ? std::copysign(kHalfMax, from[i]) : from[i]).bits();
            std::memcpy(m_stored[band].data() + i * bytes, &half, sizeof half);
        }
    }
}

}  // namespace osio::reduce
