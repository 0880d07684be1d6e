// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/recorded_detector.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "semslam/base/error.h"

#include "semantics/detection_json.h"

namespace semslam {
namespace {

// class cx cy w h [score]; nothing unless every field is a number in its range.
std::optional<Detection> ParseLine(const std::string& line, std::size_t num_classes) {
  std::istringstream fields(line);
  int class_id = 0;
  float cx = 0;
  float cy = 0;
  float width = 0;
  float height = 0;
  if (!(fields >> class_id >> cx >> cy >> width >> height)) return std::nullopt;
  float score = 1;
  std::string rest;
  if (fields >> rest) {
    char* end = nullptr;
    score = std::strtof(rest.c_str(), &end);
    if (*end != '\0' || fields >> rest) return std::nullopt;
  }
  const auto in_unit = [](float value) { return value >= 0 && value <= 1; };
  if (class_id < 0 || static_cast<std::size_t>(class_id) >= num_classes) return std::nullopt;
  if (!in_unit(cx) || !in_unit(cy) || !in_unit(width) || !in_unit(height) || !in_unit(score)) {
    return std::nullopt;
  }
  Detection detection;
  detection.class_id = class_id;
  detection.score = score;
  detection.box = {cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2};
  detection.class_scores.assign(num_classes, 0.0F);
  detection.class_scores[static_cast<std::size_t>(class_id)] = score;
  return detection;
}

std::vector<Detection> ReadJsonFile(const std::filesystem::path& path, const ClassTable& classes) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw InputError(path.string() + ": cannot read");
  return ParseJsonDetections(text.str(), path.string(), classes);
}

std::vector<Detection> ReadYoloFile(const std::filesystem::path& path, std::size_t num_classes) {
  std::ifstream file(path);
  if (!file) throw InputError(path.string() + ": cannot open");
  std::vector<Detection> detections;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    auto detection = ParseLine(line, num_classes);
    if (!detection) {
      throw InputError(path.string() + ":" + std::to_string(number) +
                       ": expected 'class cx cy width height [score]', a class below " +
                       std::to_string(num_classes) + " and numbers in [0, 1], found '" + line +
                       "'");
    }
    detections.push_back(std::move(*detection));
  }
  return detections;
}

}  // namespace

RecordedDetector::RecordedDetector(const Options& options, ClassTable classes)
    : options_(options), classes_(std::move(classes)) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(options_.folder, error)) {
    const bool is_json = entry.path().extension() == ".json";
    if (!is_json && entry.path().extension() != ".txt") continue;
    const auto time = ParseTime(entry.path().stem().string());
    if (!time) {
      throw InputError(entry.path().string() +
                       ": expected the image's time in seconds as the file's name");
    }
    images_.push_back({*time,
                       is_json ? ReadJsonFile(entry.path(), classes_)
                               : ReadYoloFile(entry.path(), classes_.size()),
                       !is_json});
  }
  if (error) {
    throw InputError(options_.folder.string() + ": cannot read the folder: " + error.message());
  }
  if (images_.empty()) {
    throw InputError(options_.folder.string() +
                     ": expected detections as TIME.txt or TIME.json, found none");
  }
  std::sort(images_.begin(), images_.end(),
            [](const Image& a, const Image& b) { return a.time < b.time; });
}

std::vector<Detection> RecordedDetector::Detect(const RgbdImage& image) {
  const auto distance = [&](const Image& other) { return std::abs(other.time - image.time); };
  const auto nearest =
      std::min_element(images_.begin(), images_.end(),
                       [&](const Image& a, const Image& b) { return distance(a) < distance(b); });
  if (ToSeconds(distance(*nearest)) > options_.max_time_difference) return {};
  const auto width = static_cast<float>(image.color.cols);
  const auto height = static_cast<float>(image.color.rows);
  std::vector<Detection> detections;
  for (Detection detection : nearest->detections) {
    if (detection.score < options_.score_threshold) continue;
    if (nearest->is_relative) {
      ImageBox& box = detection.box;
      box = {box.min_x * width, box.min_y * height, box.max_x * width, box.max_y * height};
    }
    detections.push_back(std::move(detection));
  }
  return Sanitise(std::move(detections), classes_.size(), image.color.cols, image.color.rows);
}

}  // namespace semslam
