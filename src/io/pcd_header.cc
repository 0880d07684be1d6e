// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_header.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "semslam/base/error.h"

#include "io/text_file.h"

namespace semslam {
namespace {

class HeaderParser {
 public:
  explicit HeaderParser(const std::string& name) : name_(name) {}

  // False once the line says where the data begin.
  bool Take(const std::vector<std::string>& words) {
    const std::string& key = words.front();
    if (key == "FIELDS") {
      header_.fields.resize(words.size() - 1);
      for (std::size_t i = 1; i < words.size(); ++i) header_.fields[i - 1].name = words[i];
    } else if (key == "SIZE") {
      ForEachField(words, [&](PcdField& field, const std::string& word) {
        field.size = Integer(key, word);
      });
    } else if (key == "COUNT") {
      ForEachField(words, [&](PcdField& field, const std::string& word) {
        field.count = Integer(key, word);
      });
    } else if (key == "TYPE") {
      ForEachField(words, [](PcdField& field, const std::string& word) { field.type = word[0]; });
    } else if (key == "POINTS" || key == "WIDTH" || key == "HEIGHT") {
      if (words.size() != 2) Fail(key, "expected one number");
      (key == "POINTS" ? points_ : key == "WIDTH" ? width_ : height_) = Integer(key, words[1]);
    } else if (key == "DATA") {
      header_.encoding = Encoding(words.size() == 2 ? words[1] : "");
      return false;
    }
    return true;
  }

  PcdHeader Finish() {
    if (header_.fields.empty()) Fail("FIELDS", "missing");
    for (const PcdField& field : header_.fields) {
      const bool is_known = field.type == 'F' ? field.size == 4 || field.size == 8
                                              : (field.type == 'U' || field.type == 'I') &&
                                                    (field.size == 1 || field.size == 2 ||
                                                     field.size == 4 || field.size == 8);
      constexpr std::size_t kMaxCount = 1 << 16;
      if (!is_known || field.count > kMaxCount) {
        Fail("field " + Quoted(field.name), std::string("type ") + field.type +
                                                std::to_string(field.size) + " x " +
                                                std::to_string(field.count) + " is not known");
      }
    }
    if (!points_ && !width_) Fail("POINTS", "missing");
    header_.num_points = points_ ? *points_ : *width_ * height_.value_or(1);
    return header_;
  }

 private:
  template <typename Set>
  void ForEachField(const std::vector<std::string>& words, Set set) {
    if (words.size() != header_.fields.size() + 1) {
      Fail(words.front(), "expected " + std::to_string(header_.fields.size()) + " values, found " +
                              std::to_string(words.size() - 1));
    }
    for (std::size_t i = 1; i < words.size(); ++i) set(header_.fields[i - 1], words[i]);
  }

  std::size_t Integer(const std::string& key, const std::string& word) const {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    constexpr std::size_t kMax = 1ULL << 31;  // So that no product of two overflows.
    if (error != std::errc() || end != word.data() + word.size() || value > kMax) {
      Fail(key, "expected an integer from 0 to 2147483648, found " + Quoted(word));
    }
    return value;
  }

  PcdEncoding Encoding(const std::string& word) const {
    if (word == "ascii") return PcdEncoding::kAscii;
    if (word == "binary") return PcdEncoding::kBinary;
    if (word == "binary_compressed") return PcdEncoding::kCompressed;
    Fail("DATA", "expected ascii, binary or binary_compressed, found " + Quoted(word));
  }

  [[noreturn]] void Fail(const std::string& key, const std::string& message) const {
    throw InputError(name_ + ": PCD header: " + key + ": " + message);
  }

  const std::string& name_;
  PcdHeader header_;
  std::optional<std::size_t> points_;
  std::optional<std::size_t> width_;
  std::optional<std::size_t> height_;
};

}  // namespace

std::size_t PcdHeader::PointSize() const {
  std::size_t size = 0;
  for (const PcdField& field : fields) size += field.size * field.count;
  return size;
}

PcdHeader ParsePcdHeader(const std::string& name, std::string_view bytes) {
  HeaderParser parser(name);
  constexpr std::size_t kMaxHeader = 1 << 16;
  std::size_t position = 0;
  while (position < std::min(bytes.size(), kMaxHeader)) {
    const std::size_t end = std::min(bytes.find('\n', position), bytes.size());
    const std::vector<std::string> words = SplitFields(bytes.substr(position, end - position));
    position = std::min(end + 1, bytes.size());
    if (words.empty() || words.front().starts_with('#')) continue;
    if (parser.Take(words)) continue;
    PcdHeader header = parser.Finish();
    header.data_start = position;
    return header;
  }
  throw InputError(name + ": expected a PCD file, found no PCD header with a DATA line");
}

}  // namespace semslam
