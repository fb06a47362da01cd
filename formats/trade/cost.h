// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/temporary_folder.h>
#include <formats/trade/choice.h>
#include <formats/trade/timed_run.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace osio::trade {

/// The middle of several runs, and their ends.
struct Seconds {
    double median = 0;
    double fastest = 0;
    double slowest = 0;

    /// False where one's runs are all faster than all of the other's: noise does not hide which is.
    [[nodiscard]] bool same_as(const Seconds& other) const {
        return fastest <= other.slowest && other.fastest <= slowest;
    }
};

/// What a choice takes, from the file to a file.
struct Cost {
    Seconds all;
    Times middle;                  ///< of the run in the middle
    Forecast forecast;             ///< made before the runs
    std::uint64_t bytes_read = 0;  ///< of the file that is read
    std::uint64_t bytes_written = 0;
    double peak_mb = 0;  ///< resident memory of the process; 0 where the system does not tell
};

/// The process's peak of resident memory, MB (10^6 bytes).
struct MemoryMeter {
    std::function<void()> restart;
    std::function<double()> peak_mb;
};

/// Runs choices. What they read beside the image, and what they write, lies in a folder of its own, which goes
/// when the workbench does.
class Workbench {
  public:
    /// Io where no folder can be made below the system's own for temporary files.
    [[nodiscard]] static Result<std::unique_ptr<Workbench>> create(const image::CollapseJob& job,
                                                                   Choices choices, MemoryMeter meter);

    [[nodiscard]] const Choices& choices() const { return m_choices; }

    /// Forecasts one choice, then runs it so many times. Making the input that it needs is not counted.
    [[nodiscard]] Result<Cost> measure(std::size_t choice, int runs, const TextLoader& load_text,
                                       Runner& runner, const Progress& progress);

  private:
    struct Source;
    Workbench(const image::CollapseJob& job, Choices choices, MemoryMeter meter,
              files::TemporaryFolder folder);
    Result<Source> source_of(const Choice& choice, const TextLoader& load_text, Runner& runner,
                             const Progress& progress);
    Result<std::string> half_image(const OpenWords& words, Runner& runner, const Progress& progress);
    Result<std::string> colour_image(const TextLoader& load_text, Runner& runner, const Progress& progress);
    /// Refers to the source, the runner and the progress.
    Run run_of(const Choice& choice, const Source& source, Runner& runner, const Progress& progress) const;

    const image::CollapseJob& m_job;
    Choices m_choices;
    MemoryMeter m_meter;
    files::TemporaryFolder m_folder;
    std::string m_half, m_colour;  ///< paths, once they are made
};

}  // namespace osio::trade
