// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// What the scenes that come with the library promise, for many seeds. Only the layout is made, not
// the textures.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "semslam/render/hash.h"
#include "semslam/render/renderer.h"
#include "semslam/render/scenes.h"

#include "support/sanitized.h"

namespace semslam {
namespace {

using Eigen::Vector3d;

constexpr auto kManySeeds = static_cast<std::uint64_t>(testing::NumTrials(20));

StagedScene Layout(const std::string& name, std::uint64_t seed) {
  return ParseScene(SceneText(name), name + ".yaml", seed);
}

double LowestZ(const OrientedBox& box) {
  const Eigen::Matrix3d axes = box.T_world_box.rotation.toRotationMatrix();
  return box.T_world_box.translation.z() - axes.row(2).cwiseAbs().dot(box.half_size);
}

// Of a box one of whose axes is upright.
std::vector<cv::Point2f> FootprintOf(const OrientedBox& box) {
  std::vector<cv::Point2f> corners;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        const Vector3d corner =
            box.T_world_box * Vector3d(box.half_size.cwiseProduct(Vector3d(x, y, z)));
        corners.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
      }
    }
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(corners, hull);
  return hull;
}

double DistanceTo(const OrientedBox& box, const Vector3d& p_world) {
  const Vector3d p_box = box.T_world_box.Inverse() * p_world;
  return (p_box.cwiseAbs() - box.half_size).cwiseMax(0.0).norm();
}

std::uint64_t HashOfFloats(std::uint64_t hash, const float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t bits = 0;
    std::copy_n(reinterpret_cast<const unsigned char*>(values + i), sizeof(bits),
                reinterpret_cast<unsigned char*>(&bits));
    hash = HashOf(hash, bits);
  }
  return hash;
}

// Of all that is to be seen but the textures.
std::uint64_t HashOfScene(const StagedScene& staged) {
  std::uint64_t hash = staged.scene.instances().size();
  for (const Instance& instance : staged.scene.instances()) {
    for (const char c : instance.class_name) hash = HashOf(hash, static_cast<unsigned char>(c));
  }
  for (const ScenePart& part : staged.scene.parts()) {
    for (const Eigen::Vector3f& position : part.mesh.positions)
      hash = HashOfFloats(hash, position.data(), 3);
    hash = HashOfFloats(hash, part.material.tint.data(), 3);
  }
  for (const Light& light : staged.scene.lights())
    hash = HashOfFloats(hash, light.p_world.data(), 3);
  const Eigen::Vector3f eye = staged.path.At(2.5).translation.cast<float>();
  return HashOfFloats(hash, eye.data(), 3);
}

class BuiltInScene : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All,
                         BuiltInScene,
                         ::testing::ValuesIn(SceneNames()),
                         [](const auto& test) { return test.param; });

TEST_P(BuiltInScene, LoadsWithManySeedsAndIsNotTooLarge) {
  for (std::uint64_t seed = 1; seed <= kManySeeds; ++seed) {
    const StagedScene staged = Layout(GetParam(), seed);
    std::size_t num_triangles = 0;
    for (const ScenePart& part : staged.scene.parts()) num_triangles += part.mesh.triangles.size();
    ASSERT_LT(num_triangles, 300000U) << "seed " << seed;
    ASSERT_GE(staged.scene.instances().size(), 10U) << "seed " << seed;
  }
}

TEST_P(BuiltInScene, TheCameraKeepsAwayFromEverything) {
  for (std::uint64_t seed = 1; seed <= kManySeeds; ++seed) {
    const StagedScene staged = Layout(GetParam(), seed);
    for (double time = 0; time < staged.path.duration(); time += 0.25) {
      const Vector3d eye = staged.path.At(time).translation;
      for (const Instance& instance : staged.scene.instances()) {
        ASSERT_GT(DistanceTo(instance.box, eye), 0.25)
            << instance.class_name << ", seed " << seed << ", second " << time;
      }
    }
  }
}

TEST_P(BuiltInScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  std::set<std::uint64_t> hashes;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::uint64_t hash = HashOfScene(Layout(GetParam(), seed));
    EXPECT_EQ(hash, HashOfScene(Layout(GetParam(), seed)));
    hashes.insert(hash);
  }
  EXPECT_EQ(hashes.size(), 4U);
}

