// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "semslam/base/error.h"
#include "semslam/io/cloud_io.h"

#include "io/text_file.h"

namespace semslam {
namespace {

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Property {
  std::string name;
  char kind = 'f';       // f: floating, i: signed, u: unsigned.
  std::size_t size = 0;  // Bytes.
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::size_t num_points = 0;
  std::vector<Property> properties;  // Of the element vertex, which comes first.
  std::size_t data_start = 0;
};

[[noreturn]] void Fail(const std::string& name, const std::string& message) {
  throw InputError(name + ": " + message);
}

std::optional<Property> ParseType(const std::string& type) {
  struct Type {
    const char* name;
    const char* other_name;
    char kind;
    std::size_t size;
  };
  constexpr std::array<Type, 8> kTypes = {{{"char", "int8", 'i', 1},
                                           {"uchar", "uint8", 'u', 1},
                                           {"short", "int16", 'i', 2},
                                           {"ushort", "uint16", 'u', 2},
                                           {"int", "int32", 'i', 4},
                                           {"uint", "uint32", 'u', 4},
                                           {"float", "float32", 'f', 4},
                                           {"double", "float64", 'f', 8}}};
  for (const Type& known : kTypes) {
    if (type == known.name || type == known.other_name) return Property{{}, known.kind, known.size};
  }
  return std::nullopt;
}

void ParseFormat(const std::string& name, const std::string& format, Header& header) {
  if (format == "ascii") {
    header.encoding = Encoding::kAscii;
  } else if (format == "binary_little_endian") {
    header.encoding = Encoding::kLittleEndian;
  } else if (format == "binary_big_endian") {
    header.encoding = Encoding::kBigEndian;
  } else {
    Fail(name, "PLY format: expected ascii or binary, found " + Quoted(format));
  }
}

void ParseCount(const std::string& name, const std::string& count, Header& header) {
  const char* end = count.data() + count.size();
  const auto [stop, error] = std::from_chars(count.data(), end, header.num_points);
  if (error != std::errc() || stop != end) {
    Fail(name, "PLY element vertex: expected a number, found " + Quoted(count));
  }
}

void ParseProperty(const std::string& name, const std::vector<std::string>& words, Header& header) {
  std::optional<Property> property;
  if (words.size() == 3) property = ParseType(words[1]);
  if (!property) Fail(name, "PLY property of vertex: expected a type and a name");
  property->name = words[2];
  header.properties.push_back(std::move(*property));
}

Header ParseHeader(const std::string& name, std::string_view bytes) {
  Header header;
  bool is_first = true;
  std::string element;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    std::string_view line = bytes.substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::vector<std::string> words = SplitFields(line);
    begin = end + 1;
    if (is_first && line != "ply") break;
    is_first = false;
    if (words.empty()) continue;
    if (words[0] == "end_header") {
      if (header.properties.empty()) Fail(name, "PLY: expected an element vertex, found none");
      header.data_start = begin;
      return header;
    }
    if (words[0] == "format" && words.size() == 3) ParseFormat(name, words[1], header);
    if (words[0] == "element" && words.size() == 3) {
      if (element.empty() && words[1] != "vertex") {
        Fail(name, "PLY: expected vertex as the first element, found " + Quoted(words[1]));
      }
      element = words[1];
      if (element == "vertex") ParseCount(name, words[2], header);
    }
    if (words[0] == "property" && element == "vertex") ParseProperty(name, words, header);
  }
  Fail(name, is_first ? "expected a PLY file that starts with \"ply\""
                      : "PLY header: expected end_header, found the end of the file");
}

template <typename T>
double Load(const std::array<char, 8>& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

double LoadValue(const Property& property, const char* start, bool is_big_endian) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, 8> bytes{};
  std::copy_n(start, property.size, bytes.begin());
  if (is_big_endian) {
    std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(property.size));
  }
  if (property.kind == 'f') return property.size == 4 ? Load<float>(bytes) : Load<double>(bytes);
  const bool is_signed = property.kind == 'i';
  switch (property.size) {
    case 1:
      return is_signed ? Load<std::int8_t>(bytes) : Load<std::uint8_t>(bytes);
    case 2:
      return is_signed ? Load<std::int16_t>(bytes) : Load<std::uint16_t>(bytes);
    default:
      return is_signed ? Load<std::int32_t>(bytes) : Load<std::uint32_t>(bytes);
  }
}

