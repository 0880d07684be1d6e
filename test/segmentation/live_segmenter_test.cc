// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/segmentation/live_segmenter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "segmentation/synthetic_scene.h"

namespace semslam {
namespace {

constexpr double kVoxelSize = 0.008;

std::uint64_t KeyAt(const Eigen::Vector3f& point) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(double{point[axis]} / kVoxelSize));
    key = key << 21 | static_cast<std::uint64_t>(cell + (std::int64_t{1} << 20));
  }
  return key;
}

struct MapPoint {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float count = 0;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  std::uint32_t owner = 0;
};

// A voxel map that is filled bit by bit, and its live segments.
class GrowingMap {
 public:
  explicit GrowingMap(const LiveSegmenter::Options& options) : live(options) {}

  // Adds the scene's points that `is_seen`, which are new.
  template <typename IsSeen>
  void Add(const test::SyntheticScene& scene, const IsSeen& is_seen) {
    LiveSegmenter::Changes changes;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      if (is_seen(scene.points[i])) AddPoint(scene, i, changes);
    }
    live.Update(changes);
  }
  std::uint64_t AddPoint(const test::SyntheticScene& scene,
                         std::size_t i,
                         LiveSegmenter::Changes& changes) {
    const std::uint64_t key = KeyAt(scene.points[i]);
    MapPoint& point = points[key];
    if (point.count == 0) changes.appeared.push_back(key);
    point.sum += scene.points[i];
    point.count += 1;
    point.normal = scene.normals[i];
    point.owner = scene.truth[i];
    return key;
  }
  void Segment(const LiveSegmenter::Region& region) {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
    for (const std::uint64_t key : region.voxels) {
      const MapPoint& point = points.at(key);
      positions.push_back(point.sum / point.count);
      normals.push_back(point.normal);
    }
    live.Segment(region, {positions, normals});
  }
  // Until nothing is left to do; the number of steps.
  int SegmentAll() {
    int num_steps = 0;
    for (auto region = live.NextRegion(); !region.empty() && num_steps < 1000;
         region = live.NextRegion()) {
      Segment(region);
      ++num_steps;
    }
    return num_steps;
  }
  // The id that most voxels of an owner have.
  SegmentId IdOfOwner(std::uint32_t owner) const {
    std::map<SegmentId, std::size_t> counts;
    for (const auto& [key, point] : points) {
      if (point.owner == owner) ++counts[live.IdOf(key)];
    }
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? 0 : most->first;
  }
  std::set<SegmentId> Ids() const {
    std::set<SegmentId> ids;
    for (const auto& [key, point] : points) ids.insert(live.IdOf(key));
    return ids;
  }

  LiveSegmenter live;
  std::map<std::uint64_t, MapPoint> points;
};

LiveSegmenter::Options Regions(std::size_t max_voxels) {
  LiveSegmenter::Options options;
  options.segmentation.num_threads = 1;
  options.max_voxels = max_voxels;
  return options;
}
LiveSegmenter::Options LargeRegions() { return Regions(1'000'000); }

// Larger than small regions.
test::SyntheticScene WideFloor() {
  test::SyntheticScene floor;
  floor.AddRectangle({0, 0, 0}, {1.5, 0, 0}, {0, 1.5, 0}, 1);
  return floor;
}

const auto kEverything = [](const Eigen::Vector3f&) { return true; };

TEST(LiveSegmenter, FindsTheThingsOfAWholeMapAtOnce) {
  const test::SyntheticScene desk = test::MakeDesk();
  GrowingMap map(LargeRegions());
  map.Add(desk, kEverything);
  EXPECT_EQ(map.SegmentAll(), 1);
  std::set<SegmentId> ids;
  for (std::uint32_t owner = 1; owner <= 5; ++owner) ids.insert(map.IdOfOwner(owner));
  EXPECT_EQ(ids.size(), 5U);
  EXPECT_FALSE(ids.contains(0));
}

