// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/png_file.h"

#include <array>
#include <cstdint>

#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t kHeaderLength = 13;

std::uint32_t BigEndian32(std::string_view bytes, std::size_t position) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[position + i]);
  }
  return value;
}

// Tables for the check sum of PNG (polynomial 0xedb88320), four bytes a step.
using CrcTables = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr CrcTables MakeCrcTables() {
  CrcTables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value & 1) ? 0xedb88320U ^ (value >> 1) : value >> 1;
    tables[0][byte] = value;
  }
  for (std::size_t step = 1; step < tables.size(); ++step) {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[step - 1][byte];
      tables[step][byte] = tables[0][before & 0xff] ^ (before >> 8);
    }
  }
  return tables;
}

constexpr CrcTables kCrcTables = MakeCrcTables();

std::uint32_t Crc(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffU;
  const auto byte_at = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  std::size_t i = 0;
  for (; i + 4 <= bytes.size(); i += 4) {
    crc ^= static_cast<std::uint32_t>(byte_at(i)) |
           static_cast<std::uint32_t>(byte_at(i + 1)) << 8 |
           static_cast<std::uint32_t>(byte_at(i + 2)) << 16 |
           static_cast<std::uint32_t>(byte_at(i + 3)) << 24;
    crc = kCrcTables[3][crc & 0xff] ^ kCrcTables[2][crc >> 8 & 0xff] ^
          kCrcTables[1][crc >> 16 & 0xff] ^ kCrcTables[0][crc >> 24];
  }
  for (; i < bytes.size(); ++i) crc = kCrcTables[0][(crc ^ byte_at(i)) & 0xff] ^ (crc >> 8);
  return ~crc;
}

int NumChannels(int color_type) {
  switch (color_type) {
    case 2:
      return 3;  // Red, green, blue.
    case 4:
      return 2;  // Grey and alpha.
    case 6:
      return 4;  // Red, green, blue, alpha.
    default:
      return 1;  // Grey, palette.
  }
}

PngHeader ParseHeader(std::string_view data) {
  PngHeader header;
  header.width = static_cast<int>(BigEndian32(data, 0));
  header.height = static_cast<int>(BigEndian32(data, 4));
  header.bit_depth = static_cast<unsigned char>(data[8]);
  header.num_channels = NumChannels(static_cast<unsigned char>(data[9]));
  header.has_palette = data[9] == 3;
  return header;
}

}  // namespace

PngHeader CheckPng(const std::string& name, std::string_view bytes) {
  if (bytes.empty()) throw InputError(name + ": expected a PNG image, found an empty file");
  if (!bytes.starts_with(kSignature)) {
    throw InputError(name + ": expected a PNG image, found something else");
  }
  const auto fail_truncated = [&] {
    throw InputError(name + ": PNG image is cut short after " + std::to_string(bytes.size()) +
                     " bytes");
  };
  PngHeader header;
  bool is_first = true;
  for (std::size_t position = kSignature.size();;) {
    constexpr std::size_t kFrame = 12;  // Length, type and check sum around the data.
    if (bytes.size() - position < kFrame) fail_truncated();
    const std::size_t length = BigEndian32(bytes, position);
    if (bytes.size() - position - kFrame < length) fail_truncated();
    const std::string_view type = bytes.substr(position + 4, 4);
    if (Crc(bytes.substr(position + 4, length + 4)) != BigEndian32(bytes, position + 8 + length)) {
      throw InputError(name + ": PNG image is damaged: wrong check sum at byte " +
                       std::to_string(position));
    }
    if (is_first) {
      if (type != "IHDR" || length != kHeaderLength) {
        throw InputError(name + ": PNG image is damaged: no header");
      }
      header = ParseHeader(bytes.substr(position + 8, length));
      is_first = false;
    }
    if (type == "IEND") return header;
    position += kFrame + length;
  }
}

}  // namespace semslam
