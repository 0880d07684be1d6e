// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/png_writer.h"

#include <cstdint>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "semslam/base/error.h"
#include "semslam/io/atomic_file.h"

namespace semslam {

void WritePng(const std::filesystem::path& path, const cv::Mat& image, PngContent content) {
  // Without a level OpenCV takes its fastest: each pixel less its left neighbour, no long search.
  // Half the time of compression level 1.
  const int strategy = content == PngContent::kPhoto ? cv::IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY
                                                     : cv::IMWRITE_PNG_STRATEGY_RLE;
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_STRATEGY, strategy})) {
    throw InputError(path.string() + ": cannot encode the image");
  }
  WriteFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace semslam
