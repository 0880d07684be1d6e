// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/segmentation/segmenter.h"

namespace semslam::test {

// A depth image of a table as points in the camera's frame, with what each belongs to. Row by row;
// pixels without depth are not finite.
struct LabelledScene {
  std::string name;
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> views;  // Towards the camera.
  std::vector<std::uint32_t> truth;    // 0 unknown, 1 the table, then one number a thing.

  PointCloudView View() const { return {points, views}; }
};

// The scenes in ../shared/data/mosd, by name; none where there is no such folder.
std::vector<LabelledScene> LoadLabelledScenes();

// Writes the numbers as colours, 0 as black.
void WritePicture(const LabelledScene& scene,
                  const std::vector<std::uint32_t>& numbers,
                  const std::string& path);

}  // namespace semslam::test
