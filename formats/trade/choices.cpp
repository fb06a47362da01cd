// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/choice.h>

#include <osio/base/text.h>
#include <osio/budget/output_colour.h>
#include <osio/collapse/baked_matrix.h>
#include <osio/colour/matrix_fit.h>

#include <OpenEXR/ImfChromaticitiesAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osio::trade {

namespace {

/// Where red, green and blue are looked for by those who pick three bands, nm.
constexpr std::array<double, 3> kPickedNm{610, 550, 465};

/// The light that a colour pipeline has its images under.
constexpr std::string_view kColourLight = "D65";

class ChoiceMaker {
  public:
    ChoiceMaker(const image::CollapseJob& job, const TextLoader& load_text, const OutputColour& colour)
        : m_job(job), m_plan(job.plan), m_load_text(load_text),
          m_output_from_share(inverse(colour.share_from_output)) {
        m_out.share_from_output = colour.share_from_output;
        m_out.white = colour.white;
        for (const PlanColumn& column : m_plan.columns)
            m_out.planes.emplace_back(column.channel);
        m_out.types = job.column_types();
        find_preview();
        if (const auto xyz = xyz_plan({}))
            if (const auto matrix = fit_matrix(columns_of(xyz->weights), columns_of(m_plan.weights)))
                m_output_from_xyz = *matrix;
    }

    Choices make() {
        add({"reference",
             "the obvious double loop, float output: the truth of this table",
             widened(m_plan.weights),
             {},
             {},
             Level::Reference});
        add({"exact", "osiotool collapse: the same numbers", widened(m_plan.weights)});
        Choice half{"half output", "the same, stored as half", widened(m_plan.weights)};
        half.half_output = true;
        add(half);
        if (std::any_of(m_out.types.begin(), m_out.types.end(),
                        [](SampleType t) { return t == SampleType::Float; }))
            add({"half bands", "the image converted to half bands first", widened(m_plan.weights),
                 Input::HalfImage});
        add_bases();
        for (const int step : {2, 4}) {
            Choice rows{"rows / " + std::to_string(step), "one row of " + std::to_string(step) + ", a proxy",
                        widened(m_plan.weights)};
            rows.row_step = step;
            add(rows);
        }
        for (const std::size_t step : {2U, 3U, 5U})
            add_fewer_bands(step);
        add_relight();
        add_preview();
        add_picked_bands();
        add_peers();
        return std::move(m_out);
    }

  private:
    void add(Choice choice) {
        for (std::size_t plane = 0; plane < choice.weights.bands(); ++plane)
            choice.bands += choice.weights.needs(plane);
        m_out.list.push_back(std::move(choice));
    }

    /// Weights of the plan's columns as weights of all planes.
    [[nodiscard]] WeightMatrix widened(const WeightMatrix& weights) const {
        WeightMatrix out(weights.rows(), m_out.planes.size());
        for (std::size_t row = 0; row < weights.rows(); ++row)
            for (std::size_t band = 0; band < weights.bands(); ++band)
                out.at(row, band) = weights.at(row, band);
        return out;
    }

    /// The plan for X, Y, Z, Y = 1 for the diffuser, under the job's light or another.
    [[nodiscard]] Result<CollapsePlan> xyz_plan(std::string_view light) const {
        CollapseRequest request = m_plan.request;
        if (!light.empty())
            request.illuminant = light;
        request.to = *find_output_space("xyz");
        request.white.clear();
        request.adaptation = CollapseRequest{}.adaptation;
        request.exposure_stops = 0;
        request.scale = Scale::Relative;
        return make_plan(m_job.set(), m_job.part().metadata, request, m_load_text);
    }

    [[nodiscard]] static std::vector<Vector3> columns_of(const WeightMatrix& weights) {
        std::vector<Vector3> out;
        for (std::size_t band = 0; band < weights.bands(); ++band)
            out.push_back({weights.at(0, band), weights.at(1, band), weights.at(2, band)});
        return out;
    }

    /// Weights of R, G, B from those of X, Y, Z.
    [[nodiscard]] WeightMatrix from_xyz(const Matrix3& output_from_xyz,
                                        const std::vector<Vector3>& xyz) const {
        WeightMatrix out(3, m_out.planes.size());
        for (std::size_t band = 0; band < xyz.size(); ++band) {
            const Vector3 rgb = output_from_xyz * xyz[band];
            for (std::size_t row = 0; row < 3; ++row)
                out.at(row, band) = rgb[row];
        }
        return out;
    }

