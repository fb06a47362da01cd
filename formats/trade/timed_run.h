// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/exr_writer.h>

#include <osio/collapse/collapse_stream.h>

#include <OpenEXR/ImfHeader.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace osio::trade {

/// A way from a spectral file to an EXR.
struct Run {
    std::function<Result<std::unique_ptr<BlockSource>>()> open;
    std::function<Result<void>(const BlockSource&, RowRange, RowSink&)> collapse;
    Imf::Header header;  ///< of all rows
    std::vector<exr::OutputChannel> channels;
    SampleType type = SampleType::Float;
    int row_step = 1;    ///< only every so many rows is written, from the first on
    std::string output;  ///< path, written over
};

/// Seconds of a run. What workers spend in readers and in sinks is divided by the workers; `collapse` is the rest.
struct Times {
    double open = 0;  ///< both files
    double decode = 0;
    double collapse = 0;
    double write = 0;

    [[nodiscard]] double total() const { return open + decode + collapse + write; }

    Times& operator+=(const Times& other);
};

/// Makes the run for some rows, anew from opening the file on.
[[nodiscard]] Result<Times> timed_run(const Run& run, RowRange rows, unsigned workers);

/// What a run of all rows would take, and how many rows tell it.
struct Forecast {
    Times times;
    int rows_run = 0;
    int rows = 0;
};

/// Forecasts a run by making it for a few strips of whole blocks, evenly spread over the image, and for a shorter one: a
/// straight line through both. A small image is run as a whole. `workers` as for timed_run().
[[nodiscard]] Result<Forecast> forecast_run(const Run& run, RowRange rows, unsigned workers);

/// The strips that a forecast runs.
[[nodiscard]] std::vector<RowRange> forecast_strips(const BlockSource& source, RowRange rows,
                                                    unsigned workers);

}  // namespace osio::trade
