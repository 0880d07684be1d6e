// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/png_writer.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "semslam/base/check.h"
#include "semslam/io/atomic_file.h"

#include "io/deflate.h"

namespace semslam {
namespace {

// The checksum of a chunk: remainders of a division of polynomials over two elements (PNG
// specification, annex D), eight bytes at a time.
constexpr std::size_t kStep = 8;
using CrcTables = std::array<std::array<std::uint32_t, 256>, kStep>;  // [bytes that follow][byte]

constexpr CrcTables MakeCrcTables() {
  CrcTables tables;
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (std::size_t k = 0; k < kStep; ++k) {
      for (int bit = 0; bit < 8; ++bit)
        remainder = (remainder >> 1) ^ ((remainder & 1U) != 0 ? 0xedb88320U : 0U);
      tables[k][byte] = remainder;
    }
  }
  return tables;
}

constexpr CrcTables kCrcTables = MakeCrcTables();

std::uint32_t Crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffU;
  const auto byte_at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  std::size_t i = 0;
  for (; i + kStep <= bytes.size(); i += kStep) {
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < kStep; ++k) {
      const std::uint32_t before = k < sizeof(crc) ? crc >> (8 * k) & 0xffU : 0U;
      next ^= kCrcTables[kStep - 1 - k][before ^ byte_at(i + k)];
    }
    crc = next;
  }
  for (; i < bytes.size(); ++i) crc = (crc >> 8) ^ kCrcTables[0][(crc ^ byte_at(i)) & 0xffU];
  return ~crc;
}

void AppendNumber(std::uint32_t number, std::string* bytes) {
  for (int shift = 24; shift >= 0; shift -= 8) *bytes += static_cast<char>(number >> shift & 0xffU);
}

// `type`: four letters.
void AppendChunk(std::string_view type, std::string_view data, std::string* file) {
  AppendNumber(static_cast<std::uint32_t>(data.size()), file);
  const std::size_t begin = file->size();
  *file += type;
  *file += data;
  AppendNumber(Crc32(std::string_view(*file).substr(begin)), file);
}

std::string Header(const cv::Mat& image) {
  std::string header;
  AppendNumber(static_cast<std::uint32_t>(image.cols), &header);
  AppendNumber(static_cast<std::uint32_t>(image.rows), &header);
  header += image.depth() == CV_16U ? '\x10' : '\x08';  // Bits of a number.
  header += image.channels() == 3 ? '\x02' : '\x00';    // Colour or grey.
  header += std::string(3, '\0');                       // No choice but for interlacing: none.
  return header;
}

// The bytes of a row in the file's order: red first, the high byte first.
void CopyRow(const cv::Mat& image, int row, std::uint8_t* bytes) {
  const cv::Mat source = image.row(row);
  cv::Mat target(1, image.cols, image.type(), bytes);
  if (image.type() == CV_8UC3) {
    cv::cvtColor(source, target, cv::COLOR_BGR2RGB);
    return;
  }
  source.copyTo(target);
  if (image.depth() != CV_16U) return;
  static_assert(std::endian::native == std::endian::little);
  auto* values = target.ptr<std::uint16_t>();
  for (int x = 0; x < image.cols; ++x)
    values[x] = static_cast<std::uint16_t>(values[x] << 8 | values[x] >> 8);
}

// Each row as the filter's number and the differences of all bytes to the pixel on the left.
std::vector<std::uint8_t> Filtered(const cv::Mat& image) {
  constexpr std::uint8_t kSub = 1;
  const std::size_t pixel_size = image.elemSize();
  const std::size_t row_size = pixel_size * image.cols;
  std::vector<std::uint8_t> result((row_size + 1) * image.rows);
  std::vector<std::uint8_t> row(pixel_size + row_size, 0);  // A black pixel first.
  for (int y = 0; y < image.rows; ++y) {
    CopyRow(image, y, row.data() + pixel_size);
    std::uint8_t* out = result.data() + (row_size + 1) * y;
    *out++ = kSub;
    for (std::size_t i = 0; i < row_size; ++i)
      out[i] = static_cast<std::uint8_t>(row[i + pixel_size] - row[i]);
  }
  return result;
}

}  // namespace

std::string EncodePng(const cv::Mat& image, PngContent content) {
  SEMSLAM_CHECK(!image.empty() &&
                (image.type() == CV_8UC1 || image.type() == CV_8UC3 || image.type() == CV_16UC1))
      << image.cols << "x" << image.rows << ", type " << image.type();
  const std::string pixels = Deflate(Filtered(image), content == PngContent::kFlat);
  std::string file = "\x89PNG\r\n\x1a\n";
  file.reserve(pixels.size() + 128);
  AppendChunk("IHDR", Header(image), &file);
  AppendChunk("IDAT", pixels, &file);
  AppendChunk("IEND", "", &file);
  return file;
}

void WritePng(const std::filesystem::path& path, const cv::Mat& image, PngContent content) {
  WriteFileAtomically(path, EncodePng(image, content));
}

}  // namespace semslam
