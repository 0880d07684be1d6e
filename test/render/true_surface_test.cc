// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/true_surface.h"

#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "semslam/dense/voxel_index.h"

namespace semslam {
namespace {

RenderedClip::Options SmallClip(const std::string& scene) {
  RenderedClip::Options options;
  options.scene = scene;
  options.num_frames = 6;
  options.fps = 3;
  options.camera = {.width = 160, .height = 120, .fx = 130, .fy = 130, .cx = 79.5, .cy = 59.5};
  return options;
}

// True if the sample is what one of the frames sees in the middle of a pixel.
bool IsSeen(const RenderedClip& clip,
            const std::vector<RenderedFrame>& frames,
            const Eigen::Vector3d& p_world,
            std::uint32_t instance) {
  for (const RenderedFrame& frame : frames) {
    const Eigen::Vector3d p_camera = frame.T_world_camera.Inverse() * p_world;
    if (p_camera.z() <= 0) continue;
    const Eigen::Vector2d pixel = clip.camera().Project(p_camera);
    const int x = static_cast<int>(std::lround(pixel.x()));
    const int y = static_cast<int>(std::lround(pixel.y()));
    if ((pixel - Eigen::Vector2d(x, y)).norm() > 0.01) continue;
    if (x < 0 || y < 0 || x >= clip.camera().width() || y >= clip.camera().height()) continue;
    const bool is_same = frame.ideal.labels.at<std::uint16_t>(y, x) == instance &&
                         std::abs(frame.ideal.depth.at<double>(y, x) - p_camera.z()) < 1e-4;
    if (is_same) return true;
  }
  return false;
}

TEST(TrueSurface, EverySampleIsWhatSomeFrameSees) {
  const RenderedClip clip(SmallClip("desk"));
  std::vector<RenderedFrame> frames;
  for (std::size_t i = 0; i < clip.num_frames(); ++i) frames.push_back(clip.Frame(i));
  const TrueSurface surface = SampleTrueSurface(clip);
  ASSERT_GT(surface.positions.size(), 5000U);
  ASSERT_EQ(surface.normals.size(), surface.positions.size());
  ASSERT_EQ(surface.instances.size(), surface.positions.size());
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    ASSERT_TRUE(IsSeen(clip, frames, surface.positions[i].cast<double>(), surface.instances[i]))
        << "sample " << i;
  }
}

TEST(TrueSurface, AWallIsFlatAndLooksIntoTheRoom) {
  const RenderedClip clip(SmallClip("wall"));
  const TrueSurface surface = SampleTrueSurface(clip);
  std::size_t num_samples = 0;
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    if (clip.instances()[surface.instances[i] - 1].class_name != "wall") continue;
    ++num_samples;
    EXPECT_NEAR(surface.positions[i].y(), 0, 1e-5);
    EXPECT_LT((surface.normals[i] + Eigen::Vector3f::UnitY()).norm(), 1e-5);
  }
  EXPECT_GT(num_samples, 1000U);
}

TEST(TrueSurface, HasOneSampleForAnInstanceInAVoxel) {
  const TrueSurface surface = SampleTrueSurface(RenderedClip(SmallClip("desk")));
  std::set<std::pair<std::uint64_t, std::uint32_t>> places;
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    const auto voxel =
        VoxelKey::Coordinates(surface.positions[i].cast<double>(), kTrueSurfaceSpacing);
    EXPECT_TRUE(places.emplace(VoxelKey::Pack(*voxel), surface.instances[i]).second);
  }
}

TEST(TrueSurface, EndsWhereTheSensorDoes) {
  RenderedClip::Options options = SmallClip("desk");
  options.depth.max_depth_m = 1.2;
  const RenderedClip clip(options);
  const TrueSurface surface = SampleTrueSurface(clip);
  for (const Eigen::Vector3f& position : surface.positions) {
    double nearest = 100;
    for (std::size_t i = 0; i < clip.num_frames(); ++i) {
      const Eigen::Vector3d p_camera = clip.T_world_camera(i).Inverse() * position.cast<double>();
      if (p_camera.z() > 0.49) nearest = std::min(nearest, p_camera.z());
    }
    ASSERT_LT(nearest, 1.2001);
  }
}

TEST(TrueSurface, IsTheSameOnAnyNumberOfThreads) {
  RenderedClip::Options options = SmallClip("desk");
  options.num_threads = 1;
  const TrueSurface one = SampleTrueSurface(RenderedClip(options));
  options.num_threads = 3;
  const TrueSurface three = SampleTrueSurface(RenderedClip(options));
  EXPECT_EQ(one.positions, three.positions);
  EXPECT_EQ(one.normals, three.normals);
  EXPECT_EQ(one.instances, three.instances);
}

}  // namespace
}  // namespace semslam
