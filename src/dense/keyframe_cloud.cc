// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/keyframe_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

#include "dense/octahedral.h"

namespace semslam {
namespace {

constexpr float kDepthLevels = std::numeric_limits<std::uint16_t>::max();

Rgb ColorAt(const cv::Mat& bgr, int column, int row) {
  const auto* pixel = bgr.ptr<std::uint8_t>(row) + std::ptrdiff_t{3} * column;
  return {pixel[2], pixel[1], pixel[0]};
}

}  // namespace

void KeyframeCloud::Options::Validate() const {
  if (pixel_stride < 1 || pixel_stride > 64) {
    throw InputError("keyframe cloud: expected 1 <= pixel_stride <= 64");
  }
  depth.Validate();
}

float KeyframeCloud::pixel_angle() const {
  const int column = rays_->width() / 2;
  const int row = rays_->height() / 2;
  return (rays_->At(column, row) - rays_->At(column - 1, row)).norm();
}

std::optional<KeyframePoint> KeyframeCloud::At(int grid_column, int grid_row) const {
  if (TexelAt(grid_column, grid_row).depth == 0) return std::nullopt;
  return Decode(grid_column, grid_row);
}

KeyframePoint KeyframeCloud::Decode(int grid_column, int grid_row) const {
  const Texel& texel = TexelAt(grid_column, grid_row);
  const int column = grid_column * stride_;
  const int row = grid_row * stride_;
  return {column, row, rays_->Unproject(column, row, depth_unit_ * static_cast<float>(texel.depth)),
          DecodeNormal({texel.normal_u, texel.normal_v}), texel.color};
}

std::shared_ptr<const KeyframeCloud> BuildKeyframeCloud(KeyframeId id,
                                                        const RgbdImage& image,
                                                        std::shared_ptr<const RayTable> rays,
                                                        const KeyframeCloud::Options& options) {
  SEMSLAM_CHECK(rays != nullptr);
  SEMSLAM_CHECK(image.color.type() == CV_8UC3) << "type " << image.color.type();
  SEMSLAM_CHECK(image.color.size() == image.depth.size());
  const cv::Mat depth = FilterDepth(image.depth, *rays, options.depth);
  const std::vector<Eigen::Vector3f> normals =
      EstimateNormals(depth, *rays, options.pixel_stride, options.depth);

  KeyframeCloud cloud;
  cloud.id_ = id;
  cloud.stride_ = options.pixel_stride;
  cloud.grid_columns_ = (rays->width() + cloud.stride_ - 1) / cloud.stride_;
  cloud.grid_rows_ = (rays->height() + cloud.stride_ - 1) / cloud.stride_;
  cloud.depth_unit_ = static_cast<float>(options.depth.max_depth) / kDepthLevels;
  cloud.texels_.resize(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (normals[i].isZero()) continue;
    const int column = static_cast<int>(i) % cloud.grid_columns_ * cloud.stride_;
    const int row = static_cast<int>(i) / cloud.grid_columns_ * cloud.stride_;
    const float z = depth.at<float>(row, column);
    const float level = std::clamp(std::round(z / cloud.depth_unit_), 1.0F, kDepthLevels);
    const OctahedralNormal normal = EncodeNormal(normals[i]);
    cloud.texels_[i] = {static_cast<std::uint16_t>(level), normal.u, normal.v,
                        ColorAt(image.color, column, row)};
    ++cloud.num_points_;
    cloud.max_range_ = std::max(cloud.max_range_, rays->Unproject(column, row, z).norm());
  }
  cloud.rays_ = std::move(rays);
  return std::make_shared<const KeyframeCloud>(std::move(cloud));
}

}  // namespace semslam
