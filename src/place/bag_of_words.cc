// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/bag_of_words.h"

#include <algorithm>

namespace semslam {

float Score(const BowVector& a, const BowVector& b) {
  // Of vectors with sum 1, 1 - |a - b|_1 / 2 is the sum of what they have in common.
  float common = 0;
  auto in_a = a.entries.begin();
  auto in_b = b.entries.begin();
  while (in_a != a.entries.end() && in_b != b.entries.end()) {
    if (in_a->word < in_b->word) {
      ++in_a;
    } else if (in_b->word < in_a->word) {
      ++in_b;
    } else {
      common += std::min(in_a->weight, in_b->weight);
      ++in_a;
      ++in_b;
    }
  }
  return common;
}

}  // namespace semslam
