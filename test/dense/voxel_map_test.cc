// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/voxel_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/base/random.h"
#include "semslam/dense/voxel_index.h"

#include "dense/synthetic_depth.h"

namespace semslam {
namespace {

using testing::Box;
using testing::RenderBoxes;
using testing::TestCamera;

const std::vector<Box>& Scene() {
  static const std::vector<Box> scene = {{{-3, -3, 1.5}, {3, 3, 1.6}, 10},
                                         {{-0.2, -0.1, 1.1}, {0.2, 0.3, 1.5}, 200},
                                         {{-3, 0.4, 0}, {3, 0.5, 3}, 100}};
  return scene;
}

std::shared_ptr<const KeyframeCloud> CloudSeenFrom(std::uint32_t id, const Rigid3& T_world_camera) {
  const auto rays = std::make_shared<const RayTable>(TestCamera());
  return BuildKeyframeCloud(KeyframeId{id}, RenderBoxes(Scene(), TestCamera(), T_world_camera),
                            rays, {});
}

Rigid3 PoseAt(double x, double turn) { return {ExpSO3({0.1, turn, 0.05}), {x, -0.1, 0.02}}; }

template <typename T>
bool SameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool SameBytes(const MapCloud& a, const MapCloud& b) {
  return a.voxel_size == b.voxel_size && SameBytes(a.positions, b.positions) &&
         SameBytes(a.normals, b.normals) && SameBytes(a.colors, b.colors) &&
         SameBytes(a.weights, b.weights) && SameBytes(a.num_views, b.num_views);
}

double DistanceToScene(const Eigen::Vector3d& p_world) {
  double nearest = 1e9;
  for (const Box& box : Scene()) {
    const Eigen::Vector3d outside =
        (box.low - p_world).cwiseMax(p_world - box.high).cwiseMax(Eigen::Vector3d::Zero());
    nearest = std::min(nearest, outside.norm());
  }
  return nearest;
}

TEST(VoxelMap, LiesOnTheSurfacesWithTheirNormals) {
  VoxelMap map({});
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Rigid3 pose = PoseAt(0.1 * i, 0.05 * i);
    map.Integrate(CloudSeenFrom(i, pose), pose);
  }
  const MapCloud cloud = map.Extract();
  ASSERT_GT(cloud.size(), 10000U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    // Beside an inner edge a voxel averages two faces.
    EXPECT_LT(DistanceToScene(cloud.positions[i].cast<double>()), 0.003);
    // Every face of the scene is parallel to an axis; only beside inner edges may windows mix.
    EXPECT_GT(cloud.normals[i].cwiseAbs().maxCoeff(), 0.6F);
    EXPECT_NEAR(cloud.normals[i].norm(), 1.0F, 1e-5F);
  }
}

TEST(VoxelMap, TurnsNormalsTowardsTheCameras) {
  VoxelMap map({});
  map.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  const MapCloud cloud = map.Extract();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_LT(cloud.normals[i].dot(cloud.positions[i]), 0.0F);
  }
}

TEST(VoxelMap, KeepsTheColours) {
  VoxelMap map({});
  map.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  const MapCloud cloud = map.Extract();
  const VoxelIndex index(cloud.positions, cloud.voxel_size);
  const auto box = index.Find({0, 0.1, 1.1});
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(cloud.colors[*box], (Rgb{200, 90, 200}));
}

TEST(VoxelMap, AfterRemovalIsWhatItWouldBeWithout) {
  const Rigid3 pose_a = PoseAt(0, 0);
  const Rigid3 pose_b = PoseAt(0.1, 0.1);
  VoxelMap both({});
  both.Integrate(CloudSeenFrom(0, pose_a), pose_a);
  both.Integrate(CloudSeenFrom(1, pose_b), pose_b);
  EXPECT_TRUE(both.Remove(KeyframeId{0}));
  VoxelMap only_b({});
  only_b.Integrate(CloudSeenFrom(1, pose_b), pose_b);
  EXPECT_EQ(both.num_voxels(), only_b.num_voxels());
  EXPECT_TRUE(SameBytes(both.Extract(), only_b.Extract()));
}

