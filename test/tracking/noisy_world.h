// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "support/synthetic_frames.h"

namespace semslam::testing {

// Tests in a world of points that are seen half a pixel off; all share it and its vocabulary.
class NoisyWorldTest : public ::testing::Test {
 protected:
  static const SyntheticWorld& World() {
    static const SyntheticWorld world({.pixel_noise = 0.5});
    return world;
  }
  static std::shared_ptr<const Vocabulary> Words() {
    static const std::shared_ptr<const Vocabulary> vocabulary = World().Train();
    return vocabulary;
  }
};

}  // namespace semslam::testing
