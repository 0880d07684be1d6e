// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/test_images.h"

#include <algorithm>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "semslam/base/random.h"

#include "support/clips.h"

namespace semslam {

cv::Mat MakeTexture(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat sum = cv::Mat::zeros(height, width, CV_32F);
  for (const int grain : {3, 7, 17, 41}) {
    cv::Mat noise(height / grain + 2, width / grain + 2, CV_32F);
    for (float& value : cv::Mat_<float>(noise)) value = static_cast<float>(random.Uniform(0, 64));
    cv::Mat coarse;
    cv::resize(noise, coarse, sum.size(), 0, 0, cv::INTER_NEAREST);
    sum += coarse;
  }
  cv::Mat image;
  sum.convertTo(image, CV_8U);
  return image;
}

std::vector<cv::Mat> LoadClipImages(const std::string& clip, int stride) {
  namespace fs = std::filesystem;
  const fs::path folder = testing::FindClip(clip);
  std::vector<cv::Mat> images;
  if (folder.empty()) return images;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "rgb")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (std::size_t i = 0; i < files.size(); i += static_cast<std::size_t>(stride)) {
    images.push_back(cv::imread(files[i].string(), cv::IMREAD_GRAYSCALE));
  }
  return images;
}

}  // namespace semslam
