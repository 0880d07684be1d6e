// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/network_options.h"

#include <string>

#include "semslam/base/error.h"

namespace semslam {

void NetworkOptions::Validate() const {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw InputError("detector: " + what);
  };
  const auto in_unit = [](float value) { return value >= 0 && value <= 1; };
  require(
      input_size >= 0 && input_size % 32 == 0 && input_size <= 4096,
      "input_size: expected 0 or a multiple of 32 up to 4096, found " + std::to_string(input_size));
  require(batch_size >= 1 && batch_size <= 64,
          "batch_size: expected 1 to 64, found " + std::to_string(batch_size));
  require(score_threshold > 0 && score_threshold <= 1,
          "score_threshold: expected 0 < score <= 1, found " + std::to_string(score_threshold));
  require(in_unit(nms_threshold),
          "nms_threshold: expected a number in [0, 1], found " + std::to_string(nms_threshold));
  require(in_unit(min_class_score) && min_class_score <= score_threshold,
          "min_class_score: expected a number from 0 to score_threshold, found " +
              std::to_string(min_class_score));
}

}  // namespace semslam
