// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/binary_stream.h"
#include "semslam/base/id.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/dense/depth_filter.h"
#include "semslam/dense/rgb.h"

namespace semslam {

// One trusted depth pixel of a keyframe.
struct KeyframePoint {
  int column = 0;  // Pixel of the recorded image.
  int row = 0;
  Eigen::Vector3f p_camera;  // Metres, without lens distortion.
  Eigen::Vector3f n_camera;  // Unit length, towards the camera.
  Rgb color;
};

// What one keyframe saw, in the keyframe's own camera frame, so that it follows the keyframe
// wherever corrections move it. Organised: every stride-th pixel of every stride-th row, 8 bytes
// each (0.6 MB at 640x480 and stride 2). Immutable after it is built; share it freely.
class KeyframeCloud {
 public:
  struct Options {
    int pixel_stride = 2;  // Pixels.
    DepthFilterOptions depth;
    void Validate() const;  // Throws InputError.
  };

  KeyframeId id() const { return id_; }
  int stride() const { return stride_; }
  // Size of the grid; grid cell (i, j) is pixel (i stride, j stride).
  int grid_columns() const { return grid_columns_; }
  int grid_rows() const { return grid_rows_; }
  int image_width() const { return rays_->width(); }
  int image_height() const { return rays_->height(); }
  std::size_t num_cells() const { return texels_.size(); }
  std::size_t num_points() const { return num_points_; }
  // Distance of the furthest point from the camera's centre, metres. 0 without points.
  float max_range() const { return max_range_; }
  // Angle between neighbouring pixels at the centre of the image, radians.
  float pixel_angle() const;
  std::size_t memory_bytes() const { return texels_.size() * sizeof(Texel); }

  // Depth along the optical axis at a grid cell, metres; 0 where there is no point.
  float DepthAt(int grid_column, int grid_row) const {
    return depth_unit_ * static_cast<float>(TexelAt(grid_column, grid_row).depth);
  }
  // Nothing where there is no point.
  std::optional<KeyframePoint> At(int grid_column, int grid_row) const;

  // Calls visit(const KeyframePoint&) for every point, row by row.
  template <typename Visit>
  void ForEach(Visit&& visit) const {
    ForEachCell([&](std::size_t, const KeyframePoint& point) { visit(point); });
  }
  // Calls visit(cell, const KeyframePoint&) for every point. Cells of the grid are counted row by
  // row.
  template <typename Visit>
  void ForEachCell(Visit&& visit) const {
    std::size_t cell = 0;
    for (int j = 0; j < grid_rows_; ++j) {
      for (int i = 0; i < grid_columns_; ++i, ++cell) {
        if (texels_[cell].depth != 0) visit(cell, Decode(i, j));
      }
    }
  }

 private:
  struct Texel {
    std::uint16_t depth = 0;                  // In depth_unit_; 0: no point.
    std::uint8_t normal_u = 0, normal_v = 0;  // Octahedral map of the unit sphere.
    Rgb color;
    std::uint8_t unused = 0;
  };

  KeyframeCloud() = default;
  const Texel& TexelAt(int grid_column, int grid_row) const {
    return texels_[static_cast<std::size_t>(grid_row) * static_cast<std::size_t>(grid_columns_) +
                   static_cast<std::size_t>(grid_column)];
  }
  KeyframePoint Decode(int grid_column, int grid_row) const;

  friend std::shared_ptr<const KeyframeCloud> BuildKeyframeCloud(
      KeyframeId id,
      const RgbdImage& image,
      std::shared_ptr<const RayTable> rays,
      const KeyframeCloud::Options& options);
  friend void WriteKeyframeCloud(const KeyframeCloud& cloud, BinaryWriter* writer);
  friend std::shared_ptr<const KeyframeCloud> ReadKeyframeCloud(
      BinaryReader* reader, std::shared_ptr<const RayTable> rays);

  KeyframeId id_;
  int stride_ = 1;
  int grid_columns_ = 0;
  int grid_rows_ = 0;
  std::size_t num_points_ = 0;
  float max_range_ = 0;
  float depth_unit_ = 0;
  std::vector<Texel> texels_;
  std::shared_ptr<const RayTable> rays_;
};

// Filters the depth, estimates normals and keeps every point that has one. The ray table is shared
// by all clouds of a camera. The image must have the ray table's size.
std::shared_ptr<const KeyframeCloud> BuildKeyframeCloud(KeyframeId id,
                                                        const RgbdImage& image,
                                                        std::shared_ptr<const RayTable> rays,
                                                        const KeyframeCloud::Options& options);

}  // namespace semslam
