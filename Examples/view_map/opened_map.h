// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "semslam/io/cloud_io.h"
#include "semslam/viewer/map_scene.h"

// Something that a mapping program wrote, opened to be looked at. It keeps all that its scene
// shows.
class OpenedMap {
 public:
  // A folder of results, a map of --save-map, or a cloud in a PCD or PLY file. Throws
  // semslam::InputError.
  explicit OpenedMap(const std::filesystem::path& path);
  OpenedMap(const OpenedMap&) = delete;
  OpenedMap& operator=(const OpenedMap&) = delete;

  const semslam::MapScene& scene() const { return scene_; }

 private:
  void OpenCloud(const std::filesystem::path& path);
  void OpenFolder(const std::filesystem::path& folder);
  void OpenMap(const std::filesystem::path& path);
  void ShowColumns();

  semslam::CloudColumns columns_;
  std::vector<semslam::Rgb> photo_colors_;
  semslam::MapScene scene_;
};
