// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/budget/error_budget.h>
#include <osio/colour/rgb_space.h>

namespace osio {

/// How far a stored value is from the sum it was made of, both as linear light.
class StoredError {
  public:
    StoredError(StoredDepth depth, Transfer transfer) : m_depth(depth), m_transfer(transfer) {}

    /// Half a unit in the last place of the stored type (float: none, which the sum has already), through the
    /// inverse of the curve at its steepest; all that was taken where the value is beyond the type's range, and
    /// then `clamped` becomes true.
    [[nodiscard]] double of(float sum, bool& clamped) const;

  private:
    [[nodiscard]] double of_stored(double value, bool& clamped) const;

    StoredDepth m_depth;
    Transfer m_transfer;
};

}  // namespace osio
