// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <liblzf/lzf.h>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"

#include "io/cloud_columns.h"

namespace semslam {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD files are little-endian");

constexpr std::size_t kValueSize = 4;  // Bytes of every value that we write.

std::vector<CloudColumn> PcdColumns(const CloudView& cloud) {
  std::vector<CloudColumn> columns = PositionColumns();
  for (const std::vector<CloudColumn>& group :
       {PackedColorColumn(cloud), NormalColumns(cloud, "normal_x", "normal_y", "normal_z"),
        LabelColumns(cloud)}) {
    columns.insert(columns.end(), group.begin(), group.end());
  }
  return columns;
}

// All values of the first column, then all of the next: like values compress best.
std::string ColumnByColumn(const CloudView& cloud, const std::vector<CloudColumn>& columns) {
  std::string bytes(kValueSize * columns.size() * cloud.positions.size(), '\0');
  char* output = bytes.data();
  for (const CloudColumn& column : columns) {
    for (std::size_t point = 0; point < cloud.positions.size(); ++point) {
      column.write(cloud, point, output);
      output += kValueSize;
    }
  }
  return bytes;
}

// Version 0.7; the words of all columns in one line each.
std::string Header(const std::vector<CloudColumn>& columns, std::size_t num_points) {
  std::string names;
  std::string sizes;
  std::string types;
  std::string counts;
  for (const CloudColumn& column : columns) {
    names += " " + column.name;
    sizes += " " + std::to_string(kValueSize);
    types += std::string(" ") + column.type;
    counts += " 1";
  }
  const std::string count = std::to_string(num_points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS" + names + "\nSIZE" +
         sizes + "\nTYPE" + types + "\nCOUNT" + counts + "\nWIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary_compressed\n";
}

void AppendSize(std::size_t size, std::string* bytes) {
  const auto value = static_cast<std::uint32_t>(size);
  bytes->append(reinterpret_cast<const char*>(&value), sizeof(value));
}

// The sizes after and before compression, and the compressed bytes, onto `file`.
void AppendCompressed(const std::string& bytes, std::string* file) {
  // What cannot be compressed grows by a byte in 32.
  const std::size_t room = bytes.size() + bytes.size() / 16 + 64;
  const std::size_t sizes = file->size();
  AppendSize(0, file);
  AppendSize(bytes.size(), file);
  if (bytes.empty()) return;
  const std::size_t begin = file->size();
  file->resize(begin + room);
  const unsigned compressed = lzf_compress(bytes.data(), static_cast<unsigned>(bytes.size()),
                                           file->data() + begin, static_cast<unsigned>(room));
  SEMSLAM_CHECK(compressed > 0) << bytes.size() << " bytes into " << room;
  file->resize(begin + compressed);
  std::memcpy(file->data() + sizes, &compressed, sizeof(compressed));
}

// Sizes have 32 bits in the file and in the library, with room to grow.
bool FitsIntoPcd(std::size_t num_bytes) {
  return num_bytes <= std::numeric_limits<std::uint32_t>::max() / 8 * 7;
}

}  // namespace

void WritePcd(const std::filesystem::path& path, const CloudView& cloud) {
  CheckLengths(cloud);
  const std::vector<CloudColumn> columns = PcdColumns(cloud);
  const std::size_t num_bytes = kValueSize * columns.size() * cloud.positions.size();
  if (!FitsIntoPcd(num_bytes)) {
    throw InputError(path.string() + ": cannot write: expected less than 3.7 GB for a compressed " +
                     "PCD file, found " + std::to_string(num_bytes) + " bytes in " +
                     std::to_string(cloud.positions.size()) + " points");
  }
  std::string file = Header(columns, cloud.positions.size());
  AppendCompressed(ColumnByColumn(cloud, columns), &file);
  WriteFileAtomically(path, file);
}

}  // namespace semslam
