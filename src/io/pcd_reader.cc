// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <liblzf/lzf.h>

#include "semslam/base/error.h"
#include "semslam/io/cloud_io.h"

#include "io/pcd_header.h"
#include "io/text_file.h"

namespace semslam {
namespace {

// Where the values of a field lie: value i at start + i * stride.
struct FieldBytes {
  PcdField field;
  const char* start = nullptr;
  std::size_t stride = 0;
};

template <typename T>
T Load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

double ToDouble(const FieldBytes& f, std::size_t point) {
  const char* bytes = f.start + point * f.stride;
  if (f.field.type == 'F') return f.field.size == 4 ? Load<float>(bytes) : Load<double>(bytes);
  const bool is_signed = f.field.type == 'I';
  switch (f.field.size) {
    case 1:
      return is_signed ? Load<std::int8_t>(bytes) : Load<std::uint8_t>(bytes);
    case 2:
      return is_signed ? Load<std::int16_t>(bytes) : Load<std::uint16_t>(bytes);
    case 4:
      return is_signed ? Load<std::int32_t>(bytes) : Load<std::uint32_t>(bytes);
    default:
      return is_signed ? static_cast<double>(Load<std::int64_t>(bytes))
                       : static_cast<double>(Load<std::uint64_t>(bytes));
  }
}

template <typename T>
void AppendParsed(const std::string& name, std::string_view word, std::string& bytes) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw InputError(name + ": expected a number, found " + Quoted(word));
  }
  const std::size_t size = bytes.size();
  bytes.resize(size + sizeof(T));
  std::memcpy(bytes.data() + size, &value, sizeof(T));
}

void AppendWord(const std::string& name,
                const PcdField& field,
                std::string_view word,
                std::string& bytes) {
  const bool is_signed = field.type == 'I';
  if (field.type == 'F') {
    if (field.size == 4) return AppendParsed<float>(name, word, bytes);
    return AppendParsed<double>(name, word, bytes);
  }
  switch (field.size) {
    case 1:
      return is_signed ? AppendParsed<std::int8_t>(name, word, bytes)
                       : AppendParsed<std::uint8_t>(name, word, bytes);
    case 2:
      return is_signed ? AppendParsed<std::int16_t>(name, word, bytes)
                       : AppendParsed<std::uint16_t>(name, word, bytes);
    case 4:
      return is_signed ? AppendParsed<std::int32_t>(name, word, bytes)
                       : AppendParsed<std::uint32_t>(name, word, bytes);
    default:
      return is_signed ? AppendParsed<std::int64_t>(name, word, bytes)
                       : AppendParsed<std::uint64_t>(name, word, bytes);
  }
}

[[noreturn]] void FailTruncated(const std::string& name, const PcdHeader& header) {
  throw InputError(name + ": PCD file is cut short: expected " + std::to_string(header.num_points) +
                   " points of " + std::to_string(header.PointSize()) + " bytes");
}

// Text to the bytes of a binary file.
std::string ParseAscii(const std::string& name, const PcdHeader& header, std::string_view text) {
  std::string bytes;
  constexpr std::string_view kSpaces = " \t\r\n";
  std::size_t position = 0;
  for (std::size_t point = 0; point < header.num_points; ++point) {
    for (const PcdField& field : header.fields) {
      for (std::size_t i = 0; i < field.count; ++i) {
        const std::size_t first = text.find_first_not_of(kSpaces, position);
        if (first == std::string_view::npos) FailTruncated(name, header);
        position = std::min(text.find_first_of(kSpaces, first), text.size());
        AppendWord(name, field, text.substr(first, position - first), bytes);
      }
    }
  }
  return bytes;
}

