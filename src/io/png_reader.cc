// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/png_reader.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include <opencv2/imgproc.hpp>
#include <spng.h>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

namespace semslam {
namespace {

// Rows of a file may claim 2^31 pixels: no memory is asked for that no camera's image needs.
constexpr std::uint32_t kMaxSide = 1U << 15;

int NumChannels(int color_type) {
  switch (color_type) {
    case SPNG_COLOR_TYPE_TRUECOLOR:
      return 3;
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return 2;
    case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
      return 4;
    default:
      return 1;  // Grey, palette.
  }
}

}  // namespace

void PngReader::Free::operator()(spng_ctx* context) const { spng_ctx_free(context); }

PngReader::PngReader(std::string name, std::string_view bytes)
    : name_(std::move(name)), num_bytes_(bytes.size()), context_(spng_ctx_new(0)) {
  SEMSLAM_CHECK(context_ != nullptr);
  if (bytes.empty()) throw InputError(name_ + ": expected a PNG image, found an empty file");
  Check(spng_set_image_limits(context_.get(), kMaxSide, kMaxSide));
  Check(spng_set_png_buffer(context_.get(), bytes.data(), bytes.size()));
  spng_ihdr header = {};
  Check(spng_get_ihdr(context_.get(), &header));
  header_ = {.width = static_cast<int>(header.width),
             .height = static_cast<int>(header.height),
             .bit_depth = header.bit_depth,
             .num_channels = NumChannels(header.color_type),
             .has_palette = header.color_type == SPNG_COLOR_TYPE_INDEXED};
}

cv::Mat PngReader::Decode(PngPixels pixels) {
  const bool is_color = pixels == PngPixels::kBgr8;
  SEMSLAM_CHECK(is_color || (header_.bit_depth == 16 && header_.num_channels == 1)) << name_;
  const int format = is_color ? SPNG_FMT_RGB8 : SPNG_FMT_PNG;
  cv::Mat image(header_.height, header_.width, is_color ? CV_8UC3 : CV_16UC1);
  std::size_t num_bytes = 0;
  Check(spng_decoded_image_size(context_.get(), format, &num_bytes));
  SEMSLAM_CHECK(num_bytes == image.total() * image.elemSize()) << name_ << ": " << num_bytes;
  Check(spng_decode_image(context_.get(), image.data, num_bytes, format, 0));
  Check(spng_decode_chunks(context_.get()));  // What follows the pixels, up to the end mark.
  if (is_color) cv::cvtColor(image, image, cv::COLOR_RGB2BGR);
  return image;
}

void PngReader::Check(int result) const {
  switch (result) {
    case SPNG_OK:
      return;
    case SPNG_ESIGNATURE:
      throw InputError(name_ + ": expected a PNG image, found something else");
    case SPNG_IO_EOF:
      throw InputError(name_ + ": PNG image is cut short after " + std::to_string(num_bytes_) +
                       " bytes");
    default:
      throw InputError(name_ + ": PNG image is damaged: " + spng_strerror(result));
  }
}

}  // namespace semslam