    void add_bases() {
        for (const BasisInfo& info : bases()) {
            if (info.basis == m_plan.basis.basis || !basis_fits(info.basis, m_plan.distinct.grid))
                continue;
            CollapseRequest request = m_plan.request;
            request.basis = info.basis;
            if (const auto plan = make_plan(m_job.set(), m_job.part().metadata, request, m_load_text))
                add({"basis " + std::string(info.name), "the bands as " + std::string(info.meaning),
                     widened(plan->weights)});
        }
    }

    /// Every so many bands, with the weights that those alone have.
    void add_fewer_bands(std::size_t step) {
        SpectralSet fewer = m_job.set();
        fewer.bands.clear();
        fewer.reradiation.clear();
        std::vector<std::size_t> kept;
        for (std::size_t band = 0; band < m_plan.bands.size(); band += step) {
            fewer.bands.push_back(m_plan.bands[band]);
            kept.push_back(band);
        }
        if (fewer.bands.size() < 3)
            return;
        CollapseRequest request = m_plan.request;
        request.basis = Basis::Auto;
        const auto plan = make_plan(fewer, request, m_load_text);
        if (!plan)
            return;
        WeightMatrix weights(3, m_out.planes.size());
        for (std::size_t i = 0; i < kept.size(); ++i)
            for (std::size_t row = 0; row < 3; ++row)
                weights.at(row, kept[i]) = plan->weights.at(row, i);
        add({"bands / " + std::to_string(step),
             "one band of " + std::to_string(step) + ", with weights of its own", std::move(weights)});
    }

    /// The colour under another light and a matrix fitted to the ColorChecker.
    void add_relight() {
        if (!m_output_from_xyz || !m_plan.illuminant || iequals(m_plan.illuminant->id, kColourLight) ||
            !m_plan.filters.empty())
            return;
        MatrixRequest bake;
        bake.kind = MatrixKind::Relight;
        bake.from = kColourLight;
        bake.to = m_plan.illuminant->id;
        bake.observer = m_plan.observer.id;
        bake.keep_white = true;
        const auto baked = bake_matrix(bake, m_load_text);
        const auto under = xyz_plan(kColourLight);
        if (!baked || !under)
            return;
        const std::string light(kColourLight);
        const Matrix3 from_input = *m_output_from_xyz * baked->matrix;
        add({"3x3 from " + light,
             "no bands: the colour under " + light + " and a matrix fitted to the ColorChecker",
             from_xyz(from_input, columns_of(under->weights)), Input::ColourImage, from_input});
    }

    void find_preview() {
        const image::Part& part = m_job.part();
        std::vector<std::size_t> channels;
        for (const char* name : {"R", "G", "B"})
            if (const auto channel = part.layout.find_channel(name);
                channel && !part.channels[*channel].subsampled)
                channels.push_back(*channel);
        if (channels.size() != 3)
            return;
        m_preview_at = m_out.planes.size();
        for (const std::size_t channel : channels) {
            m_out.planes.emplace_back(channel);
            m_out.types.push_back(part.channels[channel].type);
        }
    }

    /// The file's own R, G, B: in its chromaticities, else linear Rec.709.
    void add_preview() {
        if (m_preview_at == 0)
            return;
        OutputSpace space = *find_output_space("lin_rec709");
        if (const auto* stated =
                m_job.part().header.findTypedAttribute<Imf::ChromaticitiesAttribute>("chromaticities")) {
            const Imf::Chromaticities& c = stated->value();
            const auto xy = [](const Imath::V2f& v) {
                return Chromaticity{static_cast<double>(v.x), static_cast<double>(v.y)};
            };
            space.red = xy(c.red);
            space.green = xy(c.green);
            space.blue = xy(c.blue);
            space.white = xy(c.white);
        }
        add({"own preview", "the file's R, G, B as they are", from_rgb(space, m_preview_at)});
    }

    /// R, G and B of a space from three planes.
    [[nodiscard]] WeightMatrix from_rgb(const OutputSpace& space, std::size_t first) const {
        // Whites are one: (1, 1, 1) of one space is that of the other.
        const Vector3 white = space.white.xyz();
        const Matrix3 share =
            Matrix3::diagonal({1 / white[0], 1 / white[1], 1 / white[2]}) * xyz_from_rgb(space);
        const Matrix3 output = m_output_from_share * share;
        WeightMatrix weights(3, m_out.planes.size());
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t c = 0; c < 3; ++c)
                weights.at(row, first + c) = output.rows[row][c];
        return weights;
    }

