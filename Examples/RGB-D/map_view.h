// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "semslam/io/map_files.h"
#include "semslam/pipeline/point_cloud_mapping.h"

// The result of a run as files and pages show it. The clouds stay in the result.
class MapView {
 public:
  explicit MapView(const semslam::PointCloudMapping::Result& map);
  MapView(const MapView&) = delete;
  MapView& operator=(const MapView&) = delete;

  const semslam::LabelledMapView& view() const { return view_; }

 private:
  std::vector<std::uint32_t> labels_;
  semslam::LabelledMapView view_;
};
