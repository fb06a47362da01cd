// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/reduce/block_judge.h>

#include <osio/reduce/bin_search.h>

#include <vector>

namespace osio::reduce {

/// Spectra of about 4096 pixels of an image, of blocks in even steps over its rows: the same ones every time.
[[nodiscard]] Result<SpectrumSample> sample_image(const Subject& subject, Runner& runner,
                                                  const Progress& progress);

/// The largest CIEDE2000 of a candidate over a sample, one a demand; infinite where a colour is lost.
[[nodiscard]] std::vector<double> largest_differences(const Subject& subject, const Candidate& candidate,
                                                      const SpectrumSample& sample);

/// How far a candidate's curves are from the bands of a sample.
struct SpectrumLoss {
    double rms = 0;
    double largest = 0;
};

/// Over the sample and the bands that lie between the first and the last edge; nothing for all bands as they are.
[[nodiscard]] SpectrumLoss spectrum_loss(const Subject& subject, const Candidate& candidate,
                                         const SpectrumSample& sample);

}  // namespace osio::reduce