TEST_P(BuiltInScene, HasOnlyFiniteMeshesWithValidTriangles) {
  const StagedScene staged = Layout(GetParam(), 3);
  for (const ScenePart& part : staged.scene.parts()) {
    const auto num_vertices = static_cast<int>(part.mesh.positions.size());
    ASSERT_EQ(part.mesh.normals.size(), part.mesh.positions.size());
    ASSERT_EQ(part.mesh.uvs.size(), part.mesh.positions.size());
    for (const Eigen::Vector3f& position : part.mesh.positions) ASSERT_TRUE(position.allFinite());
    for (const Eigen::Vector3i& triangle : part.mesh.triangles) {
      ASSERT_GE(triangle.minCoeff(), 0);
      ASSERT_LT(triangle.maxCoeff(), num_vertices);
    }
  }
}

// Things on the desk of `random`: all but the room, the desk and what hangs on the wall.
std::vector<Instance> ThingsOnTheDesk(const StagedScene& staged) {
  const std::set<std::string> others = {"floor",  "wall",    "ceiling",    "desk",
                                        "poster", "picture", "whiteboard", "clock"};
  std::vector<Instance> things;
  for (const Instance& instance : staged.scene.instances()) {
    if (others.count(instance.class_name) == 0) things.push_back(instance);
  }
  return things;
}

const Instance& FirstOf(const StagedScene& staged, const std::string& class_name) {
  const auto& instances = staged.scene.instances();
  return *std::find_if(instances.begin(), instances.end(),
                       [&](const Instance& instance) { return instance.class_name == class_name; });
}

TEST(RandomDesk, EverythingStandsOnTheDesk) {
  for (std::uint64_t seed = 1; seed <= kManySeeds; ++seed) {
    const StagedScene staged = Layout("random", seed);
    const OrientedBox& desk = FirstOf(staged, "desk").box;
    const double top = desk.T_world_box.translation.z() + desk.half_size.z();
    for (const Instance& thing : ThingsOnTheDesk(staged)) {
      ASSERT_NEAR(LowestZ(thing.box), top, 0.001) << thing.class_name << ", seed " << seed;
      for (const cv::Point2f& corner : FootprintOf(thing.box)) {
        ASSERT_LE(std::abs(corner.x), desk.half_size.x()) << thing.class_name << ", seed " << seed;
        ASSERT_LE(std::abs(corner.y), desk.half_size.y()) << thing.class_name << ", seed " << seed;
      }
    }
  }
}

TEST(RandomDesk, NoTwoThingsOverlap) {
  for (std::uint64_t seed = 1; seed <= kManySeeds; ++seed) {
    const std::vector<Instance> things = ThingsOnTheDesk(Layout("random", seed));
    for (std::size_t i = 0; i < things.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        std::vector<cv::Point2f> overlap;
        const float area = cv::intersectConvexConvex(FootprintOf(things[i].box),
                                                     FootprintOf(things[k].box), overlap);
        ASSERT_LT(area, 1e-6F) << things[i].class_name << " and " << things[k].class_name
                               << ", seed " << seed;
      }
    }
  }
}

TEST(RandomDesk, HasWhatADetectorIsTrainedOn) {
  std::map<std::string, int> counts;
  constexpr int kSeeds = testing::NumTrials(40);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const Instance& thing : ThingsOnTheDesk(Layout("random", seed)))
      ++counts[thing.class_name];
  }
  for (const char* name : {"cup", "keyboard", "tvmonitor", "mouse", "teddy bear"}) {
    EXPECT_GE(counts[name], kSeeds * 3 / 4) << name;
  }
  EXPECT_GE(counts.size(), 14U);  // And much that it is not.
}

TEST(Room, IsWalkedAroundOnceInTwentyEightSecondsAtTheSpeedOfASlowWalk) {
  const CameraPath path = Layout("room", 1).path;
  EXPECT_NEAR(path.duration(), 28, 0.01);
  double length = 0;
  double fastest = 0;
  double fastest_turn = 0;
  constexpr double kStep = 1.0 / 30;
  for (double time = kStep; time <= path.duration(); time += kStep) {
    length += (path.ViewAt(time).p_world_eye - path.ViewAt(time - kStep).p_world_eye).norm();
    const Rigid3 before = path.At(time - kStep);
    const Rigid3 after = path.At(time);
    fastest = std::max(fastest, (after.translation - before.translation).norm() / kStep);
    fastest_turn = std::max(fastest_turn, RotationAngle(before, after) / kStep);
  }
  EXPECT_GE(length, 12);
  EXPECT_LE(fastest, 0.65);  // With the sways of steps.
  EXPECT_LE(fastest_turn * 180 / std::numbers::pi, 40);
}

