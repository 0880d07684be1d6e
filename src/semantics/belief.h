// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "semslam/semantics/class_table.h"

namespace semslam {

// What sums of evidence say a thing is: a distribution over all classes, background and unknown, in
// proportion to the evidence for each. `unknown` is what is always there for not knowing: it
// prevails while there is little evidence, and fades as there is more. The sums stay where they
// are; all in units of kEvidenceUnit.
class Belief {
 public:
  Belief(std::span<const std::int64_t> alpha, std::int64_t background, std::int64_t unknown);

  // kNoClass: background or unknown is at least as probable. Ties go to the lower id.
  int best_class() const { return best_class_; }
  double ProbabilityOf(int class_id) const;
  // Of being background, if that is the most probable; else 0.
  double background_confidence() const;
  // 0: sure; 1: all outcomes are equally probable.
  double Entropy() const;

 private:
  std::span<const std::int64_t> alpha_;
  std::int64_t background_;
  std::int64_t unknown_;
  double sum_;
  int best_class_ = kNoClass;
};

}  // namespace semslam
