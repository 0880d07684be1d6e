// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_scene.h"

#include <cstddef>

#include <gtest/gtest.h>

#include "semslam/render/clip.h"

namespace semslam {
namespace {

// Two rows of rays through neighbouring pixels; one that does not fill its last packet.
RayBatch TwoRows(const RenderedClip& clip, std::size_t row_length) {
  const Rigid3 T_world_camera = clip.T_world_camera(0);
  RayBatch rays;
  rays.Resize(2 * row_length);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d direction =
        T_world_camera.rotation * Eigen::Vector3d(static_cast<double>(i % row_length) * 0.003,
                                                  i < row_length ? 0.0 : 0.003, 1.0);
    const Eigen::Vector3f origin = T_world_camera.translation.cast<float>();
    rays.origin.x[i] = origin.x();
    rays.origin.y[i] = origin.y();
    rays.origin.z[i] = origin.z();
    rays.direction.x[i] = static_cast<float>(direction.x());
    rays.direction.y[i] = static_cast<float>(direction.y());
    rays.direction.z[i] = static_cast<float>(direction.z());
    rays.length[i] = i % 7 == 3 ? -1.0F : 100.0F;
  }
  return rays;
}

TEST(RayScene, CastsTwoRowsTogetherAsOneAfterTheOther) {
  const RenderedClip clip({});
  for (const auto edges : {RayScene::Edges::kTight, RayScene::Edges::kFast}) {
    const RayScene scene(clip.scene(), edges);
    RayBatch rays = TwoRows(clip, 100);
    HitBatch apart;
    FloatRow visible_apart;
    scene.Intersect(rays, &apart);
    scene.Visibility(rays, &visible_apart);
    rays.row_length = 100;
    HitBatch together;
    FloatRow visible_together;
    scene.Intersect(rays, &together);
    scene.Visibility(rays, &visible_together);
    int num_hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      num_hits += together.part[i] != Hit::kNone ? 1 : 0;
      EXPECT_EQ(together.part[i], apart.part[i]) << i;
      EXPECT_NEAR(together.distance[i], apart.distance[i], 1e-5) << i;
      EXPECT_EQ(visible_together[i], visible_apart[i]) << i;
      if (rays.length[i] < 0) {
        EXPECT_EQ(together.part[i], Hit::kNone) << i;
      }
    }
    EXPECT_GT(num_hits, 100);
  }
}

}  // namespace
}  // namespace semslam
