// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pictures.h"

#include <fstream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace semslam::testing {
namespace {

constexpr std::size_t kNumPatterns = 4;
constexpr std::size_t kNumPatternFrames = 100000;

cv::Mat ReadImage(const std::filesystem::path& path) {
  cv::Mat image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (image.empty()) throw std::runtime_error(path.string() + ": no image");
  return image;
}

}  // namespace

Pictures::Pictures(const Script& script) {
  if (script.clip.empty()) {
    DrawPattern(script);
  } else {
    ReadClip(script);
  }
}

const cv::Mat& Pictures::Color(std::size_t frame) const { return images_.at(frames_[frame].color); }

const cv::Mat& Pictures::Depth(std::size_t frame) const { return images_.at(frames_[frame].depth); }

void Pictures::ReadClip(const Script& script) {
  std::ifstream associations(script.associations);
  Frame frame;
  double depth_time = 0;
  while (associations >> frame.time >> frame.color >> depth_time >> frame.depth) {
    frames_.push_back(frame);
    cv::Mat& color = images_[frame.color];
    if (color.empty()) cv::cvtColor(ReadImage(script.clip / frame.color), color, cv::COLOR_BGR2RGB);
    cv::Mat& depth = images_[frame.depth];
    if (depth.empty())
      ReadImage(script.clip / frame.depth).convertTo(depth, CV_16U, 1000 / script.depth_factor);
  }
  if (frames_.empty()) throw std::runtime_error(script.associations.string() + ": no frames");
  const double first_time = frames_.front().time;
  for (Frame& each : frames_) each.time -= first_time;
}

void Pictures::DrawPattern(const Script& script) {
  for (std::size_t i = 0; i < kNumPatterns; ++i) {
    cv::Mat color(script.height, script.width, CV_8UC3);
    cv::Mat depth(script.height, script.width, CV_16UC1);
    for (int row = 0; row < script.height; ++row) {
      for (int column = 0; column < script.width; ++column) {
        const int value = column + 16 * static_cast<int>(i);
        color.at<cv::Vec3b>(row, column) =
            cv::Vec3b(static_cast<uchar>(value), static_cast<uchar>(row), 7);
        depth.at<ushort>(row, column) = static_cast<ushort>(1000 + value);
      }
    }
    images_["color" + std::to_string(i)] = color;
    images_["depth" + std::to_string(i)] = depth;
  }
  for (std::size_t i = 0; i < kNumPatternFrames; ++i) {
    const std::string pattern = std::to_string(i % kNumPatterns);
    frames_.push_back({static_cast<double>(i) / script.fps, "color" + pattern, "depth" + pattern});
  }
}

}  // namespace semslam::testing
