// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/detection_recorder.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "semslam/base/error.h"
#include "semslam/base/time.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/jpeg.h"

namespace semslam {
namespace {

constexpr const char* kNamesFile = "classes.names";

// Files whose name is a time: nobody's but an earlier recording's.
void RemoveRecording(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path& path = entry.path();
    const bool has_ending = path.extension() == ".txt" || path.extension() == ".jpg";
    if (has_ending && ParseTime(path.stem().string())) old.push_back(path);
  }
  for (const std::filesystem::path& path : old) std::filesystem::remove(path);
}

std::string NamesOf(const ClassTable& classes) {
  std::string names;
  for (int id = 0; id < static_cast<int>(classes.size()); ++id) names += classes.name(id) + '\n';
  return names;
}

std::string LinesOf(const std::vector<Detection>& detections, const cv::Size& size) {
  std::string lines;
  for (const Detection& detection : detections) {
    const ImageBox& box = detection.box;
    char line[128];
    std::snprintf(line, sizeof(line), "%d %.6f %.6f %.6f %.6f %.4f\n", detection.class_id,
                  (box.min_x + box.max_x) / (2.0 * size.width),
                  (box.min_y + box.max_y) / (2.0 * size.height), box.width() / (1.0 * size.width),
                  box.height() / (1.0 * size.height), static_cast<double>(detection.score));
    lines += line;
  }
  return lines;
}

// A name in black or white on a plate of the box's colour.
void DrawPlate(cv::Mat& image, const cv::Point& corner, std::string_view text, const Rgb& color) {
  constexpr double kScale = 0.45;
  constexpr int kMargin = 2;
  int base_line = 0;
  const std::string name(text);
  const cv::Size size = cv::getTextSize(name, cv::FONT_HERSHEY_SIMPLEX, kScale, 1, &base_line);
  const int bottom = std::max(corner.y, size.height + base_line + kMargin);
  cv::rectangle(image, {corner.x, bottom - size.height - base_line - kMargin},
                {corner.x + size.width + 2 * kMargin, bottom},
                {1.0 * color.b, 1.0 * color.g, 1.0 * color.r}, cv::FILLED);
  const bool is_bright = 0.3 * color.r + 0.59 * color.g + 0.11 * color.b > 128;
  cv::putText(image, name, {corner.x + kMargin, bottom - base_line}, cv::FONT_HERSHEY_SIMPLEX,
              kScale, cv::Scalar::all(is_bright ? 0 : 255), 1, cv::LINE_AA);
}

}  // namespace

DetectionRecorder::DetectionRecorder(std::unique_ptr<Detector> detector,
                                     std::filesystem::path folder)
    : detector_(std::move(detector)), folder_(std::move(folder)) {
  try {
    std::filesystem::create_directories(folder_);
    RemoveRecording(folder_);
  } catch (const std::filesystem::filesystem_error& error) {
    throw InputError(folder_.string() +
                     ": cannot be made a folder of detections: " + error.code().message());
  }
  WriteFileAtomically(folder_ / kNamesFile, NamesOf(detector_->classes()));
}

std::vector<Detection> DetectionRecorder::Detect(const RgbdImage& image) {
  std::vector<Detection> detections = detector_->Detect(image);
  const std::string name = FormatTime(image.time);
  WriteFileAtomically(folder_ / (name + ".txt"), LinesOf(detections, image.color.size()));
  const std::string picture =
      EncodeJpeg(DrawDetections(image.color, detections, detector_->classes()));
  if (picture.empty()) throw InputError("cannot encode an image as JPEG");
  WriteFileAtomically(folder_ / (name + ".jpg"), picture);
  return detections;
}

cv::Mat DrawDetections(const cv::Mat& image,
                       const std::vector<Detection>& detections,
                       const ClassTable& classes) {
  cv::Mat drawn;
  if (image.channels() == 1) {
    cv::cvtColor(image, drawn, cv::COLOR_GRAY2BGR);
  } else {
    drawn = image.clone();
  }
  for (const Detection& detection : detections) {
    const Rgb color = classes.color(detection.class_id);
    const cv::Point low(cvRound(detection.box.min_x), cvRound(detection.box.min_y));
    const cv::Point high(cvRound(detection.box.max_x), cvRound(detection.box.max_y));
    cv::rectangle(drawn, low, high, {1.0 * color.b, 1.0 * color.g, 1.0 * color.r}, 2);
    char text[96];
    std::snprintf(text, sizeof(text), "%.80s %.2f", classes.name(detection.class_id).c_str(),
                  static_cast<double>(detection.score));
    DrawPlate(drawn, low, text, color);
  }
  return drawn;
}

}  // namespace semslam
