// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/png_writer.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include <opencv2/imgproc.hpp>
#include <spng.h>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"

namespace semslam {
namespace {

// zlib's strategies, of which photographs and drawings take half the time of its default.
constexpr int kHuffmanOnly = 2;
constexpr int kRuns = 3;

struct Free {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
  void operator()(void* memory) const { std::free(memory); }
};

void Check(int result) { SEMSLAM_CHECK(result == SPNG_OK) << "PNG: " << spng_strerror(result); }

// The image as a PNG file has it: rows without gaps, red first.
cv::Mat InFileOrder(const cv::Mat& image) {
  if (image.type() != CV_8UC3) return image.isContinuous() ? image : image.clone();
  cv::Mat rgb;
  cv::cvtColor(image, rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

}  // namespace

std::string EncodePng(const cv::Mat& image, PngContent content) {
  SEMSLAM_CHECK(!image.empty() &&
                (image.type() == CV_8UC1 || image.type() == CV_8UC3 || image.type() == CV_16UC1))
      << image.cols << "x" << image.rows << ", type " << image.type();
  const cv::Mat pixels = InFileOrder(image);
  const std::unique_ptr<spng_ctx, Free> context(spng_ctx_new(SPNG_CTX_ENCODER));
  SEMSLAM_CHECK(context != nullptr);
  const auto set = [&](spng_option option, int value) {
    Check(spng_set_option(context.get(), option, value));
  };
  set(SPNG_ENCODE_TO_BUFFER, 1);
  // Each pixel less its left neighbour, no long search.
  set(SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB);
  set(SPNG_IMG_COMPRESSION_LEVEL, 1);
  set(SPNG_IMG_COMPRESSION_STRATEGY, content == PngContent::kPhoto ? kHuffmanOnly : kRuns);
  spng_ihdr header = {};
  header.width = static_cast<std::uint32_t>(pixels.cols);
  header.height = static_cast<std::uint32_t>(pixels.rows);
  header.bit_depth = pixels.depth() == CV_16U ? 16 : 8;
  header.color_type =
      pixels.channels() == 3 ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_GRAYSCALE;
  Check(spng_set_ihdr(context.get(), &header));
  Check(spng_encode_image(context.get(), pixels.data, pixels.total() * pixels.elemSize(),
                          SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int result = SPNG_OK;
  const std::unique_ptr<void, Free> bytes(spng_get_png_buffer(context.get(), &size, &result));
  Check(result);
  return {static_cast<const char*>(bytes.get()), size};
}

void WritePng(const std::filesystem::path& path, const cv::Mat& image, PngContent content) {
  WriteFileAtomically(path, EncodePng(image, content));
}

}  // namespace semslam