TEST(LiveSegmenter, SegmentsKeepTheirIdsWhileTheyGrow) {
  const test::SyntheticScene desk = test::MakeDesk();
  GrowingMap map(LargeRegions());
  std::map<std::uint32_t, SegmentId> first_ids;
  float last = -1;
  for (const float reach : {0.7F, 0.85F, 1.0F, 1.3F}) {
    map.Add(desk, [&](const Eigen::Vector3f& p) { return p.x() < reach && p.x() >= last; });
    last = reach;
    map.SegmentAll();
    for (const std::uint32_t owner : {1U, 2U}) {  // Desk and wall grow each time.
      const SegmentId id = map.IdOfOwner(owner);
      ASSERT_NE(id, 0U);
      ASSERT_EQ(first_ids.try_emplace(owner, id).first->second, id) << "owner " << owner;
    }
  }
}

TEST(LiveSegmenter, PiecesThatTurnOutToBeOneKeepTheOldestId) {
  test::SyntheticScene floor;
  floor.AddRectangle({0, 0, 0}, {1.2, 0, 0}, {0, 0.5, 0}, 1);
  const auto left = [](const Eigen::Vector3f& p) { return p.x() < 0.4F; };
  const auto right = [](const Eigen::Vector3f& p) { return p.x() > 0.8F; };
  const auto between = [&](const Eigen::Vector3f& p) { return !left(p) && !right(p); };
  LiveSegmenter::Options options = LargeRegions();
  options.segmentation.components.max_gap = 0.1;
  GrowingMap map(options);
  map.Add(floor, left);
  map.SegmentAll();
  const SegmentId oldest = map.IdOfOwner(1);
  map.Add(floor, right);
  map.SegmentAll();
  ASSERT_EQ(map.Ids().size(), 2U);
  map.Add(floor, between);
  map.SegmentAll();
  EXPECT_EQ(map.Ids(), std::set<SegmentId>{oldest});
  EXPECT_EQ(map.live.num_segments(), 1U);
}

TEST(LiveSegmenter, StepsAreNoLargerThanARegionAndComeToAnEnd) {
  const test::SyntheticScene floor = WideFloor();
  const LiveSegmenter::Options options = Regions(10000);
  GrowingMap map(options);
  map.Add(floor, kEverything);
  int num_steps = 0;
  for (auto region = map.live.NextRegion(); !region.empty(); region = map.live.NextRegion()) {
    ASSERT_LE(region.voxels.size(), options.max_voxels);
    ASSERT_LT(++num_steps, 100);
    map.Segment(region);
  }
  EXPECT_GT(num_steps, 3);
  for (const auto& [key, point] : map.points) ASSERT_NE(map.live.IdOf(key), 0U);
}

TEST(LiveSegmenter, TheRegionIsSmallerAfterALargeUpdate) {
  const test::SyntheticScene floor = WideFloor();
  const LiveSegmenter::Options options = Regions(20000);
  GrowingMap map(options);
  map.Add(floor, kEverything);
  const std::size_t after_large = map.live.NextRegion().voxels.size();
  map.live.Update({});
  EXPECT_LT(after_large + 3000, map.live.NextRegion().voxels.size());
}

