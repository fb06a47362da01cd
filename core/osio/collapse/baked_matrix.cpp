// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/baked_matrix.h>
#include <osio/colour/matrix_fit.h>
#include <osio/colour/reflectance_set.h>

#include <array>

namespace osio {

namespace {

constexpr std::array<std::pair<std::string_view, MatrixKind>, 5> kKinds{{
    {"adaptation", MatrixKind::Adaptation},
    {"primaries", MatrixKind::Primaries},
    {"relight", MatrixKind::Relight},
    {"observer", MatrixKind::Observer},
    {"camera", MatrixKind::Camera},
}};

Result<ReflectanceSet> load_reflectances(const std::string& name, const TextLoader& load_text) {
    if (!is_table_path(name))
        return find_reflectance_set(name);
    OSIO_TRY(const std::string csv, load_text(name));
    return reflectance_set_from_csv(csv, name);
}

Result<Observer> colorimetric(const std::string& name) {
    OSIO_TRY(Observer observer, find_observer(name));
    if (observer.kind != ObserverKind::Colorimetric)
        return fail(ErrorCode::Usage,
                    "observer " + name + " has no colour; expected one with X, Y, Z, such as cie1931");
    return observer;
}

Result<OutputSpace> linear_space(const std::string& name) {
    OSIO_TRY(OutputSpace space, find_output_space(name));
    if ((space.kind != SpaceKind::Rgb && space.kind != SpaceKind::XyzD65) ||
        space.transfer != Transfer::Linear)
        return fail(ErrorCode::Usage,
                    space.id + " is no linear space with a white; expected one such as lin_rec709, "
                               "acescg, xyz_d65 or rgb:...");
    return space;
}

Matrix3 xyz_from(const OutputSpace& space) {
    return space.kind == SpaceKind::Rgb ? xyz_from_rgb(space) : Matrix3::identity();
}

Vector3 white_of(const OutputSpace& space) {
    return space.kind == SpaceKind::Rgb ? space.white.xyz() : kD65.xyz();
}

Vector3 curve_integrals(const NmSamples& radiance, const Observer& observer) {
    const auto with = [&](std::size_t c) {
        return integral(radiance, observer.curves[c], Quadrature::Sum1nm);
    };
    return {with(0), with(1), with(2)};
}

/// Integrals of light x reflectance x each curve, each times `k`.
std::vector<Vector3> colours(const ReflectanceSet& set, const Illuminant& light, const Observer& observer,
                             const Vector3& k) {
    std::vector<Vector3> out;
    for (const NmSamples& reflectance : set.spectra) {
        NmSamples reflected = reflectance;
        for (std::size_t i = 0; i < reflected.size(); ++i)
            reflected[i] *= light.power[i];
        const Vector3 sums = curve_integrals(reflected, observer);
        out.push_back({k[0] * sums[0], k[1] * sums[1], k[2] * sums[2]});
    }
    return out;
}

/// What makes the perfect diffuser's Y 1.
Vector3 normalised_to_y(const Illuminant& light, const Observer& observer) {
    const double k = 1 / curve_integrals(light.power, observer)[1];
    return {k, k, k};
}

/// What makes the perfect diffuser (1, 1, 1).
Vector3 balanced(const Illuminant& light, const Observer& camera) {
    const Vector3 sums = curve_integrals(light.power, camera);
    return {1 / sums[0], 1 / sums[1], 1 / sums[2]};
}

std::vector<Vector3> through(const Matrix3& matrix, std::vector<Vector3> colours) {
    for (Vector3& colour : colours)
        colour = matrix * colour;
    return colours;
}

/// A word without effect is a mistake that nobody would notice.
Result<void> check_words(const MatrixRequest& request) {
    const MatrixKind kind = request.kind;
    const bool fitted = kind != MatrixKind::Adaptation && kind != MatrixKind::Primaries;
    const bool camera = kind == MatrixKind::Camera;

    struct Word {
        std::string_view name;
        bool given, used;
    };

    const std::array<Word, 5> words{{
        {"illuminant", !request.illuminant.empty(), camera || kind == MatrixKind::Observer},
        {"observer", !request.observer.empty(),
         camera || kind == MatrixKind::Adaptation || kind == MatrixKind::Relight},
        {"reflectances", !request.reflectances.empty(), fitted},
        {"keep-white", request.keep_white, fitted},
        {"adapt", request.adaptation.has_value(), camera || !fitted},
    }};
    for (const Word& word : words)
        if (word.given && !word.used)
            return fail(ErrorCode::Usage, std::string(word.name) + " was given, which " +
                                              std::string(matrix_kind_name(kind)) +
                                              " has no use for; leave it out");
    return {};
}

class Baker {
  public:
    Baker(const MatrixRequest& request, const TextLoader& load_text)
        : m_request(request), m_load_text(load_text),
          m_adaptation(request.adaptation.value_or(Adaptation::Bradford)) {
        const auto set_default = [](std::string& value, const char* otherwise) {
            if (value.empty())
                value = otherwise;
        };
        set_default(m_request.illuminant, "D65");
        set_default(m_request.observer, "cie1931");
        set_default(m_request.reflectances, "colorchecker");
    }