TEST(VoxelMap, DoesNotDependOnTheOrder) {
  VoxelMap forward({});
  VoxelMap backward({});
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Rigid3 pose = PoseAt(0.1 * i, 0.1 * i);
    forward.Integrate(CloudSeenFrom(i, pose), pose);
    const Rigid3 pose_back = PoseAt(0.1 * (2 - i), 0.1 * (2 - i));
    backward.Integrate(CloudSeenFrom(2 - i, pose_back), pose_back);
  }
  EXPECT_TRUE(SameBytes(forward.Extract(), backward.Extract()));
}

TEST(VoxelMap, FollowsAMovedKeyframeExactly) {
  const Rigid3 pose_b = PoseAt(0.1, 0.1);
  VoxelMap moved({});
  moved.Integrate(CloudSeenFrom(0, Rigid3()), PoseAt(0.3, 0.4));  // A wrong pose first.
  moved.Integrate(CloudSeenFrom(1, pose_b), pose_b);
  EXPECT_EQ(moved.UpdatePoses({{KeyframeId{0}, Rigid3()}, {KeyframeId{1}, pose_b}}), 1U);
  VoxelMap direct({});
  direct.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  direct.Integrate(CloudSeenFrom(1, pose_b), pose_b);
  EXPECT_TRUE(SameBytes(moved.Extract(), direct.Extract()));
}

TEST(VoxelMap, LeavesKeyframesThatMovedLessThanHalfAVoxel) {
  VoxelMap map({});
  map.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  EXPECT_EQ(map.UpdatePoses({{KeyframeId{0}, {ExpSO3({0, 0, 0}), {0.003, 0, 0}}}}), 0U);
  EXPECT_EQ(map.UpdatePoses({{KeyframeId{0}, {ExpSO3({0, 0, 0}), {0.005, 0, 0}}}}), 1U);
  // A small turn moves far points a lot.
  EXPECT_EQ(map.UpdatePoses({{KeyframeId{0}, {ExpSO3({0, 0.004, 0}), {0.005, 0, 0}}}}), 1U);
  EXPECT_EQ(map.UpdatePoses({{KeyframeId{0}, Rigid3()}}, 0.0), 1U);
}

TEST(VoxelMap, ReturnsItsMemoryWhenKeyframesLeave) {
  VoxelMap map({});
  map.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  const std::size_t bytes = map.memory_bytes();
  // The same wall over and over, ever further away from the last place.
  for (int i = 1; i <= 20; ++i) {
    EXPECT_EQ(map.UpdatePoses({{KeyframeId{0}, {ExpSO3({0, 0, 0}), {1.0 * i, 0, 0}}}}), 1U);
  }
  EXPECT_LT(map.memory_bytes(), 2 * bytes);
  map.Remove(KeyframeId{0});
  EXPECT_EQ(map.num_voxels(), 0U);
  EXPECT_EQ(map.Extract().size(), 0U);
  EXPECT_LT(map.memory_bytes(), bytes / 10);
}

TEST(VoxelMap, NeedsNoMoreThanSixtyBytesAVoxelWhenItIsLarge) {
  VoxelMap map({});
  const auto cloud = CloudSeenFrom(0, Rigid3());
  map.Integrate(cloud, Rigid3());
  for (std::uint32_t i = 1; i < 12; ++i) {
    const Rigid3 pose{ExpSO3({0, 0, 0}), {7.0 * i, 0, 0}};
    map.Integrate(CloudSeenFrom(i, Rigid3()), pose);
  }
  EXPECT_LE(static_cast<double>(map.memory_bytes()), 66.0 * static_cast<double>(map.num_voxels()));
}

TEST(VoxelMap, AtItsLimitRefusesNewVoxelsAndStillUndoesExactly) {
  VoxelMap::Options options;
  options.max_voxels = 5000;
  const Rigid3 pose_b = PoseAt(0.5, 0.3);
  VoxelMap map(options);
  map.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  EXPECT_EQ(map.num_voxels(), 5000U);
  EXPECT_GT(map.num_refused_points(), 0U);
  const MapCloud before = map.Extract();
  map.Integrate(CloudSeenFrom(1, pose_b), pose_b);
  map.Remove(KeyframeId{1});
  EXPECT_TRUE(SameBytes(map.Extract(), before));
  map.Remove(KeyframeId{0});
  EXPECT_EQ(map.num_voxels(), 0U);
  EXPECT_EQ(map.num_refused_points(), 0U);
}

