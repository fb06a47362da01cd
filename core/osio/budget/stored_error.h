// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/budget/error_budget.h>
#include <osio/colour/rgb_space.h>

namespace osio {

/// How far a stored value is from the sum it was made of, both as linear light.
class StoredError {
  public:
    StoredError(StoredDepth depth, Transfer transfer) : m_depth(depth), m_transfer(transfer) {}

    /// False where the stored value is the sum itself.
    [[nodiscard]] bool any() const { return m_depth != StoredDepth::Float || m_transfer != Transfer::Linear; }

    /// Half a unit in the last place of the stored type, through the inverse of the curve at its steepest; all
    /// that was taken where the value is beyond the type's range. Rounded up.
    [[nodiscard]] float of(float sum) const;

    /// True where the value is beyond the type's range.
    [[nodiscard]] bool clamps(float sum) const;

  private:
    [[nodiscard]] double of_stored(double value) const;
    [[nodiscard]] double of_encoded(double linear) const;

    StoredDepth m_depth;
    Transfer m_transfer;
};

}  // namespace osio
