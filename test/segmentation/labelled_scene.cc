// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/labelled_scene.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <opencv2/imgcodecs.hpp>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include "semslam/base/random.h"

namespace semslam::test {
namespace {

// Labels 1-9 are parts of the table, 20-29 of the first thing, 30-39 of the second, ...
std::uint32_t TruthOf(std::uint32_t label) { return label < 10 ? std::min(label, 1U) : label / 10; }

LabelledScene Load(const std::filesystem::path& path) {
  pcl::PointCloud<pcl::PointXYZL> cloud;
  LabelledScene scene;
  if (pcl::io::loadPCDFile(path.string(), cloud) != 0) return scene;
  scene.name = path.stem().string();
  scene.width = cloud.width;
  scene.height = cloud.height;
  for (const pcl::PointXYZL& point : cloud) {
    // Some clouds mark missing depth by zero instead of not-a-number.
    const bool is_valid = std::isfinite(point.z) && point.z > 0;
    scene.points.push_back(
        is_valid ? Eigen::Vector3f(point.x, point.y, point.z)
                 : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    scene.views.push_back(-scene.points.back());
    scene.truth.push_back(is_valid ? TruthOf(point.label) : 0);
  }
  return scene;
}

}  // namespace

std::vector<LabelledScene> LoadLabelledScenes() {
  const std::filesystem::path folder =
      std::filesystem::path(SEMSLAM_SOURCE_DIR) / "../shared/data/mosd";
  std::vector<std::filesystem::path> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".pcd") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<LabelledScene> scenes;
  for (const std::filesystem::path& path : paths) scenes.push_back(Load(path));
  return scenes;
}

void WritePicture(const LabelledScene& scene,
                  const std::vector<std::uint32_t>& numbers,
                  const std::string& path) {
  cv::Mat3b picture(static_cast<int>(scene.height), static_cast<int>(scene.width));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    Random random(numbers[i]);
    const auto channel = [&] { return static_cast<std::uint8_t>(48 + random.Index(208)); };
    cv::Vec3b colour(0, 0, 0);
    if (numbers[i] != 0) colour = {channel(), channel(), channel()};
    picture(static_cast<int>(i / scene.width), static_cast<int>(i % scene.width)) = colour;
  }
  cv::imwrite(path, picture);
}

}  // namespace semslam::test
