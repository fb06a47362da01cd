// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/choice.h>

#include <osio/collapse/stream.h>

#include <memory>
#include <string_view>
#include <vector>

namespace osio::convert {

/// A file that is being written. Until finish() its target is as it was; nothing stays where it is not called.
class Sink {
  public:
    virtual ~Sink() = default;

    /// A worker's way in. Blocks have the choice's channels as planes: process() converts and packs, deliver() hands
    /// on.
    [[nodiscard]] virtual std::unique_ptr<BlockVisitor> start() = 0;

    /// Rows that are packed together, where a block of as many can be packed by its worker alone; 0: any. Of files
    /// that are written in one pass each divides the largest, unless that is all rows.
    [[nodiscard]] virtual int rows_together() const { return 0; }

    /// Completes the file and adds to the outcome what became of it.
    [[nodiscard]] virtual Result<void> finish(files::Durability durability, Outcome& outcome) = 0;
};

/// Opens a sink for a choice, and says in the outcome's `lost` and `types` what it will hold.
using OpenSink = Result<std::unique_ptr<Sink>> (*)(const Request& request, const Choice& choice,
                                                   Outcome& outcome);

[[nodiscard]] Result<std::unique_ptr<Sink>> open_exr(const Request& request, const Choice& choice,
                                                     Outcome& outcome);
[[nodiscard]] Result<std::unique_ptr<Sink>> open_envi(const Request& request, const Choice& choice,
                                                      Outcome& outcome);

[[nodiscard]] Result<std::unique_ptr<Sink>> open_tiff(const Request& request, const Choice& choice,
                                                      Outcome& outcome);
[[nodiscard]] Result<std::unique_ptr<Sink>> open_png(const Request& request, const Choice& choice,
                                                     Outcome& outcome);

/// A format that is written.
struct Target {
    std::vector<std::string_view> endings;  ///< of the output's name, in lower case
    bool everything = false;                ///< takes all channels of a part; else the bands of one set
    OpenSink open = nullptr;
};

/// The format that an output's ending names. Usage where it names none.
[[nodiscard]] Result<const Target*> find_target(const std::string& output);

}  // namespace osio::convert
