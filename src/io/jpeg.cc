// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/jpeg.h"

#include <memory>
#include <type_traits>

#include <turbojpeg.h>

#include "semslam/base/check.h"

namespace semslam {
namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};
struct Free {
  void operator()(unsigned char* bytes) const { tjFree(bytes); }
};
using Handle = std::unique_ptr<std::remove_pointer_t<tjhandle>, Destroy>;

}  // namespace

std::string EncodeJpeg(const cv::Mat& image, int quality) {
  SEMSLAM_CHECK(image.type() == CV_8UC3 && !image.empty())
      << image.cols << "x" << image.rows << ", type " << image.type();
  SEMSLAM_CHECK(quality >= 1 && quality <= 100) << quality;
  const Handle encoder(tjInitCompress());
  SEMSLAM_CHECK(encoder != nullptr);
  unsigned char* output = nullptr;
  unsigned long size = 0;
  const int result =
      tjCompress2(encoder.get(), image.data, image.cols, static_cast<int>(image.step), image.rows,
                  TJPF_BGR, &output, &size, TJSAMP_420, quality, 0);
  const std::unique_ptr<unsigned char, Free> bytes(output);
  SEMSLAM_CHECK(result == 0) << "JPEG: " << tjGetErrorStr2(encoder.get());
  return {reinterpret_cast<const char*>(bytes.get()), size};
}

cv::Mat DecodeJpeg(std::string_view jpeg) {
  const Handle decoder(tjInitDecompress());
  SEMSLAM_CHECK(decoder != nullptr);
  const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  if (tjDecompressHeader3(decoder.get(), bytes, jpeg.size(), &width, &height, &subsampling,
                          &color_space) != 0) {
    return {};
  }
  cv::Mat image(height, width, CV_8UC3);
  const int result =
      tjDecompress2(decoder.get(), bytes, jpeg.size(), image.data, width,
                    static_cast<int>(image.step), height, TJPF_BGR, TJFLAG_STOPONWARNING);
  return result == 0 ? image : cv::Mat();
}

}  // namespace semslam
