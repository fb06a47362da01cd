// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>
#include <formats/reduce/subject.h>

#include <osio/reduce/bin_fit.h>
#include <osio/reduce/scene_basis.h>

#include <string>
#include <vector>

namespace osio::reduce {

/// A file that might do: which bands, how they are made of the original's, and what a reader makes of them.
struct Candidate {
    std::vector<double> edges_nm;  ///< of bins; none: all bands as they are
    WeightMatrix matrix;           ///< stored planes x the original's columns
    WeightMatrix expansion;  ///< bands x stored planes, which a reader undoes; none: the planes are bands
    WeightMatrix metric;     ///< of the fit, bands x bands; of bins
    SampleType type = SampleType::Half;
    double fidelity = 0;
    image::Part part;                    ///< as a reader has it: bands, then alpha, and attributes
    std::vector<image::Channel> stored;  ///< the planes in the order of the matrix, then alpha
    std::vector<CollapsePlan>
        plans;             ///< of its bands, by the rules that every reader here follows; one a demand
    WeightMatrix weights;  ///< of all plans, 3 rows each, by the part's bands
};

/// Bins with these edges, as they are fitted. The refusals of make_plan().
[[nodiscard]] Result<Candidate> bin_candidate(const Subject& subject, const BinFit& fit,
                                              std::vector<double> edges_nm, double fidelity, SampleType type,
                                              const TextLoader& load_text);

/// All bands that some demand needs as they are, but for their type.
[[nodiscard]] Result<Candidate> whole_candidate(const Subject& subject, SampleType type,
                                                const TextLoader& load_text);

/// Coefficients of a scene's own curves, which are kept in the header.
[[nodiscard]] Result<Candidate> scene_candidate(const Subject& subject, const SceneFit& fit,
                                                std::size_t count, double fidelity, SampleType type,
                                                const TextLoader& load_text);

/// The header of the file, with all that a reader needs to know of the planes.
[[nodiscard]] Imf::Header written_header(const Candidate& candidate);

/// The same file for other demands.
[[nodiscard]] Result<Candidate> for_demands(const Candidate& candidate, const Subject& other,
                                            const TextLoader& load_text);

/// What the original has and such a file does not, in words.
[[nodiscard]] std::vector<std::string> losses(const Subject& subject, const Candidate& candidate);

}  // namespace osio::reduce
