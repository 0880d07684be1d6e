// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "semslam/base/error.h"
#include "semslam/io/cloud_io.h"

#include "io/text_file.h"

namespace semslam {
namespace {

static_assert(std::endian::native == std::endian::little, "values are swapped for the other order");

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

// Type of a number in a file.
struct NumberType {
  char kind = 'F';  // F: float, U: unsigned, I: signed.
  std::size_t size = 4;
};

struct Property {
  std::string name;
  NumberType type;
  std::size_t offset = 0;  // Of the value in a binary vertex; its place in a line of text.
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::size_t num_points = 0;
  std::vector<Property> properties;
  std::size_t vertex_size = 0;  // Bytes.
  std::size_t data_start = 0;
};

[[noreturn]] void Fail(const std::string& name, const std::string& what) {
  throw InputError(name + ": PLY " + what);
}

std::optional<NumberType> FindType(std::string_view word) {
  struct Entry {
    std::array<std::string_view, 2> names;
    NumberType type;
  };
  static constexpr std::array<Entry, 8> kTypes = {{{{"char", "int8"}, {'I', 1}},
                                                   {{"uchar", "uint8"}, {'U', 1}},
                                                   {{"short", "int16"}, {'I', 2}},
                                                   {{"ushort", "uint16"}, {'U', 2}},
                                                   {{"int", "int32"}, {'I', 4}},
                                                   {{"uint", "uint32"}, {'U', 4}},
                                                   {{"float", "float32"}, {'F', 4}},
                                                   {{"double", "float64"}, {'F', 8}}}};
  for (const Entry& entry : kTypes) {
    if (word == entry.names[0] || word == entry.names[1]) return entry.type;
  }
  return std::nullopt;
}

// Reads the header line by line.
class HeaderParser {
 public:
  HeaderParser(const std::string& name, std::string_view bytes) : name_(name), bytes_(bytes) {}

  Header Parse() {
    if (NextLine() != "ply") Fail(name_, "header: expected the first line ply");
    while (true) {
      const std::string line = NextLine();
      std::istringstream words(line);
      std::string keyword;
      words >> keyword;
      if (keyword == "end_header") break;
      if (keyword == "format") ReadFormat(words);
      if (keyword == "element") ReadElement(words);
      if (keyword == "property" && is_in_vertex_) ReadProperty(words);
    }
    if (!has_format_) Fail(name_, "header: expected a line with the format");
    if (!has_vertex_) Fail(name_, "header: expected an element vertex");
    header_.data_start = position_;
    return header_;
  }

 private:
  std::string NextLine() {
    constexpr std::size_t kMaxLine = 4096;
    const std::size_t end = bytes_.substr(0, position_ + kMaxLine).find('\n', position_);
    if (end == std::string_view::npos) Fail(name_, "header: expected end_header");
    std::string line(bytes_.substr(position_, end - position_));
    position_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  void ReadFormat(std::istringstream& words) {
    std::string format;
    words >> format;
    // It decides where the values of the properties lie.
    if (has_format_) Fail(name_, "header: expected one line with the format");
    has_format_ = true;
    if (format == "ascii") {
      header_.encoding = Encoding::kAscii;
    } else if (format == "binary_little_endian") {
      header_.encoding = Encoding::kLittleEndian;
    } else if (format == "binary_big_endian") {
      header_.encoding = Encoding::kBigEndian;
    } else {
      Fail(name_, "header: unknown format " + Quoted(format));
    }
  }

  void ReadElement(std::istringstream& words) {
    std::string element;
    long long count = -1;
    words >> element >> count;
    if (!has_format_) Fail(name_, "header: expected the format before the elements");
    if (element == "vertex" && has_vertex_) Fail(name_, "header: expected one element vertex");
    is_in_vertex_ = element == "vertex";
    if (!is_in_vertex_ && !has_vertex_ && count != 0)
      Fail(name_, "header: expected the vertices first, found " + Quoted(element));
    if (!is_in_vertex_) return;
    if (count < 0) Fail(name_, "header: expected a number of vertices");
    has_vertex_ = true;
    header_.num_points = static_cast<std::size_t>(count);
  }

  void ReadProperty(std::istringstream& words) {
    std::string type_name;
    Property property;
    words >> type_name >> property.name;
    const std::optional<NumberType> type = FindType(type_name);
    if (!type || property.name.empty())
      Fail(name_, "header: vertices with a property of unknown type " + Quoted(type_name));
    property.type = *type;
    const bool is_text = header_.encoding == Encoding::kAscii;
    property.offset = is_text ? header_.properties.size() : header_.vertex_size;
    header_.vertex_size += type->size;
    header_.properties.push_back(property);
  }

  const std::string& name_;
  std::string_view bytes_;
  std::size_t position_ = 0;
  Header header_;
  bool has_format_ = false;
  bool has_vertex_ = false;
  bool is_in_vertex_ = false;
};

template <typename T>
double Load(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> own{};
  std::memcpy(own.data(), bytes, sizeof(T));
  if (swap) std::reverse(own.begin(), own.end());
  T value;
  std::memcpy(&value, own.data(), sizeof(T));
  return static_cast<double>(value);
}

double LoadNumber(NumberType type, const char* bytes, bool swap) {
  if (type.kind == 'F')
    return type.size == 4 ? Load<float>(bytes, swap) : Load<double>(bytes, swap);
  const bool is_signed = type.kind == 'I';
  switch (type.size) {
    case 1:
      return is_signed ? Load<std::int8_t>(bytes, swap) : Load<std::uint8_t>(bytes, swap);
    case 2:
      return is_signed ? Load<std::int16_t>(bytes, swap) : Load<std::uint16_t>(bytes, swap);
    default:
      return is_signed ? Load<std::int32_t>(bytes, swap) : Load<std::uint32_t>(bytes, swap);
  }
}

// Vertices one after the other, whatever the encoding.
class Vertices {
 public:
  Vertices(const std::string& name, const Header& header, std::string_view data)
      : name_(name), header_(header), data_(data) {
    if (header.vertex_size == 0) Fail(name, "header: vertices without properties");
    const std::size_t least =
        header.encoding == Encoding::kAscii ? 2 * header.properties.size() : header.vertex_size;
    // The last line of text may end without a break.
    if ((data.size() + 1) / least < header.num_points) FailTruncated();
    if (header.encoding == Encoding::kAscii) line_.resize(header.properties.size());
  }