TEST(VoxelMap, LeavesOutWhatTooFewKeyframesSaw) {
  VoxelMap::Options options;
  options.min_views = 2;
  const Rigid3 pose_b = PoseAt(0.3, 0.0);
  VoxelMap map(options);
  map.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  EXPECT_EQ(map.Extract().size(), 0U);
  map.Integrate(CloudSeenFrom(1, pose_b), pose_b);
  const MapCloud cloud = map.Extract();
  EXPECT_GT(cloud.size(), 100U);
  EXPECT_LT(cloud.size(), map.num_voxels());
  for (const std::uint32_t views : cloud.num_views) EXPECT_EQ(views, 2U);
}

TEST(VoxelMap, RefusesTheSameKeyframeTwice) {
  VoxelMap map({});
  const auto cloud = CloudSeenFrom(0, Rigid3());
  map.Integrate(cloud, Rigid3());
  EXPECT_THROW(map.Integrate(cloud, Rigid3()), std::logic_error);
  EXPECT_FALSE(map.Remove(KeyframeId{5}));
}

TEST(VoxelMap, SurvivesPosesThatAreNotFinite) {
  VoxelMap map({});
  const Rigid3 broken{Eigen::Quaterniond::Identity(), {std::nan(""), 0, 1e30}};
  map.Integrate(CloudSeenFrom(0, Rigid3()), broken);
  EXPECT_EQ(map.num_voxels(), 0U);
  EXPECT_EQ(map.UpdatePoses({{KeyframeId{0}, Rigid3()}}), 1U);
  EXPECT_GT(map.num_voxels(), 1000U);
}

TEST(VoxelMap, TellsOfEveryVoxelThatComesAndGoes) {
  VoxelMap map({});
  map.Integrate(CloudSeenFrom(0, PoseAt(0, 0)), PoseAt(0, 0));
  map.RecordChanges();
  std::set<std::uint64_t> known;
  const auto take = [&] {
    const VoxelMap::Changes changes = map.TakeChanges();
    for (const std::uint64_t key : changes.vanished) ASSERT_EQ(known.erase(key), 1U);
    for (const std::uint64_t key : changes.appeared) ASSERT_TRUE(known.insert(key).second);
    ASSERT_EQ(known.size(), map.num_voxels());
  };
  take();
  map.Integrate(CloudSeenFrom(1, PoseAt(0.3, 0.1)), PoseAt(0.3, 0.1));
  take();
  map.UpdatePoses({{KeyframeId{1}, PoseAt(0.5, 0.1)}});
  take();
  map.Remove(KeyframeId{0});
  take();
  map.Remove(KeyframeId{1});
  take();
}

TEST(VoxelMap, TellsNothingOfWhatWentAndCameBack) {
  VoxelMap map({});
  map.RecordChanges();
  map.Integrate(CloudSeenFrom(0, PoseAt(0, 0)), PoseAt(0, 0));
  map.TakeChanges();
  map.UpdatePoses({{KeyframeId{0}, PoseAt(3e-6, 0)}}, 0.0);
  EXPECT_LT(map.TakeChanges().appeared.size(), map.num_voxels() / 100);
}

TEST(VoxelMap, TellsWherePointsOfAMovedKeyframeWent) {
  VoxelMap map({});
  map.RecordChanges();
  map.Integrate(CloudSeenFrom(0, PoseAt(0, 0)), PoseAt(0, 0));
  map.TakeChanges();
  const Rigid3 moved = {PoseAt(0, 0).rotation,
                        PoseAt(0, 0).translation + Eigen::Vector3d(0.8, 0, 0)};
  map.UpdatePoses({{KeyframeId{0}, moved}});
  const VoxelMap::Changes changes = map.TakeChanges();
  ASSERT_GT(changes.moved.size(), 100U);
  const auto step =
      static_cast<std::int64_t>(VoxelKey::Pack({101, 0, 0}) - VoxelKey::Pack({1, 0, 0}));
  std::size_t num_exact = 0;  // Others crossed a border by rounding.
  for (const auto& [from, to] : changes.moved) {
    num_exact += static_cast<std::int64_t>(to - from) == step ? 1 : 0;
  }
  EXPECT_GT(num_exact, changes.moved.size() * 99 / 100);
}

