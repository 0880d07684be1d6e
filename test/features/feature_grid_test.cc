// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/features/feature_grid.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "semslam/base/random.h"
#include "semslam/features/frame.h"

namespace semslam {
namespace {

constexpr PinholeCamera::Bounds kBounds{-12.5, -7.25, 655.0, 490.0};

std::vector<Keypoint> RandomKeypoints(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Keypoint> keypoints(count);
  for (Keypoint& k : keypoints) {
    // A few lie outside the bounds, as rounding can make them.
    k.pixel = {static_cast<float>(random.Uniform(kBounds.min_x - 2, kBounds.max_x + 2)),
               static_cast<float>(random.Uniform(kBounds.min_y - 2, kBounds.max_y + 2))};
    k.octave = static_cast<std::int16_t>(random.Index(8));
  }
  return keypoints;
}

TEST(FeatureGrid, FindsWhatAnExhaustiveSearchFinds) {
  const std::vector<Keypoint> keypoints = RandomKeypoints(1500, 1);
  const FeatureGrid grid(keypoints, kBounds);
  Random random(2);
  for (int query = 0; query < 2000; ++query) {
    const Eigen::Vector2f pixel(static_cast<float>(random.Uniform(-60, 700)),
                                static_cast<float>(random.Uniform(-60, 550)));
    const auto radius = static_cast<float>(random.Uniform(0, 80));
    const int min_octave = static_cast<int>(random.Index(8));
    const int max_octave = min_octave + static_cast<int>(random.Index(4));
    std::vector<int> expected;
    for (int i = 0; i < static_cast<int>(keypoints.size()); ++i) {
      const Keypoint& k = keypoints[i];
      if ((k.pixel - pixel).cwiseAbs().maxCoeff() <= radius && k.octave >= min_octave &&
          k.octave <= max_octave) {
        expected.push_back(i);
      }
    }
    std::vector<int> found = grid.FindInWindow(pixel, radius, min_octave, max_octave);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected) << "at " << pixel.transpose() << ", radius " << radius;
  }
}

TEST(FeatureGrid, OfNothingFindsNothing) {
  EXPECT_TRUE(FeatureGrid().FindInWindow({10, 10}, 1000, 0, 7).empty());
  EXPECT_TRUE(FeatureGrid({}, kBounds).FindInWindow({10, 10}, 1000, 0, 7).empty());
}

TEST(FeatureGrid, FindsNothingAroundAPixelThatIsNotANumber) {
  const std::vector<Keypoint> keypoints = RandomKeypoints(100, 3);
  const FeatureGrid grid(keypoints, kBounds);
  EXPECT_TRUE(grid.FindInWindow({NAN, 10}, 1000, 0, 7).empty());
}

}  // namespace
}  // namespace semslam
