// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// The network in config/detector, run by OpenCV, against what PyTorch said when it was trained.
// scripts/train_detector/export_reference.py wrote the pictures and the boxes.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "semslam/semantics/network_detector.h"

namespace semslam {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNumClasses = 5;
constexpr float kLowestScore =
    0.12F;  // The files begin at 0.1; below this a box may be in one only.
constexpr float kMaxDifferencePx = 0.5F;
constexpr float kMaxScoreDifference = 0.01F;  // JPEG decoders differ by a grey level or two.

struct Reference {
  ImageBox box;
  std::array<float, kNumClasses> scores{};
  float best() const { return *std::max_element(scores.begin(), scores.end()); }
};

std::vector<Reference> ReadReferences(const fs::path& path) {
  std::ifstream file(path);
  std::vector<Reference> references;
  Reference row;
  while (file >> row.box.min_x >> row.box.min_y >> row.box.max_x >> row.box.max_y) {
    for (float& score : row.scores) file >> score;
    references.push_back(row);
  }
  return references;
}

bool IsSame(const Reference& reference, const Detection& detection, int width, int height) {
  const ImageBox box = reference.box.ClippedTo(width, height);
  const bool is_same_box = std::abs(box.min_x - detection.box.min_x) < kMaxDifferencePx &&
                           std::abs(box.min_y - detection.box.min_y) < kMaxDifferencePx &&
                           std::abs(box.max_x - detection.box.max_x) < kMaxDifferencePx &&
                           std::abs(box.max_y - detection.box.max_y) < kMaxDifferencePx;
  for (std::size_t i = 0; is_same_box && i < kNumClasses; ++i) {
    if (std::abs(reference.scores[i] - detection.class_scores[i]) > kMaxScoreDifference)
      return false;
  }
  return is_same_box;
}

class ShippedDetector : public ::testing::TestWithParam<std::string> {
 protected:
  static NetworkDetector Make() {
    const fs::path folder = fs::path(SEMSLAM_SOURCE_DIR) / "config" / "detector";
    NetworkDetector::Options options;
    options.config = folder / "desk.cfg";
    options.weights = folder / "desk.weights";
    options.score_threshold = 0.1F;
    options.nms_threshold = 1;  // Every box.
    options.min_class_score = 0;
    return {options, ClassTable::FromFile(folder / "desk.names")};
  }

  const fs::path picture_ =
      fs::path(SEMSLAM_SOURCE_DIR) / "test" / "semantics" / "shipped_detector" / GetParam();
  const std::vector<Reference> references_ =
      ReadReferences(fs::path(picture_).replace_extension(".txt"));
};

TEST_P(ShippedDetector, FindsWhatItsTrainerFound) {
  const cv::Mat color = cv::imread(picture_.string());
  const std::vector<Detection> found = Make().Detect({0, color, {}});
  ASSERT_GE(references_.size(), 5U);
  for (const Reference& reference : references_) {
    if (reference.best() < kLowestScore) continue;
    EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                            [&](const Detection& detection) {
                              return IsSame(reference, detection, color.cols, color.rows);
                            }))
        << "score " << reference.best() << " at " << reference.box.min_x << ", "
        << reference.box.min_y;
  }
  for (const Detection& detection : found) {
    if (detection.score < kLowestScore) continue;
    EXPECT_TRUE(std::any_of(references_.begin(), references_.end(),
                            [&](const Reference& reference) {
                              return IsSame(reference, detection, color.cols, color.rows);
                            }))
        << "score " << detection.score << " at " << detection.box.min_x << ", "
        << detection.box.min_y;
  }
}

INSTANTIATE_TEST_SUITE_P(Pictures,
                         ShippedDetector,
                         ::testing::Values("500_02.jpg", "501_04.jpg", "503_01.jpg"),
                         [](const auto& picture) {
                           const std::string& name = picture.param;
                           return "Of" + name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace semslam
