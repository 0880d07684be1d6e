// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "semslam/base/error.h"
#include "semslam/viewer/offscreen_context.h"

namespace semslam::testing {

// Why nothing can be drawn here; nothing if it can.
inline std::optional<std::string> WhyNoOpenGl() {
  try {
    const OffscreenContext context;
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }
}

// With SEMSLAM_REQUIRE_VIEWER in the environment, tests that cannot draw fail instead.
inline bool IsOpenGlRequired() { return std::getenv("SEMSLAM_REQUIRE_VIEWER") != nullptr; }

}  // namespace semslam::testing

// Ends a test where nothing can be drawn.
#define SEMSLAM_NEEDS_OPENGL()                                                        \
  if (const auto why = ::semslam::testing::WhyNoOpenGl()) {                           \
    if (::semslam::testing::IsOpenGlRequired()) FAIL() << "cannot draw: " << *why;    \
    GTEST_SKIP() << "cannot draw: " << *why << " (package libegl1, libgl1-mesa-dri)"; \
  }