TEST(VoxelMap, ExtractsTheVoxelsAskedFor) {
  VoxelMap map({});
  map.RecordChanges();
  map.Integrate(CloudSeenFrom(0, PoseAt(0, 0)), PoseAt(0, 0));
  std::vector<std::uint64_t> keys = map.TakeChanges().appeared;
  std::sort(keys.begin(), keys.end());
  EXPECT_TRUE(SameBytes(map.Extract(keys), map.Extract()));
  const std::vector<std::uint64_t> unknown = {VoxelKey::Pack({9999, 0, 0})};
  EXPECT_FALSE(map.Extract(unknown).positions.at(0).allFinite());
}

TEST(VoxelMapOptions, RefuseAVoxelOfNoSize) {
  VoxelMap::Options options;
  options.voxel_size = 0;
  EXPECT_THROW(VoxelMap{options}, InputError);
}

TEST(VoxelIndex, FindsEveryPointOfTheMap) {
  VoxelMap map({});
  map.Integrate(CloudSeenFrom(0, Rigid3()), Rigid3());
  const MapCloud cloud = map.Extract();
  const VoxelIndex index(cloud.positions, cloud.voxel_size);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(index.Find(cloud.positions[i].cast<double>()), static_cast<std::uint32_t>(i));
  }
}

TEST(VoxelIndex, FindsTheNearestNeighbourWithinAVoxelAndNothingBeyond) {
  const std::vector<Eigen::Vector3f> positions = {{0.005F, 0.005F, 0.005F},
                                                  {0.025F, 0.005F, 0.005F}};
  const VoxelIndex index(positions, 0.01);
  EXPECT_EQ(index.Find({0.012, 0.005, 0.005}), 0U);
  EXPECT_EQ(index.Find({0.018, 0.005, 0.005}), 1U);
  EXPECT_EQ(index.Find({0.035, 0.005, 0.005}), 1U);
  EXPECT_EQ(index.Find({0.045, 0.005, 0.005}), std::nullopt);
  EXPECT_EQ(index.Find({std::nan(""), 0, 0}), std::nullopt);
  EXPECT_EQ(VoxelIndex().Find({0, 0, 0}), std::nullopt);
}

TEST(VoxelKey, RoundsDown) {
  for (const double value : {-2.0, -1.5, -0.25, 0.0, 0.75, 1.0, 1.5, 100000.0}) {
    EXPECT_EQ(VoxelKey::Floor(value), static_cast<int>(std::floor(value)));
    EXPECT_EQ(VoxelKey::Floor(static_cast<float>(value)), static_cast<int>(std::floor(value)));
  }
}

// All points of the 27 voxels around the query, by exhaustive search.
TEST(VoxelIndex, FindsWhatAnExhaustiveSearchFinds) {
  constexpr double kVoxelSize = 0.01;
  Random random(3);
  const auto anywhere = [&] {
    return Eigen::Vector3d(random.Uniform(-0.08, 0.08), random.Uniform(-0.08, 0.08),
                           random.Uniform(-0.08, 0.08));
  };
  std::map<std::uint64_t, std::uint32_t> first_in_voxel;
  std::vector<Eigen::Vector3f> positions;
  const auto voxel_of = [&](const Eigen::Vector3d& point) {
    return VoxelKey::Coordinates(point, kVoxelSize).value();
  };
  for (std::uint32_t i = 0; i < 500; ++i) {
    positions.push_back(anywhere().cast<float>());
    first_in_voxel.try_emplace(VoxelKey::Pack(voxel_of(positions.back().cast<double>())), i);
  }
  const VoxelIndex index(positions, kVoxelSize);
  VoxelIndex::Finder finder(index);  // Of one place after another.
  int num_found = 0;
  for (int query = 0; query < 2000; ++query) {
    const Eigen::Vector3d place = anywhere();
    std::optional<std::uint32_t> expected;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [key, point] : first_in_voxel) {
      const Eigen::Vector3d position = positions[point].cast<double>();
      const int steps = (voxel_of(position) - voxel_of(place)).cwiseAbs().maxCoeff();
      const double distance = steps == 0 ? -1 : (position - place).squaredNorm();
      if (steps > 1 || distance >= least) continue;
      least = distance;
      expected = point;
    }
    EXPECT_EQ(index.Find(place), expected) << place.transpose();
    EXPECT_EQ(finder.Find(place), expected) << place.transpose();
    num_found += expected ? 1 : 0;
  }
  EXPECT_GT(num_found, 500);
  EXPECT_LT(num_found, 2000);
}

}  // namespace
}  // namespace semslam
