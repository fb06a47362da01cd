// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace osio {

/// Where a ColourTransform comes from, for plans and people.
struct TransformSource {
    std::string config_file;  ///< path of the colour config
    std::string config_name;  ///< the name that it gives itself; may be empty
    std::string config_id;    ///< differs where the config differs
    std::string from;         ///< the config's space in which pixels enter
    std::string processor;    ///< differs where what is done to pixels differs
};

/// What a colour config does to pixels after the sums over bands. It is never changed, and threads may
/// share it.
class ColourTransform {
  public:
    virtual ~ColourTransform() = default;

    /// Converts three planes of unassociated colour in place; every pixel by itself. `pixels` > 0.
    virtual void apply(std::span<float* const, 3> planes, std::size_t pixels) const = 0;

    /// True where it is a matrix without offsets, which colour associated with alpha may pass as it is.
    [[nodiscard]] virtual bool is_linear() const = 0;

    [[nodiscard]] virtual const TransformSource& source() const = 0;
};

}  // namespace osio
