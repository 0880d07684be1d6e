// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "opened_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/io/level_frame.h"

#include "RGB-D/map_view.h"
#include "RGB-D/result_files.h"
#include "saved_map.h"

namespace {

using semslam::CloudColumns;
using semslam::InputError;

// Files of a folder of results.
constexpr const char* kSemanticCloud = "semantic_map.ply";
constexpr const char* kSemanticPcd = "semantic_map.pcd";
constexpr const char* kColorCloud = "global_color.pcd";
constexpr const char* kSegmentCloud = "segmentation.pcd";
constexpr const char* kObjects = "objects.json";
constexpr const char* kTrajectory = "CameraTrajectory.txt";
constexpr const char* kKeyframes = "KeyFrameTrajectory.txt";

std::string FirstBytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be opened");
  std::string bytes(8, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

// Distance of neighbouring points, by how many of them share a cell of a coarse grid: that of
// voxel maps is found, and of scans about the mean. Without a scale known beforehand.
double FindSpacing(const std::vector<Eigen::Vector3f>& points) {
  if (points.size() < 2) return 0.01;
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& p : points) bounds.extend(p);
  // So many cells a side that each holds a patch of surface of some points.
  constexpr double kPointsPerCell = 64;
  const double edge = std::max(1e-6F, bounds.sizes().maxCoeff());
  const double cells =
      std::clamp(std::sqrt(static_cast<double>(points.size()) / kPointsPerCell), 1.0, 1000.0);
  const double size = edge / cells;
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d cell = (p - bounds.min()).cast<double>() / size;
    const auto index = [&cell](int axis) { return static_cast<std::uint64_t>(cell[axis]); };
    keys.push_back(index(0) << 42 | index(1) << 21 | index(2));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < keys.size();) {
    const std::size_t begin = i;
    while (i < keys.size() && keys[i] == keys[begin]) ++i;
    counts.push_back(i - begin);
  }
  // Of the cells that are well filled: a surface straight through a cell covers one of its faces.
  const auto rank = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() * 3 / 4);
  std::nth_element(counts.begin(), rank, counts.end());
  return size / std::sqrt(static_cast<double>(std::max<std::size_t>(1, *rank)));
}

// The columns of a second file on the same points.
CloudColumns ReadCompanion(const std::filesystem::path& path, std::size_t num_points) {
  CloudColumns columns = semslam::ReadPcd(path);
  if (columns.positions.size() == num_points) return columns;
  throw InputError(path.string() + ": expected " + std::to_string(num_points) +
                   " points, as in the other files of its folder, found " +
                   std::to_string(columns.positions.size()));
}

}  // namespace

OpenedMap::OpenedMap(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    OpenFolder(path);
  } else if (!std::filesystem::exists(path)) {
    throw InputError(path.string() + ": not found");
  } else if (FirstBytes(path) == "semslmap") {
    OpenMap(path);
  } else {
    OpenCloud(path);
  }
}

void OpenedMap::ShowColumns() {
  scene_.map.cloud = columns_.View();
  if (!photo_colors_.empty()) scene_.map.cloud.colors = photo_colors_;
  scene_.map.point_size = FindSpacing(columns_.positions);
  if (columns_.positions.empty()) return;
  if (!columns_.normals.empty()) scene_.map.up = semslam::FindLevelFrame(scene_.map).up;
}

void OpenedMap::OpenCloud(const std::filesystem::path& path) {
  const std::string bytes = FirstBytes(path);
  const bool is_ply = bytes.starts_with("ply");
  const bool is_pcd = bytes.starts_with("# .PCD") || bytes.starts_with("VERSION") ||
                      path.extension() == ".pcd" || path.extension() == ".PCD";
  if (!is_ply && !is_pcd) {
    throw InputError(path.string() +
                     ": expected a PCD or PLY file, a map of --save-map, or a folder of results");
  }
  columns_ = is_ply ? semslam::ReadPly(path) : semslam::ReadPcd(path);
  if (columns_.positions.empty()) throw InputError(path.string() + ": has no points");
  // The label of a cloud of somebody else may be anything: each gets a colour.
  if (columns_.segments.empty()) columns_.segments = columns_.labels;
  ShowColumns();
}

void OpenedMap::OpenFolder(const std::filesystem::path& folder) {
  const auto has = [&folder](const char* name) { return std::filesystem::exists(folder / name); };
  if (has(kSemanticCloud)) {
    columns_ = semslam::ReadPly(folder / kSemanticCloud);
  } else if (has(kSemanticPcd)) {
    columns_ = semslam::ReadPcd(folder / kSemanticPcd);
  } else if (has(kColorCloud)) {
    columns_ = semslam::ReadPcd(folder / kColorCloud);
  } else if (has(kSegmentCloud)) {
    columns_.positions = semslam::ReadPcd(folder / kSegmentCloud).positions;
  } else {
    throw InputError(folder.string() + ": expected results of a mapping program (" +
                     kSemanticCloud + ", " + kColorCloud + "), found none");
  }
  const std::size_t size = columns_.positions.size();
  if (size == 0) throw InputError(folder.string() + ": the map has no points");
  // The semantic map has the colours of classes.
  if (has(kColorCloud)) photo_colors_ = ReadCompanion(folder / kColorCloud, size).colors;
  if (columns_.segments.empty() && has(kSegmentCloud))
    columns_.segments = ReadCompanion(folder / kSegmentCloud, size).labels;
  ShowColumns();
  if (has(kObjects)) {
    semslam::ObjectsFile objects = semslam::ReadObjects(folder / kObjects);
    scene_.map.classes = std::move(objects.classes);
    scene_.map.objects = std::move(objects.objects);
  }
  if (has(kTrajectory)) scene_.trajectory = semslam::ReadTrajectory(folder / kTrajectory);
  if (has(kKeyframes)) scene_.keyframes = semslam::ReadTrajectory(folder / kKeyframes);
}

void OpenedMap::OpenMap(const std::filesystem::path& path) {
  const semslam::Settings settings = semslam::System::ReadMapSettings(path);
  const std::unique_ptr<semslam::System> system = OpenSavedMap(path, settings);
  semslam::PointCloudMapping::Result result = system->Shutdown();
  const MapView view(result);
  const semslam::LabelledMapView& map = view.view();
  const auto copy = [](const auto& from, auto* to) { to->assign(from.begin(), from.end()); };
  copy(map.cloud.positions, &columns_.positions);
  copy(map.cloud.colors, &columns_.colors);
  copy(map.cloud.normals, &columns_.normals);
  copy(map.cloud.labels, &columns_.labels);
  copy(map.cloud.segments, &columns_.segments);
  copy(map.cloud.objects, &columns_.objects);
  copy(map.cloud.confidences, &columns_.confidences);
  copy(map.cloud.entropies, &columns_.entropies);
  if (columns_.positions.empty()) throw InputError(path.string() + ": the map has no points");
  ShowColumns();
  scene_.map.point_size = map.point_size;
  scene_.map.classes = map.classes;
  scene_.map.objects = map.objects;
  scene_.trajectory = ToTrajectory(system->CameraTrajectory());
  scene_.keyframes = ToTrajectory(system->KeyframeTrajectory());
  scene_.camera = settings.camera;
}
