// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <opencv2/core/mat.hpp>

struct spng_ctx;

namespace semslam {

// What the header of a PNG file says.
struct PngHeader {
  int width = 0;
  int height = 0;
  int bit_depth = 0;     // Of a channel, or of a palette index.
  int num_channels = 0;  // 1 for grey and for palette images.
  bool has_palette = false;
};

enum class PngPixels {
  kBgr8,     // CV_8UC3, of any file; transparency is left out.
  kAsStored  // CV_16UC1, of a file of 16-bit grey levels.
};

// Reads a PNG file from memory, once. All check sums up to the end mark must be right, and nothing
// before the end mark's own may be missing. Throws InputError whose text starts with `name`.
class PngReader {
 public:
  // `bytes` must outlive this.
  PngReader(std::string name, std::string_view bytes);

  const PngHeader& header() const { return header_; }
  cv::Mat Decode(PngPixels pixels);

 private:
  struct Free {
    void operator()(spng_ctx* context) const;
  };

  // Throws, unless the library's answer is that all is well.
  void Check(int result) const;

  std::string name_;
  std::size_t num_bytes_;
  std::unique_ptr<spng_ctx, Free> context_;
  PngHeader header_;
};

}  // namespace semslam
