// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace semslam {

// Binary files are written as they lie in memory.
static_assert(std::endian::native == std::endian::little);

// What can be written byte by byte: no padding, whose bytes would be different from run to run.
template <typename T>
concept BinaryValue = std::is_trivially_copyable_v<T> &&
    (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::has_unique_object_representations_v<T>);

// Collects values into bytes.
class BinaryWriter {
 public:
  template <BinaryValue T>
  void Write(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  // With their number.
  template <typename T>
  requires BinaryValue<std::remove_const_t<T>>
  void WriteAll(std::span<T> values) {
    Write<std::uint64_t>(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void WriteText(std::string_view text) { WriteAll(std::span(text.data(), text.size())); }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Reads what a BinaryWriter wrote. Whatever the bytes are, it reads none beyond their end and takes
// no more memory than they could fill: throws InputError that says where they are wrong.
class BinaryReader {
 public:
  // `name` of the file, for errors. The bytes must outlive the reader.
  BinaryReader(std::span<const std::byte> bytes, std::string name);

  template <BinaryValue T>
  T Read() {
    T value;
    std::memcpy(&value, Take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  template <BinaryValue T>
  std::vector<T> ReadAll() {
    std::vector<T> values(ReadCount(sizeof(T)));
    if (values.empty()) return values;
    std::memcpy(values.data(), Take(values.size() * sizeof(T)).data(), values.size() * sizeof(T));
    return values;
  }
  std::string ReadText();
  // A number of things of which each takes at least so many of the bytes that are left.
  std::size_t ReadCount(std::size_t min_bytes_each);

  // In [0, count).
  std::uint32_t ReadIndex(std::size_t count, std::string_view what);
  // Finite.
  double ReadNumber(std::string_view what);

  bool is_at_end() const { return position_ == bytes_.size(); }

  // Throws: FILE: byte N: `what`.
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  std::span<const std::byte> Take(std::size_t size);

  std::span<const std::byte> bytes_;
  std::string name_;
  std::size_t position_ = 0;
};

}  // namespace semslam
