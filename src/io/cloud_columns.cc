// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_columns.h"

#include <cstdint>
#include <cstring>

#include "semslam/base/check.h"

namespace semslam {
namespace {

template <typename T>
void Put(T value, char* four_bytes) {
  static_assert(sizeof(T) == 4);
  std::memcpy(four_bytes, &value, sizeof(T));
}

template <int kAxis>
void PutPosition(const CloudView& cloud, std::size_t point, char* four_bytes) {
  Put(cloud.positions[point][kAxis], four_bytes);
}

template <int kAxis>
void PutNormal(const CloudView& cloud, std::size_t point, char* four_bytes) {
  Put(cloud.normals[point][kAxis], four_bytes);
}

template <auto kMember>
void PutValue(const CloudView& cloud, std::size_t point, char* four_bytes) {
  Put((cloud.*kMember)[point], four_bytes);
}

void PutColor(const CloudView& cloud, std::size_t point, char* four_bytes) {
  const Rgb color = cloud.colors[point];
  constexpr std::uint32_t kOpaque = 0xff000000U;
  Put(kOpaque | static_cast<std::uint32_t>(color.r) << 16 |
          static_cast<std::uint32_t>(color.g) << 8 | color.b,
      four_bytes);
}

}  // namespace

void CheckLengths(const CloudView& cloud) {
  const std::size_t size = cloud.positions.size();
  for (const std::size_t length :
       {cloud.colors.size(), cloud.normals.size(), cloud.labels.size(), cloud.segments.size(),
        cloud.objects.size(), cloud.confidences.size(), cloud.entropies.size()}) {
    SEMSLAM_CHECK(length == 0 || length == size) << length << " values for " << size << " points";
  }
}

std::vector<CloudColumn> PositionColumns() {
  return {{"x", 'F', PutPosition<0>}, {"y", 'F', PutPosition<1>}, {"z", 'F', PutPosition<2>}};
}

std::vector<CloudColumn> NormalColumns(const CloudView& cloud,
                                       const std::string& x,
                                       const std::string& y,
                                       const std::string& z) {
  if (cloud.normals.empty()) return {};
  return {{x, 'F', PutNormal<0>}, {y, 'F', PutNormal<1>}, {z, 'F', PutNormal<2>}};
}

std::vector<CloudColumn> PackedColorColumn(const CloudView& cloud) {
  if (cloud.colors.empty()) return {};
  return {{"rgba", 'U', PutColor}};
}

std::vector<CloudColumn> LabelColumns(const CloudView& cloud) {
  std::vector<CloudColumn> columns;
  if (!cloud.labels.empty()) columns.push_back({"label", 'U', PutValue<&CloudView::labels>});
  if (!cloud.segments.empty()) columns.push_back({"segment", 'U', PutValue<&CloudView::segments>});
  if (!cloud.objects.empty()) columns.push_back({"object", 'U', PutValue<&CloudView::objects>});
  if (!cloud.confidences.empty()) {
    columns.push_back({"confidence", 'F', PutValue<&CloudView::confidences>});
  }
  if (!cloud.entropies.empty()) {
    columns.push_back({"entropy", 'F', PutValue<&CloudView::entropies>});
  }
  return columns;
}

}  // namespace semslam
