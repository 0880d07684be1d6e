// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace semslam::internal {

// Huber's kernel on a squared error s with width d (limit = d^2): s up to the limit, 2 d sqrt(s) -
// d^2 above. The weight is its derivative; multiplied with M and g of a term it gives the step of
// iteratively reweighted least squares.
struct RobustCost {
  double cost;
  double weight;
};

inline RobustCost Huber(double squared_error, double limit) {
  if (squared_error <= limit) return {squared_error, 1.0};
  const double ratio = std::sqrt(limit / squared_error);
  return {2.0 * ratio * squared_error - limit, ratio};
}

}  // namespace semslam::internal
