// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/reduce/sample.h>

#include <optional>

namespace osio::reduce {

/// The candidate with the fewest bytes a pixel whose stored samples keep every demand within the tolerance on
/// the sample: bins as halves, bins as floats, or all bands as halves. Of its edges the samples that are
/// nearest to the spectrum. Nothing where only as many bytes as the original's, or more, would do.
[[nodiscard]] Result<std::optional<Candidate>> find_candidate(const Subject& subject, const BinFit& fit,
                                                              const SpectrumSample& sample, double tolerance,
                                                              const TextLoader& load_text);

/// The same of coefficients of the scene's own curves, as halves or as floats.
[[nodiscard]] Result<std::optional<Candidate>> find_scene_candidate(const Subject& subject, const BinFit& fit,
                                                                    const SpectrumSample& sample,
                                                                    double tolerance,
                                                                    const TextLoader& load_text);

}  // namespace osio::reduce
