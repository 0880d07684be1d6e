// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/objects.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

std::vector<Object> ObjectsOnADesk(std::uint64_t seed) {
  return {MakeMug(seed),
          MakeKeyboard(seed),
          MakeMouse(seed),
          MakeMonitor(0.47F, 0.29F, seed),
          MakeTeddyBear(0.27F, seed),
          MakeBook({0.24F, 0.17F, 0.03F}, seed),
          MakeCardboardBox({0.2F, 0.15F, 0.1F}, seed),
          MakeTelephone(seed),
          MakePenHolder(seed),
          MakePaper(seed)};
}

TEST(Objects, StandOnTheirFrameWithoutSinkingIn) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (const Object& object : ObjectsOnADesk(seed)) {
      float lowest = std::numeric_limits<float>::infinity();
      for (const ObjectPart& part : object.parts) {
        for (const Eigen::Vector3f& position : part.mesh.positions)
          lowest = std::min(lowest, position.z());
      }
      EXPECT_GT(lowest, -0.006F) << object.class_name;
      EXPECT_LT(lowest, 0.006F) << object.class_name;
    }
  }
}

TEST(Objects, AMugIsHollow) {
  // A ray from above down the middle meets nothing before the bottom, some millimetres up.
  const Object mug = MakeMug(1);
  float highest_near_axis = 0;
  for (const ObjectPart& part : mug.parts) {
    for (const Eigen::Vector3f& position : part.mesh.positions) {
      if (position.head<2>().norm() < 0.02F)
        highest_near_axis = std::max(highest_near_axis, position.z());
    }
  }
  EXPECT_LT(highest_near_axis, 0.01F);
}

TEST(Objects, TheBoxOfAnInstanceEnclosesItsParts) {
  Scene scene;
  scene.Add(MakeTeddyBear(0.3F, 1), {ExpSO3({0, 0, 0.7}), {1, 2, 3}});
  OrientedBox box = scene.instances()[0].box;
  box.half_size.array() += 1e-6;
  for (const ScenePart& part : scene.parts()) {
    for (const Eigen::Vector3f& position : part.mesh.positions) {
      ASSERT_TRUE(box.Contains(position.cast<double>()));
    }
  }
}

}  // namespace
}  // namespace semslam
