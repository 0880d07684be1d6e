// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace semslam {

// OpenNI2 is there while one of these is. Throws InputError if it cannot be.
class OpenNiContext {
 public:
  OpenNiContext();
  OpenNiContext(const OpenNiContext&) = delete;
  OpenNiContext& operator=(const OpenNiContext&) = delete;
  ~OpenNiContext();
};

// What OpenNI2 says about the last failure in this thread, in one line; often nothing.
std::string OpenNiReason();

}  // namespace semslam