// Gives the values of one vertex after the other.
class Vertices {
 public:
  Vertices(const std::string& name, const Header& header, std::string_view data)
      : name_(name), header_(header), data_(data) {}

  void Next(std::vector<double>& values) {
    values.clear();
    for (const Property& property : header_.properties) {
      values.push_back(header_.encoding == Encoding::kAscii ? NextWord() : NextBytes(property));
    }
  }

 private:
  double NextBytes(const Property& property) {
    if (data_.size() < property.size) FailTruncated();
    const double value =
        LoadValue(property, data_.data(), header_.encoding == Encoding::kBigEndian);
    data_.remove_prefix(property.size);
    return value;
  }
  double NextWord() {
    constexpr std::string_view kSpace = " \t\r\n";
    data_.remove_prefix(std::min(data_.find_first_not_of(kSpace), data_.size()));
    if (data_.empty()) FailTruncated();
    const std::string_view word = data_.substr(0, data_.find_first_of(kSpace));
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size()) {
      Fail(name_, "PLY vertex: expected a number, found " + Quoted(word));
    }
    data_.remove_prefix(word.size());
    return value;
  }
  [[noreturn]] void FailTruncated() const {
    Fail(name_, "expected " + std::to_string(header_.num_points) +
                    " points, found the end of the file before");
  }

  const std::string& name_;
  const Header& header_;
  std::string_view data_;
};

std::optional<std::size_t> FindProperty(const Header& header, std::string_view name) {
  for (std::size_t i = 0; i < header.properties.size(); ++i) {
    if (header.properties[i].name == name) return i;
  }
  return std::nullopt;
}

// Where three properties stand, if all are there.
std::optional<std::array<std::size_t, 3>> FindThree(const Header& header,
                                                    const std::array<const char*, 3>& names) {
  std::array<std::size_t, 3> places{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<std::size_t> place = FindProperty(header, names[i]);
    if (!place) return std::nullopt;
    places[i] = *place;
  }
  return places;
}

Eigen::Vector3f VectorAt(const std::vector<double>& values,
                         const std::array<std::size_t, 3>& places) {
  return Eigen::Vector3d(values[places[0]], values[places[1]], values[places[2]]).cast<float>();
}

}  // namespace

CloudColumns ReadPly(const std::filesystem::path& path) {
  const std::string name = path.string();
  const std::string bytes = ReadWholeFile(path);
  const Header header = ParseHeader(name, bytes);
  const auto position = FindThree(header, {"x", "y", "z"});
  if (!position) Fail(name, "PLY: expected the vertex properties x, y and z");
  const auto normal = FindThree(header, {"nx", "ny", "nz"});
  const auto color = FindThree(header, {"red", "green", "blue"});
  const auto label = FindProperty(header, "label");

  CloudColumns cloud;
  Vertices vertices(name, header, std::string_view(bytes).substr(header.data_start));
  std::vector<double> values;
  for (std::size_t i = 0; i < header.num_points; ++i) {
    vertices.Next(values);
    const Eigen::Vector3f p = VectorAt(values, *position);
    if (!p.allFinite()) continue;
    cloud.positions.push_back(p);
    if (normal) cloud.normals.push_back(VectorAt(values, *normal));
    const auto channel = [&](std::size_t k) {
      return static_cast<std::uint8_t>(std::clamp(values[(*color)[k]], 0.0, 255.0));
    };
    if (color) cloud.colors.push_back({channel(0), channel(1), channel(2)});
    constexpr double kMaxLabel = 4294967295.0;
    if (label) {
      cloud.labels.push_back(
          static_cast<std::uint32_t>(std::clamp(values[*label], 0.0, kMaxLabel)));
    }
  }
  return cloud;
}

}  // namespace semslam
