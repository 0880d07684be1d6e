// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/dense/keyframe_cloud_archive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace semslam {
namespace {

constexpr int kMaxStride = 64;

}  // namespace

void WriteKeyframeCloud(const KeyframeCloud& cloud, BinaryWriter* writer) {
  writer->Write(cloud.id_.value);
  writer->Write<std::int32_t>(cloud.stride_);
  writer->Write(cloud.depth_unit_);
  writer->Write(cloud.max_range_);
  writer->WriteAll(std::span(cloud.texels_));
}

std::shared_ptr<const KeyframeCloud> ReadKeyframeCloud(BinaryReader* reader,
                                                       std::shared_ptr<const RayTable> rays) {
  KeyframeCloud cloud;
  cloud.id_ = KeyframeId{reader->Read<std::uint32_t>()};
  cloud.stride_ = reader->Read<std::int32_t>();
  if (cloud.stride_ < 1 || cloud.stride_ > kMaxStride) {
    reader->Fail("expected a stride of 1 to 64 pixels, found " + std::to_string(cloud.stride_));
  }
  cloud.depth_unit_ = reader->Read<float>();
  cloud.max_range_ = reader->Read<float>();
  if (!(cloud.depth_unit_ > 0) || !(cloud.max_range_ >= 0) || !std::isfinite(cloud.depth_unit_) ||
      !std::isfinite(cloud.max_range_)) {
    reader->Fail("expected a unit of depth and a range of a keyframe's cloud");
  }
  cloud.grid_columns_ = (rays->width() + cloud.stride_ - 1) / cloud.stride_;
  cloud.grid_rows_ = (rays->height() + cloud.stride_ - 1) / cloud.stride_;
  cloud.texels_ = reader->ReadAll<KeyframeCloud::Texel>();
  const auto num_cells = static_cast<std::size_t>(cloud.grid_columns_) * cloud.grid_rows_;
  if (cloud.texels_.size() != num_cells) {
    reader->Fail("expected " + std::to_string(num_cells) + " points in a keyframe's cloud, found " +
                 std::to_string(cloud.texels_.size()));
  }
  cloud.num_points_ = static_cast<std::size_t>(
      std::count_if(cloud.texels_.begin(), cloud.texels_.end(),
                    [](const KeyframeCloud::Texel& texel) { return texel.depth != 0; }));
  cloud.rays_ = std::move(rays);
  return std::make_shared<const KeyframeCloud>(std::move(cloud));
}

}  // namespace semslam
