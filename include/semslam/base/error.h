// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace semslam {

// Broken input or environment: a file that is missing or malformed, a device that is gone, a disk
// that is full. The text is one line that says what is wrong, where, what was found and what was
// expected:
//   config/TUM1.yaml: Camera.fx: expected a number > 0, found -517.3
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace semslam
