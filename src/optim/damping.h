// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace semslam::internal {

// The damping of Levenberg-Marquardt: lambda times the diagonal of the normal equations is added to
// it, and lambda follows the ratio of actual to predicted decrease (Nielsen 1999).
class Damping {
 public:
  double lambda() const { return lambda_; }
  // What is added to a diagonal element. The floor keeps a coordinate nothing is known of in place.
  double Of(double diagonal) const { return lambda_ * std::max(diagonal, kMinDiagonal); }
  bool exhausted() const { return lambda_ > kMaxLambda; }

  void StepTaken(double actual_decrease, double predicted_decrease) {
    const double x = 2.0 * actual_decrease / predicted_decrease - 1.0;
    lambda_ *= std::max(1.0 / 3.0, 1.0 - x * x * x);
    growth_ = 2.0;
  }
  void StepRejected() {
    lambda_ *= growth_;
    growth_ *= 2.0;
  }

 private:
  static constexpr double kMinDiagonal = 1e-6;
  static constexpr double kMaxLambda = 1e12;

  double lambda_ = 1e-4;
  double growth_ = 2.0;
};

}  // namespace semslam::internal