  void Next() {
    if (header_.encoding == Encoding::kAscii) return ReadLine();
    if (data_.size() < position_ + header_.vertex_size) FailTruncated();
    vertex_ = data_.data() + position_;
    position_ += header_.vertex_size;
  }

  double Value(const Property& property) const {
    if (header_.encoding == Encoding::kAscii) return line_[property.offset];
    return LoadNumber(property.type, vertex_ + property.offset,
                      header_.encoding == Encoding::kBigEndian);
  }

 private:
  [[noreturn]] void FailTruncated() const {
    Fail(name_, "file is cut short: expected " + std::to_string(header_.num_points) + " vertices");
  }

  void ReadLine() {
    constexpr std::string_view kSpaces = " \t\r\n";
    for (double& value : line_) {
      const std::size_t first = data_.find_first_not_of(kSpaces, position_);
      if (first == std::string_view::npos) FailTruncated();
      position_ = std::min(data_.find_first_of(kSpaces, first), data_.size());
      const std::string_view word = data_.substr(first, position_ - first);
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size())
        Fail(name_, "file: expected a number, found " + Quoted(word));
    }
  }

  const std::string& name_;
  const Header& header_;
  std::string_view data_;
  std::size_t position_ = 0;
  const char* vertex_ = nullptr;
  std::vector<double> line_;
};

std::uint32_t ToId(double value) {
  return value >= 0 && value <= std::numeric_limits<std::uint32_t>::max()
             ? static_cast<std::uint32_t>(value)
             : 0;
}

// Colours are bytes, or shares of 1.
std::uint8_t ToChannel(const Property& property, double value) {
  const double byte = property.type.kind == 'F' ? 255 * value : value;
  return byte >= 0 ? static_cast<std::uint8_t>(std::min(byte, 255.0)) : std::uint8_t{0};
}

// Properties that make one value, or nothing if one is missing.
using Axes = std::optional<std::array<const Property*, 3>>;

const Property* Find(const Header& header, std::string_view name) {
  const auto found = std::find_if(header.properties.begin(), header.properties.end(),
                                  [name](const Property& p) { return p.name == name; });
  return found == header.properties.end() ? nullptr : &*found;
}

Axes FindAxes(const Header& header, const std::array<std::string_view, 3>& names) {
  std::array<const Property*, 3> axes{};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    axes[i] = Find(header, names[i]);
    if (axes[i] == nullptr) return std::nullopt;
  }
  return axes;
}

CloudColumns Extract(const std::string& name, const Header& header, std::string_view data) {
  const Axes position = FindAxes(header, {"x", "y", "z"});
  const Axes normal = FindAxes(header, {"nx", "ny", "nz"});
  const Axes color = FindAxes(header, {"red", "green", "blue"});
  const Property* label = Find(header, "label");
  const Property* segment = Find(header, "segment");
  const Property* object = Find(header, "object");
  const Property* confidence = Find(header, "confidence");
  const Property* entropy = Find(header, "entropy");
  if (!position) Fail(name, "header: expected the properties x, y and z");
  Vertices vertices(name, header, data);
  const auto vector_of = [&vertices](const std::array<const Property*, 3>& axes) {
    return Eigen::Vector3d(vertices.Value(*axes[0]), vertices.Value(*axes[1]),
                           vertices.Value(*axes[2]))
        .cast<float>()
        .eval();
  };
  CloudColumns cloud;
  for (std::size_t i = 0; i < header.num_points; ++i) {
    vertices.Next();
    const Eigen::Vector3f p = vector_of(*position);
    if (!p.allFinite()) continue;
    cloud.positions.push_back(p);
    if (normal) cloud.normals.push_back(vector_of(*normal));
    if (color) {
      const auto channel = [&](std::size_t k) {
        return ToChannel(*(*color)[k], vertices.Value(*(*color)[k]));
      };
      cloud.colors.push_back({channel(0), channel(1), channel(2)});
    }
    if (label) cloud.labels.push_back(ToId(vertices.Value(*label)));
    if (segment) cloud.segments.push_back(ToId(vertices.Value(*segment)));
    if (object) cloud.objects.push_back(ToId(vertices.Value(*object)));
    if (confidence) cloud.confidences.push_back(static_cast<float>(vertices.Value(*confidence)));
    if (entropy) cloud.entropies.push_back(static_cast<float>(vertices.Value(*entropy)));
  }
  return cloud;
}

}  // namespace

CloudColumns ReadPly(const std::filesystem::path& path) {
  const std::string name = path.string();
  const std::string bytes = ReadWholeFile(path);
  const Header header = HeaderParser(name, bytes).Parse();
  return Extract(name, header, std::string_view(bytes).substr(header.data_start));
}

}  // namespace semslam
