// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "semslam/base/random.h"
#include "semslam/features/frame.h"
#include "semslam/geometry/rigid3.h"

#include "place/random_descriptors.h"

namespace semslam::testing {

// A frame of features without meaning; every `depth_every`-th from the first has depth.
inline std::shared_ptr<const Frame> RandomFrame(int num_features,
                                                Random& random,
                                                int depth_every = 2) {
  auto frame = std::make_shared<Frame>();
  for (int i = 0; i < num_features; ++i) {
    Keypoint keypoint;
    keypoint.pixel = {static_cast<float>(random.Uniform(50, 600)),
                      static_cast<float>(random.Uniform(50, 400))};
    keypoint.octave = static_cast<std::int16_t>(random.Index(8));
    if (i % depth_every == 0) {
      keypoint.depth = 2;
      keypoint.right_x = keypoint.pixel.x() - 20;
    }
    frame->keypoints.push_back(keypoint);
    frame->descriptors.push_back(RandomDescriptor(random));
  }
  return frame;
}

inline Rigid3 RandomPose(Random& random) {
  const auto vector = [&](double size) {
    return Eigen::Vector3d(random.Uniform(-size, size), random.Uniform(-size, size),
                           random.Uniform(-size, size));
  };
  return {ExpSO3(vector(1.0)), vector(2.0)};
}

}  // namespace semslam::testing