// Points that are not finite cost hardly anything to segment.
TEST(LiveSegmenter, WhatAStepLeavesGoesToTheNext) {
  const test::SyntheticScene floor = WideFloor();
  const LiveSegmenter::Options options = Regions(10000);
  GrowingMap map(options);
  map.Add(floor, kEverything);
  map.live.Update({});
  const LiveSegmenter::Region region = map.live.NextRegion();
  const std::vector<Eigen::Vector3f> nowhere(
      region.voxels.size(), Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  map.live.Segment(region, {nowhere, {}});
  EXPECT_GT(map.live.NextRegion().voxels.size(), region.voxels.size() + 1000);
}

// A region sees only a part of the floor: the rest is no other segment.
TEST(LiveSegmenter, AFloorSegmentedBitByBitIsOne) {
  const test::SyntheticScene floor = WideFloor();
  const LiveSegmenter::Options options = Regions(15000);
  GrowingMap map(options);
  float last = -1;
  for (const float reach : {0.6F, 1.1F, 1.6F}) {
    map.Add(floor, [&](const Eigen::Vector3f& p) { return p.x() < reach && p.x() >= last; });
    last = reach;
    map.SegmentAll();
  }
  EXPECT_EQ(map.Ids().size(), 1U);
}

TEST(LiveSegmenter, IdsFollowPointsThatAreMoved) {
  const test::SyntheticScene desk = test::MakeDesk();
  test::SyntheticScene moved = desk;
  for (Eigen::Vector3f& point : moved.points) point += Eigen::Vector3f(0.304F, 0.104F, 0.048F);
  GrowingMap map(LargeRegions());
  map.Add(desk, kEverything);
  map.SegmentAll();
  std::vector<SegmentId> before;
  for (std::uint32_t owner = 1; owner <= 5; ++owner) before.push_back(map.IdOfOwner(owner));

  LiveSegmenter::Changes changes;
  for (const auto& [key, point] : map.points) changes.vanished.push_back(key);
  map.points.clear();
  for (std::size_t i = 0; i < moved.points.size(); ++i) {
    const std::uint64_t key = map.AddPoint(moved, i, changes);
    if (i % 50 == 0) changes.moved.emplace_back(KeyAt(desk.points[i]), key);
  }
  map.live.Update(changes);
  map.Segment(map.live.WholeMap());
  for (std::uint32_t owner = 1; owner <= 5; ++owner) {
    EXPECT_EQ(map.IdOfOwner(owner), before[owner - 1]) << "owner " << owner;
  }
}

TEST(LiveSegmenter, WhatStaysAsItIsCostsNothing) {
  const test::SyntheticScene desk = test::MakeDesk();
  GrowingMap map(LargeRegions());
  map.Add(desk, kEverything);
  map.SegmentAll();
  LiveSegmenter::Changes again;
  for (const auto& [key, point] : map.points) again.appeared.push_back(key);
  map.live.Update(again);
  EXPECT_TRUE(map.live.NextRegion().empty());
  EXPECT_EQ(map.live.num_voxels(), map.points.size());
}

TEST(LiveSegmenter, PointsThatAreNotFiniteBelongToNoSegment) {
  const test::SyntheticScene desk = test::MakeDesk();
  GrowingMap map(LargeRegions());
  map.Add(desk, kEverything);
  const LiveSegmenter::Region region = map.live.WholeMap();
  const std::vector<Eigen::Vector3f> nowhere(
      region.voxels.size(), Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  map.live.Segment(region, {nowhere, {}});
  EXPECT_EQ(map.Ids(), std::set<SegmentId>{0});
}

TEST(LiveSegmenter, VoxelsThatVanishTakeTheirSegmentsWithThem) {
  const test::SyntheticScene desk = test::MakeDesk();
  GrowingMap map(LargeRegions());
  map.Add(desk, kEverything);
  map.SegmentAll();
  LiveSegmenter::Changes changes;
  for (const auto& [key, point] : map.points) changes.vanished.push_back(key);
  map.live.Update(changes);
  EXPECT_EQ(map.live.num_voxels(), 0U);
  EXPECT_EQ(map.live.num_segments(), 0U);
  EXPECT_TRUE(map.live.NextRegion().empty());
  EXPECT_TRUE(map.live.WholeMap().empty());
}

TEST(LiveSegmenter, NonsenseOptionsAreRefused) {
  LiveSegmenter::Options options;
  options.block_size = 12;
  EXPECT_THROW(LiveSegmenter{options}, std::invalid_argument);
}

}  // namespace
}  // namespace semslam
