// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/envi_file.h>
#include <formats/envi/envi_writer.h>
#include <formats/files/checked_file.h>
#include <formats/files/replacement_pair.h>

#include <osio/base/text.h>

#include <algorithm>
#include <bit>

namespace osio::envi {

namespace {

std::string list_text(const std::vector<double>& values) {
    std::string out = "{";
    for (std::size_t i = 0; i < values.size(); ++i)
        out += (i == 0 ? "\n" : ",\n") + format_double(values[i]);
    return out + "}";
}

std::string line(std::string_view key, std::string_view value) {
    return std::string(key) + " = " + std::string(value) + "\n";
}

}  // namespace

std::string header_text(const EnviOutput& output) {
    std::string out = "ENVI\n";
    out += line("file type", "ENVI Standard");
    out += line("samples", std::to_string(output.samples));
    out += line("lines", std::to_string(output.lines));
    out += line("bands", std::to_string(output.wavelengths_nm.size()));
    out += line("header offset", "0");
    out += line("data type", std::to_string(static_cast<int>(DataType::Float)));
    out += line("interleave", interleave_name(output.interleave));
    out += line("byte order", std::endian::native == std::endian::big ? "1" : "0");
    out += line("data units", output.quantity == Quantity::Radiance ? "Radiance" : "Reflectance");
    out += line("wavelength units", "Nanometers");
    out += line("wavelength", list_text(output.wavelengths_nm));
    if (!output.fwhm_nm.empty())
        out += line("fwhm", list_text(output.fwhm_nm));
    for (const Field& field : output.fields)
        out += line(field.label, field.list ? "{" + field.value + "}" : field.value);
    return out;
}

Result<std::string> data_path_for(const std::string& header_path) {
    const auto found = data_files_of(header_path);
    const std::string base = header_path.substr(0, header_path.size() - 4);
    const auto name = base.substr(base.find_last_of('/') + 1);
    const std::string own = name.find('.', 1) == std::string::npos ? base + ".img" : base;
    if (found.empty())
        return own;
    if (find_header(header_path) == header_path)
        return found.front();
    return fail(ErrorCode::Usage,
                "would be taken for the data of " + header_path +
                    ", which is not there yet; choose another name or move the file away",
                found.front());
}

struct EnviWriter::State {
    State(EnviOutput cube, files::ReplacementFile data_file, files::ReplacementFile header_file)
        : output(std::move(cube)), data(std::move(data_file)), header(std::move(header_file)),
          file(data.path()) {}

    [[nodiscard]] Result<void> check(bool written) const {
        if (written)
            return {};
        return fail(ErrorCode::Io, "cannot be written: " + file.failure(), data.target());
    }

    EnviOutput output;
    files::ReplacementFile data, header;
    files::CheckedFile file;
    std::size_t next_row = 0;
    std::vector<float> line;  ///< of all bands, for bip
};

EnviWriter::EnviWriter(std::unique_ptr<State> state) : m_state(std::move(state)) {}

EnviWriter::~EnviWriter() = default;

const std::string& EnviWriter::data_path() const {
    return m_state->data.target();
}

Result<std::unique_ptr<EnviWriter>> EnviWriter::create(const std::string& header_path, EnviOutput output) {
    OSIO_TRY(const std::string data_path, data_path_for(header_path));
    OSIO_TRY(auto header, files::ReplacementFile::create(header_path));
    OSIO_TRY(auto data, files::ReplacementFile::create(data_path));
    return std::unique_ptr<EnviWriter>(
        new EnviWriter(std::make_unique<State>(std::move(output), std::move(data), std::move(header))));
}

Result<void> EnviWriter::write_rows(int row_count, std::span<const float* const> planes) {
    State& state = *m_state;
    const std::size_t samples = state.output.samples, bands = planes.size();
    const auto rows = static_cast<std::size_t>(row_count);
    bool ok = true;
    if (state.output.interleave == Interleave::Bsq) {
        for (std::size_t band = 0; band < bands && ok; ++band)
            ok = state.file.seek((band * state.output.lines + state.next_row) * samples * sizeof(float)) &&
                 state.file.write(planes[band], rows * samples * sizeof(float));
    } else {
        for (std::size_t row = 0; row < rows && ok; ++row) {
            if (state.output.interleave == Interleave::Bil) {
                for (std::size_t band = 0; band < bands && ok; ++band)
                    ok = state.file.write(planes[band] + row * samples, samples * sizeof(float));
                continue;
            }
            state.line.resize(samples * bands);
            for (std::size_t band = 0; band < bands; ++band)
                for (std::size_t x = 0; x < samples; ++x)
                    state.line[x * bands + band] = planes[band][row * samples + x];
            ok = state.file.write(state.line.data(), state.line.size() * sizeof(float));
        }
    }
    state.next_row += rows;
    return state.check(ok);
}

Result<void> EnviWriter::finish(files::Durability durability) {
    State& state = *m_state;
    if (state.next_row != state.output.lines)
        return fail(ErrorCode::Io,
                    std::to_string(state.output.lines - state.next_row) + " rows were never written",
                    state.data.target());
    OSIO_CHECK_OK(state.check(state.file.close() == 0));
    const std::string text = header_text(state.output);
    files::CheckedFile header(state.header.path());
    header.write(text.data(), text.size());
    if (header.close() != 0)
        return fail(ErrorCode::Io, "cannot be written: " + header.failure(), state.header.target());
    return files::commit_pair(std::move(state.data), std::move(state.header), durability);
}

}  // namespace osio::envi
