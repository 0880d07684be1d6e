// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "labelled_cloud.h"

#include <algorithm>
#include <system_error>

#include "semslam/base/error.h"
#include "semslam/io/cloud_io.h"

namespace fs = std::filesystem;

namespace {

std::uint32_t RegionOfPart(std::uint32_t label) {
  constexpr std::uint32_t kTensPlace = 10;
  return label < kTensPlace ? std::min(label, 1U) : label / kTensPlace;
}

std::vector<fs::path> CloudsIn(const fs::path& folder) {
  std::vector<fs::path> clouds;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".pcd") clouds.push_back(entry.path());
  }
  if (error) throw semslam::InputError(folder.string() + ": " + error.message());
  if (clouds.empty()) {
    throw semslam::InputError(folder.string() + ": expected PCD files, found none");
  }
  std::sort(clouds.begin(), clouds.end());
  return clouds;
}

}  // namespace

std::vector<fs::path> FindClouds(const std::vector<std::string>& paths) {
  std::vector<fs::path> clouds;
  for (const fs::path path : paths) {
    if (!fs::is_directory(path)) {
      clouds.push_back(path);
      continue;
    }
    const std::vector<fs::path> in_folder = CloudsIn(path);
    clouds.insert(clouds.end(), in_folder.begin(), in_folder.end());
  }
  return clouds;
}

LabelledCloud ReadLabelledCloud(const fs::path& path, bool parts) {
  const semslam::CloudColumns columns = semslam::ReadPcd(path);
  LabelledCloud cloud;
  cloud.name = path.stem().string();
  for (std::size_t i = 0; i < columns.positions.size(); ++i) {
    if (columns.positions[i].isZero()) continue;
    cloud.points.push_back(columns.positions[i]);
    if (!columns.normals.empty()) cloud.normals.push_back(columns.normals[i]);
    if (!columns.colors.empty()) cloud.colors.push_back(columns.colors[i]);
    if (columns.labels.empty()) continue;
    cloud.truth.push_back(parts ? RegionOfPart(columns.labels[i]) : columns.labels[i]);
  }
  if (cloud.points.empty()) {
    throw semslam::InputError(path.string() + ": expected points, found none");
  }
  return cloud;
}
