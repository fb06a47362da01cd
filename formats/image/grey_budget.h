// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <osio/budget/error_budget.h>

namespace osio::image {

/// The error budget of greys, equal in all bands and fluorescent in none, from 0 to 1 in hundredths: of what the perfect
/// diffuser reflects, or of a flat radiance of 1. Stored in the file's own types and written as floats. It reads no
/// pixel, so it is a scale for a plan and no certificate of an image. The refusals of ErrorBudget; Usage for a scale
/// that is not relative.
[[nodiscard]] Result<BudgetResult> grey_budget(const CollapseJob& job);

}  // namespace osio::image