    void add_picked_bands() {
        const auto nearest = [this](double nm) {
            std::size_t best = 0;
            for (std::size_t i = 0; i < m_plan.bands.size(); ++i)
                if (std::abs(m_plan.bands[i].wavelength_nm - nm) <
                    std::abs(m_plan.bands[best].wavelength_nm - nm))
                    best = i;
            return best;
        };
        const OutputSpace space = *find_output_space("lin_rec709");
        const Vector3 white = space.white.xyz();
        const Matrix3 output =
            m_output_from_share *
            (Matrix3::diagonal({1 / white[0], 1 / white[1], 1 / white[2]}) * xyz_from_rgb(space));
        WeightMatrix weights(3, m_out.planes.size());
        std::string names;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t band = nearest(kPickedNm[c]);
            names += (c ? ", " : "") + format_double(m_plan.bands[band].wavelength_nm);
            for (std::size_t row = 0; row < 3; ++row)
                weights.at(row, band) += output.rows[row][c];
        }
        add({"three bands", "the bands at " + names + " nm taken for R, G, B", std::move(weights)});
    }

    /// Sums over the bands' own wavelengths, as most software makes them.
    void add_peers() {
        const std::size_t count = m_plan.bands.size();
        if (!m_output_from_xyz || count < 2)
            return;
        std::vector<Vector3> sums(count);
        double luminance = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double nm = m_plan.bands[i].wavelength_nm;
            const double below = m_plan.bands[i > 0 ? i - 1 : 0].wavelength_nm;
            const double above = m_plan.bands[std::min(i + 1, count - 1)].wavelength_nm;
            const double light = m_plan.illuminant ? at(m_plan.illuminant->power, nm) : 1;
            for (std::size_t c = 0; c < 3; ++c)
                sums[i][c] = light * at(m_plan.observer.curves[c], nm) * (above - below) / 2;
            luminance += sums[i][1];
        }
        if (!(luminance > 0))
            return;
        std::vector<Vector3> normalised = sums, plain = sums;
        // Lights' tables are 100 or 1 at 560 nm: a plain sum takes them as shares of that.
        const double scale = m_plan.illuminant ? at(m_plan.illuminant->power, 560) : 1;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                normalised[i][c] /= luminance;
                plain[i][c] /= scale;
            }
        const std::string light =
            m_plan.illuminant ? "the light sampled at the bands" : "the observer sampled at the bands";
        add({"band centres", light + ", divided by the sum for the diffuser",
             from_xyz(*m_output_from_xyz, normalised)});
        add({"plain sum", light + ", not normalised", from_xyz(*m_output_from_xyz, plain)});
    }

    [[nodiscard]] static double at(const NmSamples& samples, double nm) {
        const double place = nm - kObserverFirstNm;
        if (place < 0 || place > static_cast<double>(samples.size() - 1))
            return 0;
        const auto below = static_cast<std::size_t>(std::min(place, static_cast<double>(samples.size() - 2)));
        const double share = place - static_cast<double>(below);
        return (1 - share) * samples[below] + share * samples[below + 1];
    }

    const image::CollapseJob& m_job;
    const CollapsePlan& m_plan;
    const TextLoader& m_load_text;
    Matrix3 m_output_from_share;
    /// With exposure, scale and adaptation of the plan; nothing for fewer than three bands.
    std::optional<Matrix3> m_output_from_xyz;
    std::size_t m_preview_at = 0;
    Choices m_out;
};

}  // namespace

Result<Choices> make_choices(const image::CollapseJob& job, double white_luminance,
                             const TextLoader& load_text) {
    const CollapsePlan& plan = job.plan;
    if (plan.outputs.size() != 3 || plan.space.transfer != Transfer::Linear)
        return fail(ErrorCode::Usage, "to=" + plan.space.id +
                                          " is no linear space of three numbers, which a trade compares; "
                                          "expected xyz, xyz_d65 or a linear RGB "
                                          "space such as lin_rec709");
    OSIO_TRY(const OutputColour colour, output_colour(plan, white_luminance));
    return ChoiceMaker(job, load_text, colour).make();
}

}  // namespace osio::trade
