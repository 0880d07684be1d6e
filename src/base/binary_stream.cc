// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/binary_stream.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "semslam/base/error.h"

namespace semslam {

BinaryReader::BinaryReader(std::span<const std::byte> bytes, std::string name)
    : bytes_(bytes), name_(std::move(name)) {}

std::span<const std::byte> BinaryReader::Take(std::size_t size) {
  const std::size_t num_left = bytes_.size() - position_;
  if (size > num_left) {
    Fail("expected " + std::to_string(size) + " bytes more, found " + std::to_string(num_left));
  }
  const std::span<const std::byte> taken = bytes_.subspan(position_, size);
  position_ += size;
  return taken;
}

std::size_t BinaryReader::ReadCount(std::size_t min_bytes_each) {
  const auto count = Read<std::uint64_t>();
  const std::size_t num_left = bytes_.size() - position_;
  if (count > num_left / std::max<std::size_t>(min_bytes_each, 1)) {
    Fail("expected a number that " + std::to_string(num_left) + " bytes can hold, found " +
         std::to_string(count));
  }
  return static_cast<std::size_t>(count);
}

std::string BinaryReader::ReadText() {
  const std::vector<char> text = ReadAll<char>();
  return {text.begin(), text.end()};
}

std::uint32_t BinaryReader::ReadIndex(std::size_t count, std::string_view what) {
  const auto index = Read<std::uint32_t>();
  if (index >= count) {
    Fail("expected a " + std::string(what) + " below " + std::to_string(count) + ", found " +
         std::to_string(index));
  }
  return index;
}

double BinaryReader::ReadNumber(std::string_view what) {
  const auto number = Read<double>();
  if (!std::isfinite(number)) Fail("expected a finite " + std::string(what));
  return number;
}

void BinaryReader::Fail(const std::string& what) const {
  throw InputError(name_ + ": byte " + std::to_string(position_) + ": " + what);
}

}  // namespace semslam