TEST(Room, TheEndSeesWhatTheStartSaw) {
  const CameraPath path = Layout("room", 1).path;
  for (double time = 0; time < 2; time += 0.1) {
    const Waypoint first = path.ViewAt(time);
    const Waypoint again = path.ViewAt(time + 28);
    EXPECT_LT((first.p_world_eye - again.p_world_eye).norm(), 0.001);
    EXPECT_LT((first.p_world_target - again.p_world_target).norm(), 0.001);
  }
}

// Whether a point of a part of one thing is inside the box of another by more than 1 cm.
bool ReachesInto(const StagedScene& staged, const Instance& one, const Instance& other) {
  OrientedBox inner = other.box;
  inner.half_size.array() -= 0.01;
  if (inner.half_size.minCoeff() <= 0) return false;  // A sheet.
  if ((one.box.T_world_box.translation - inner.T_world_box.translation).norm() >
      one.box.half_size.norm() + inner.half_size.norm())
    return false;
  for (const ScenePart& part : staged.scene.parts()) {
    if (part.instance_id != one.id) continue;
    for (const Eigen::Vector3f& position : part.mesh.positions) {
      if (inner.Contains(position.cast<double>())) return true;
    }
  }
  return false;
}

TEST(Room, NothingReachesIntoAnother) {
  // Boxes of these are not filled: things are in, under or between them.
  const std::set<std::string> hollow = {"desk", "shelf", "chair", "sofa", "window"};
  const StagedScene staged = Layout("room", 1);
  for (const Instance& one : staged.scene.instances()) {
    for (const Instance& other : staged.scene.instances()) {
      if (one.id == other.id || hollow.count(other.class_name) > 0) continue;
      EXPECT_FALSE(ReachesInto(staged, one, other))
          << one.class_name << ' ' << one.id << " and " << other.class_name << ' ' << other.id
          << " at " << other.box.T_world_box.translation.transpose();
    }
  }
}

// The part of a small picture whose depth is within the sensor's range.
double PartInRange(const Renderer& renderer, const Rigid3& T_world_camera) {
  PinholeCamera::Parameters camera = CameraByName("TUM3");
  camera.width = 80;
  camera.height = 60;
  camera.fx = camera.fy = 66;
  camera.cx = 39.5;
  camera.cy = 29.5;
  const IdealImage image = renderer.Render(RayTable(PinholeCamera(camera)), T_world_camera);
  cv::Mat inside;
  cv::inRange(image.depth, 0.5, 4.5, inside);
  return cv::countNonZero(inside) / (80.0 * 60.0);
}

TEST_P(BuiltInScene, IsMostlyWithinTheSensorsRange) {
  const StagedScene staged = Layout(GetParam(), 2);
  const Renderer renderer(staged.scene,
                          {.smooth_edges = false, .shadows = false, .occlusion_reach = 0});
  for (double time = 0; time < staged.path.duration(); time += staged.path.duration() / 20)
    EXPECT_GT(PartInRange(renderer, staged.path.At(time)), 0.85) << "second " << time;
}

TEST(Scene, PaintingGivesTheSameTexturesOnAnyNumberOfThreads) {
  StagedScene one = Layout("desk", 5);
  StagedScene three = Layout("desk", 5);
  one.scene.Paint(1);
  three.scene.Paint(3);
  int num_textures = 0;
  for (std::size_t i = 0; i < one.scene.parts().size(); ++i) {
    const auto& a = one.scene.parts()[i].material.texture;
    const auto& b = three.scene.parts()[i].material.texture;
    ASSERT_EQ(a == nullptr, b == nullptr);
    if (!a) continue;
    ++num_textures;
    for (float u = 0.03F; u < 1; u += 0.11F)
      ASSERT_EQ(a->Sample({u, 1 - u}, 0.001F), b->Sample({u, 1 - u}, 0.001F));
  }
  EXPECT_GT(num_textures, 30);
}

}  // namespace
}  // namespace semslam
