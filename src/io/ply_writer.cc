// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <string>
#include <vector>

#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"

#include "io/cloud_columns.h"

namespace semslam {
namespace {

static_assert(std::endian::native == std::endian::little, "the header says so");

void AppendHeader(const std::vector<CloudColumn>& columns, std::string& header) {
  for (const CloudColumn& column : columns) {
    header += (column.type == 'F' ? "property float " : "property uint ") + column.name + '\n';
  }
}

void AppendValues(const CloudView& cloud,
                  const std::vector<CloudColumn>& columns,
                  std::size_t point,
                  std::string& bytes) {
  char value[4];
  for (const CloudColumn& column : columns) {
    column.write(cloud, point, value);
    bytes.append(value, sizeof(value));
  }
}

}  // namespace

void WritePly(const std::filesystem::path& path, const CloudView& cloud) {
  CheckLengths(cloud);
  std::vector<CloudColumn> geometry = PositionColumns();
  for (CloudColumn& column : NormalColumns(cloud, "nx", "ny", "nz")) {
    geometry.push_back(std::move(column));
  }
  const std::vector<CloudColumn> labels = LabelColumns(cloud);
  const bool has_color = !cloud.colors.empty();

  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment semslam; metres, world = first camera\n"
      "element vertex " +
      std::to_string(cloud.positions.size()) + '\n';
  AppendHeader(geometry, bytes);
  if (has_color) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  AppendHeader(labels, bytes);
  bytes += "end_header\n";

  AtomicFile file(path);
  constexpr std::size_t kChunk = 1 << 20;
  for (std::size_t point = 0; point < cloud.positions.size(); ++point) {
    AppendValues(cloud, geometry, point, bytes);
    if (has_color) {
      const Rgb color = cloud.colors[point];
      for (const unsigned char value : {color.r, color.g, color.b}) {
        bytes += static_cast<char>(value);
      }
    }
    AppendValues(cloud, labels, point, bytes);
    if (bytes.size() < kChunk) continue;
    file.Write(bytes);
    bytes.clear();
  }
  file.Write(bytes);
  file.Commit();
}

}  // namespace semslam