    Result<BakedMatrix> bake() {
        const auto done = run();
        if (!done)
            return tl::unexpected(done.error());
        return std::move(m_out);
    }

  private:
    Result<void> run() {
        switch (m_request.kind) {
        case MatrixKind::Adaptation: return adaptation();
        case MatrixKind::Primaries: return primaries();
        case MatrixKind::Relight: return relight();
        case MatrixKind::Observer: return observer();
        case MatrixKind::Camera: return camera();
        }
        return {};
    }

    /// Two lights that one observer sees.
    struct Lights {
        Observer observer;
        Illuminant from, to;
        Vector3 from_white, to_white;
    };

    Result<Lights> lights() {
        OSIO_TRY(Observer seen, colorimetric(m_request.observer));
        OSIO_TRY(Illuminant from, light("from light", m_request.from));
        OSIO_TRY(Illuminant to, light("to light", m_request.to));
        use("observer", seen.id, seen.source, seen.digest);
        OSIO_TRY(const Vector3 from_white, white_point(from, seen));
        OSIO_TRY(const Vector3 to_white, white_point(to, seen));
        name("XYZ under " + from.id, "XYZ under " + to.id);
        return Lights{std::move(seen), std::move(from), std::move(to), from_white, to_white};
    }

    Result<void> adaptation() {
        OSIO_TRY(const Lights two, lights());
        OSIO_TRY(m_out.matrix, adaptation_matrix(m_adaptation, two.from_white, two.to_white));
        m_out.title += ", adapted by " + std::string(adaptation_name(m_adaptation));
        return {};
    }

    Result<void> primaries() {
        OSIO_TRY(const OutputSpace from, linear_space(m_request.from));
        OSIO_TRY(const OutputSpace to, linear_space(m_request.to));
        OSIO_TRY(const Matrix3 adapt, adaptation_matrix(m_adaptation, white_of(from), white_of(to)));
        m_out.matrix = inverse(xyz_from(to)) * adapt * xyz_from(from);
        name(from.id, to.id);
        m_out.title += ", adapted by " + std::string(adaptation_name(m_adaptation));
        return {};
    }

    Result<void> relight() {
        OSIO_TRY(const Lights two, lights());
        OSIO_TRY(const ReflectanceSet set, reflectances());
        const auto under = [&](const Illuminant& light) {
            return colours(set, light, two.observer, normalised_to_y(light, two.observer));
        };
        return fit({two.from_white, two.to_white}, under(two.from), under(two.to), Matrix3::identity(),
                   two.to_white);
    }

    Result<void> observer() {
        OSIO_TRY(const Observer from, colorimetric(m_request.from));
        OSIO_TRY(const Observer to, colorimetric(m_request.to));
        use("from observer", from.id, from.source, from.digest);
        use("to observer", to.id, to.source, to.digest);
        OSIO_TRY(const Illuminant under, light("light", m_request.illuminant));
        OSIO_TRY(const Vector3 white, white_point(under, to));
        OSIO_TRY(const ReflectanceSet set, reflectances());
        name("XYZ of " + from.id, "XYZ of " + to.id);
        m_out.title += ", under " + under.id;
        OSIO_TRY(const Vector3 from_white, white_point(under, from));
        return fit({from_white, white}, colours(set, under, from, normalised_to_y(under, from)),
                   colours(set, under, to, normalised_to_y(under, to)), Matrix3::identity(), white);
    }

