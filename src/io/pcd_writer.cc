// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"

#include "io/cloud_columns.h"
#include "io/lzf.h"

namespace semslam {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD files are little-endian");

std::vector<CloudColumn> PcdColumns(const CloudView& cloud) {
  std::vector<CloudColumn> columns = PositionColumns();
  for (const std::vector<CloudColumn>& group :
       {PackedColorColumn(cloud), NormalColumns(cloud, "normal_x", "normal_y", "normal_z"),
        LabelColumns(cloud)}) {
    columns.insert(columns.end(), group.begin(), group.end());
  }
  return columns;
}

std::string PcdHeader(const std::vector<CloudColumn>& columns, std::size_t num_points) {
  std::string fields = "FIELDS";
  std::string sizes = "SIZE";
  std::string types = "TYPE";
  std::string counts = "COUNT";
  for (const CloudColumn& column : columns) {
    fields += ' ' + column.name;
    sizes += " 4";
    types += std::string(" ") + column.type;
    counts += " 1";
  }
  const std::string count = std::to_string(num_points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields + '\n' + sizes +
         '\n' + types + '\n' + counts + "\nWIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary_compressed\n";
}

// All of a column, then all of the next, as the compressed form wants it.
std::string ColumnBytes(const CloudView& cloud, const std::vector<CloudColumn>& columns) {
  std::string bytes(4 * columns.size() * cloud.positions.size(), '\0');
  char* output = bytes.data();
  for (const CloudColumn& column : columns) {
    for (std::size_t point = 0; point < cloud.positions.size(); ++point) {
      column.write(cloud, point, output);
      output += 4;
    }
  }
  return bytes;
}

std::string SizeBytes(std::size_t size) {
  const auto value = static_cast<std::uint32_t>(size);
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  return bytes;
}

}  // namespace

void WritePcd(const std::filesystem::path& path, const CloudView& cloud) {
  CheckLengths(cloud);
  const std::vector<CloudColumn> columns = PcdColumns(cloud);
  const std::string bytes = ColumnBytes(cloud, columns);
  const std::string compressed = CompressLzf(bytes);
  if (std::max(bytes.size(), compressed.size()) > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(path.string() + ": cannot write: a PCD file holds at most 4 GB, found " +
                     std::to_string(cloud.positions.size()) + " points");
  }
  AtomicFile file(path);
  file.Write(PcdHeader(columns, cloud.positions.size()));
  file.Write(SizeBytes(compressed.size()));
  file.Write(SizeBytes(bytes.size()));
  file.Write(compressed);
  file.Commit();
}

}  // namespace semslam
