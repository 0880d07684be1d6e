// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/corners.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/features2d.hpp>

#include "semslam/base/random.h"

#include "features/test_images.h"

namespace semslam {
namespace {

cv::Rect Region() { return {19, 19, 602, 442}; }

// At positions of their own inside [x0, x1) of the region.
std::vector<Corner> RandomCorners(int count, int x0, int x1, double strength, std::uint64_t seed) {
  Random random(seed);
  std::set<std::pair<int, int>> positions;
  while (static_cast<int>(positions.size()) < count) {
    positions.emplace(random.Uniform(x0, x1), random.Uniform(Region().y, Region().br().y));
  }
  std::vector<Corner> corners;
  for (const auto& [x, y] : positions) {
    corners.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                       static_cast<float>(strength * random.Uniform(0.5, 1.0))});
  }
  return corners;
}

TEST(SpreadCorners, GivesAPoorRegionItsShare) {
  std::vector<Corner> corners = RandomCorners(3000, 19, 320, 100, 1);
  const std::vector<Corner> weak = RandomCorners(300, 320, 621, 10, 2);
  corners.insert(corners.end(), weak.begin(), weak.end());
  const std::vector<Corner> spread = SpreadCorners(corners, Region(), 400);
  ASSERT_EQ(spread.size(), 400u);
  EXPECT_GT(std::count_if(spread.begin(), spread.end(), [](const Corner& c) { return c.x >= 320; }),
            100);
}

TEST(SpreadCorners, KeepsTheStrongestOfAll) {
  std::vector<Corner> corners = RandomCorners(2000, 19, 621, 100, 3);
  corners[1234].response = 200;
  const std::vector<Corner> spread = SpreadCorners(corners, Region(), 100);
  EXPECT_TRUE(
      std::any_of(spread.begin(), spread.end(), [](const Corner& c) { return c.response == 200; }));
}

TEST(SpreadCorners, GivesTheWantedNumberOfDifferentCorners) {
  const std::vector<Corner> corners = RandomCorners(2000, 19, 621, 100, 4);
  for (const int wanted : {1, 2, 3, 10, 217, 1999}) {
    const std::vector<Corner> spread = SpreadCorners(corners, Region(), wanted);
    std::set<std::pair<int, int>> positions;
    for (const Corner& c : spread) positions.emplace(c.x, c.y);
    EXPECT_EQ(spread.size(), static_cast<std::size_t>(wanted));
    EXPECT_EQ(positions.size(), static_cast<std::size_t>(wanted));
  }
}

TEST(SpreadCorners, KeepsAllOfTooFew) {
  EXPECT_EQ(SpreadCorners(RandomCorners(30, 19, 621, 100, 5), Region(), 100).size(), 30u);
  EXPECT_TRUE(SpreadCorners({}, Region(), 100).empty());
}

TEST(DetectCorners, FindsEveryStrongCornerOfFast) {
  const cv::Mat image = MakeTexture(640, 480, 1);
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(image, keypoints, 20, true);
  std::set<std::pair<int, int>> found;
  for (const Corner& c : DetectCorners(image, 19, 20, 7)) found.emplace(c.x, c.y);
  int num_expected = 0;
  for (const cv::KeyPoint& k : keypoints) {
    // Further inside than the edge: on it, a stronger neighbour outside makes a difference.
    if (!cv::Rect(20, 20, 600, 440).contains(cv::Point(k.pt))) continue;
    ++num_expected;
    EXPECT_TRUE(found.contains({static_cast<int>(k.pt.x), static_cast<int>(k.pt.y)})) << k.pt;
  }
  EXPECT_GT(num_expected, 500);
}

TEST(DetectCorners, KeepsTheEdgeFree) {
  for (const Corner& c : DetectCorners(MakeTexture(200, 150, 1), 19, 20, 7)) {
    EXPECT_TRUE(cv::Rect(19, 19, 162, 112).contains(cv::Point(c.x, c.y)));
  }
}

}  // namespace
}  // namespace semslam