    Result<void> camera() {
        OSIO_TRY(const std::string csv, m_load_text(m_request.from));
        OSIO_TRY(const Observer camera, camera_from_csv(csv, m_request.from));
        OSIO_TRY(const OutputSpace to, linear_space(m_request.to));
        OSIO_TRY(const Observer seen, colorimetric(m_request.observer));
        use("camera", camera.id, camera.source, camera.digest);
        use("observer", seen.id, seen.source, seen.digest);
        OSIO_TRY(const Illuminant under, light("light", m_request.illuminant));
        OSIO_TRY(const Vector3 white, white_point(under, seen));
        OSIO_TRY(const ReflectanceSet set, reflectances());
        OSIO_TRY(const Matrix3 adapt, adaptation_matrix(m_adaptation, white, white_of(to)));
        name("R, G, B of " + camera.id + " balanced for " + under.id, to.id);
        const auto wanted =
            through(inverse(xyz_from(to)) * adapt, colours(set, under, seen, normalised_to_y(under, seen)));
        const Vector3 target_white = inverse(xyz_from(to)) * adapt * white;
        return fit({{1, 1, 1}, target_white}, colours(set, under, camera, balanced(under, camera)), wanted,
                   xyz_from(to), white_of(to));
    }

    /// Fits; the residual is of XYZ, which `to_xyz` makes of what was fitted.
    Result<void> fit(const std::pair<Vector3, Vector3>& whites, const std::vector<Vector3>& from,
                     const std::vector<Vector3>& to, const Matrix3& to_xyz, const Vector3& white) {
        OSIO_TRY(m_out.matrix,
                 m_request.keep_white ? fit_matrix_keeping(whites, from, to) : fit_matrix(from, to));
        if (m_request.keep_white)
            m_out.title += ", white kept";
        m_out.fitted_spectra = from.size();
        m_out.residual = differences_of(through(to_xyz * m_out.matrix, from), through(to_xyz, to), white);
        return {};
    }

    Result<Illuminant> light(const std::string& role, const std::string& name) {
        OSIO_TRY(Illuminant light, load_illuminant(name, m_load_text));
        use(role, light.id, light.source, light.digest);
        return light;
    }

    Result<ReflectanceSet> reflectances() {
        OSIO_TRY(ReflectanceSet set, load_reflectances(m_request.reflectances, m_load_text));
        use("reflectances", set.id, set.source, set.digest);
        return set;
    }

    void use(std::string role, std::string name, std::string source, std::string digest) {
        m_out.tables.push_back({std::move(role), std::move(name), std::move(source), std::move(digest)});
    }

    void name(std::string input, std::string output) {
        m_out.title = std::string(matrix_kind_name(m_request.kind)) + ": " + input + " to " + output;
        m_out.input = std::move(input);
        m_out.output = std::move(output);
    }

    MatrixRequest m_request;
    const TextLoader& m_load_text;
    Adaptation m_adaptation;
    BakedMatrix m_out;
};

}  // namespace

std::vector<std::string> BakedMatrix::description() const {
    std::vector<std::string> out{title};
    out.push_back(residual ? "least squares over " + std::to_string(fitted_spectra) +
                                 " spectra, residual CIEDE2000 mean " + format_fixed(residual->mean, 4) +
                                 ", max " + format_fixed(residual->max, 4)
                           : std::string("exact: no fit"));
    for (const UsedTable& table : tables)
        out.push_back(table.role + " " + table.name + ", digest " + table.digest + ": " + table.source);
    return out;
}

std::string_view matrix_kind_name(MatrixKind kind) {
    for (const auto& [name, known] : kKinds)
        if (known == kind)
            return name;
    return {};
}

Result<MatrixKind> find_matrix_kind(std::string_view name) {
    std::vector<std::string> names;
    for (const auto& [known, kind] : kKinds) {
        if (iequals(known, name))
            return kind;
        names.emplace_back(known);
    }
    return fail(ErrorCode::UnknownName,
                "nothing to bake is called \"" + std::string(name) + "\"" + suggestion(name, names));
}

Result<BakedMatrix> bake_matrix(const MatrixRequest& request, const TextLoader& load_text) {
    OSIO_CHECK_OK(check_words(request));
    return Baker(request, load_text).bake();
}

}  // namespace osio
