// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <pcl/PCLPointCloud2.h>
#include <pcl/PCLPointField.h>
#include <pcl/io/pcd_io.h>

#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"

#include "io/cloud_columns.h"

namespace semslam {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD files are little-endian");

constexpr std::uint32_t kValueSize = 4;  // Bytes of every value that we write.

std::vector<CloudColumn> PcdColumns(const CloudView& cloud) {
  std::vector<CloudColumn> columns = PositionColumns();
  for (const std::vector<CloudColumn>& group :
       {PackedColorColumn(cloud), NormalColumns(cloud, "normal_x", "normal_y", "normal_z"),
        LabelColumns(cloud)}) {
    columns.insert(columns.end(), group.begin(), group.end());
  }
  return columns;
}

// PCL compresses into a buffer of 3/2 the size, which it counts in 32 bits.
bool FitsIntoPcd(std::size_t num_bytes) {
  return num_bytes <= std::numeric_limits<std::uint32_t>::max() / 3 * 2;
}

pcl::PCLPointCloud2 ToPcl(const CloudView& cloud, const std::vector<CloudColumn>& columns) {
  const std::size_t num_points = cloud.positions.size();
  pcl::PCLPointCloud2 result;
  for (const CloudColumn& column : columns) {
    pcl::PCLPointField field;
    field.name = column.name;
    field.offset = kValueSize * static_cast<std::uint32_t>(result.fields.size());
    field.datatype = column.type == 'F' ? pcl::PCLPointField::FLOAT32 : pcl::PCLPointField::UINT32;
    field.count = 1;
    result.fields.push_back(field);
  }
  result.width = static_cast<std::uint32_t>(num_points);
  result.height = 1;
  result.point_step = kValueSize * static_cast<std::uint32_t>(columns.size());
  result.row_step = result.point_step * result.width;
  result.data.resize(std::size_t{result.point_step} * num_points);
  auto* output = reinterpret_cast<char*>(result.data.data());
  for (std::size_t point = 0; point < num_points; ++point) {
    for (const CloudColumn& column : columns) {
      column.write(cloud, point, output);
      output += kValueSize;
    }
  }
  return result;
}

// Without points PCL writes the same, but with a warning to the terminal.
int WriteCompressed(const pcl::PCLPointCloud2& cloud, std::ostream& output) {
  pcl::PCDWriter writer;
  if (!cloud.data.empty()) return writer.writeBinaryCompressed(output, cloud);
  const int result = writer.generateHeaderBinaryCompressed(output, cloud, Eigen::Vector4f::Zero(),
                                                           Eigen::Quaternionf::Identity());
  output << "DATA binary_compressed\n";
  constexpr char kNoBytesOfNone[2 * sizeof(std::uint32_t)] = {};
  output.write(kNoBytesOfNone, sizeof(kNoBytesOfNone));
  return result;
}

}  // namespace

void WritePcd(const std::filesystem::path& path, const CloudView& cloud) {
  CheckLengths(cloud);
  const std::vector<CloudColumn> columns = PcdColumns(cloud);
  std::ostringstream bytes;
  if (!FitsIntoPcd(kValueSize * columns.size() * cloud.positions.size()) ||
      WriteCompressed(ToPcl(cloud, columns), bytes) != 0 || !bytes) {
    throw InputError(path.string() + ": cannot write: PCL cannot compress " +
                     std::to_string(cloud.positions.size()) + " points of " +
                     std::to_string(kValueSize * columns.size()) + " bytes");
  }
  WriteFileAtomically(path, bytes.view());
}

}  // namespace semslam
