// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/io/view_camera.h"

namespace semslam {

// What a camera sees of a cloud: per pixel the index of the nearest point, its depth, and how much
// light gets there.
struct PointImage {
  static constexpr std::int32_t kNone = -1;
  cv::Mat points;    // CV_32SC1: index or kNone.
  cv::Mat depths;    // CV_32FC1: metres; infinity where there is no point.
  cv::Mat lighting;  // CV_32FC1: in (0, 1]; dark beside what is nearer, so that depth can be read.
};

// Draws every point as a disc of the size that a ball of this diameter (metres) has there.
PointImage RenderPoints(std::span<const Eigen::Vector3f> positions,
                        const ViewCamera& camera,
                        double point_size);

}  // namespace semslam