std::string Decompress(const std::string& name, const PcdHeader& header, std::string_view bytes) {
  constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
  if (bytes.size() < kSizes) FailTruncated(name, header);
  const auto compressed_size = Load<std::uint32_t>(bytes.data());
  const auto size = Load<std::uint32_t>(bytes.data() + sizeof(std::uint32_t));
  if (bytes.size() - kSizes < compressed_size) FailTruncated(name, header);
  if (size != header.num_points * header.PointSize()) {
    throw InputError(name + ": PCD file is damaged: the header says " +
                     std::to_string(header.num_points * header.PointSize()) + " bytes, the data " +
                     std::to_string(size));
  }
  if (size == 0) return "";  // The library would read a byte that is not there.
  // Code grows to 88 times its size at most: no memory is asked for that it cannot fill.
  constexpr std::size_t kMaxGrowth = 88;
  std::string result(size <= kMaxGrowth * compressed_size ? size : 0, '\0');
  if (result.size() != size ||
      lzf_decompress(bytes.data() + kSizes, compressed_size, result.data(), size) != size) {
    throw InputError(name + ": PCD file is damaged: cannot be decompressed");
  }
  return result;
}

// The fields of a file whose values are uncompressed in `bytes`: point by point, or field by field.
class Fields {
 public:
  Fields(const PcdHeader& header, const std::string& bytes, bool field_by_field) {
    std::size_t offset = 0;
    for (const PcdField& field : header.fields) {
      const std::size_t size = field.size * field.count;
      fields_.push_back({field, bytes.data() + offset, field_by_field ? size : header.PointSize()});
      offset += field_by_field ? size * header.num_points : size;
    }
  }

  const FieldBytes* Find(std::string_view name) const {
    for (const FieldBytes& field : fields_) {
      if (field.field.name == name && field.field.count > 0) return &field;
    }
    return nullptr;
  }

 private:
  std::vector<FieldBytes> fields_;
};

Rgb UnpackColor(std::uint32_t packed) {
  return {static_cast<std::uint8_t>(packed >> 16), static_cast<std::uint8_t>(packed >> 8),
          static_cast<std::uint8_t>(packed)};
}

std::uint32_t ToLabel(double value) {
  return value >= 0 && value <= std::numeric_limits<std::uint32_t>::max()
             ? static_cast<std::uint32_t>(value)
             : 0;
}

CloudColumns Extract(const std::string& name, const Fields& fields, std::size_t num_points) {
  const FieldBytes* position[] = {fields.Find("x"), fields.Find("y"), fields.Find("z")};
  const FieldBytes* normal[] = {fields.Find("normal_x"), fields.Find("normal_y"),
                                fields.Find("normal_z")};
  const FieldBytes* color = fields.Find("rgba") ? fields.Find("rgba") : fields.Find("rgb");
  const FieldBytes* label = fields.Find("label");
  if (!position[0] || !position[1] || !position[2]) {
    throw InputError(name + ": PCD header: expected the fields x, y and z");
  }
  const auto vector_at = [](const FieldBytes* const* axes, std::size_t point) {
    return Eigen::Vector3d(ToDouble(*axes[0], point), ToDouble(*axes[1], point),
                           ToDouble(*axes[2], point))
        .cast<float>()
        .eval();
  };
  CloudColumns cloud;
  for (std::size_t point = 0; point < num_points; ++point) {
    const Eigen::Vector3f p = vector_at(position, point);
    if (!p.allFinite()) continue;
    cloud.positions.push_back(p);
    if (normal[0] && normal[1] && normal[2]) cloud.normals.push_back(vector_at(normal, point));
    if (color && color->field.size == 4) {
      cloud.colors.push_back(
          UnpackColor(Load<std::uint32_t>(color->start + point * color->stride)));
    }
    if (label) cloud.labels.push_back(ToLabel(ToDouble(*label, point)));
  }
  return cloud;
}

}  // namespace

CloudColumns ReadPcd(const std::filesystem::path& path) {
  const std::string name = path.string();
  const std::string bytes = ReadWholeFile(path);
  const PcdHeader header = ParsePcdHeader(name, bytes);
  const std::string_view data = std::string_view(bytes).substr(header.data_start);
  const bool is_compressed = header.encoding == PcdEncoding::kCompressed;
  std::string values;
  switch (header.encoding) {
    case PcdEncoding::kAscii:
      values = ParseAscii(name, header, data);
      break;
    case PcdEncoding::kCompressed:
      values = Decompress(name, header, data);
      break;
    case PcdEncoding::kBinary:
      if (header.PointSize() == 0 || data.size() / header.PointSize() < header.num_points) {
        FailTruncated(name, header);
      }
      values = data;
  }
  return Extract(name, Fields(header, values, is_compressed), header.num_points);
}

}  // namespace semslam
