// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "semslam/features/orb_extractor.h"
#include "semslam/place/vocabulary.h"

#include "features/test_images.h"

namespace semslam {
namespace {

std::filesystem::path DefaultVocabulary() {
  return std::filesystem::path(SEMSLAM_SOURCE_DIR) / "Vocabulary" / "orb.voc";
}

TEST(DefaultVocabulary, HasAHundredThousandWordsAndKeepsTheRepositorySmall) {
  EXPECT_GE(Vocabulary::Load(DefaultVocabulary()).num_words(), 100'000u);
  EXPECT_LE(std::filesystem::file_size(DefaultVocabulary()), 6'000'000u);
}

TEST(DefaultVocabulary, TellsTexturesItWasNotTrainedOnApart) {
  // Each texture is seen twice, the second time smaller and turned; no texture was in the training.
  const Vocabulary vocabulary = Vocabulary::Load(DefaultVocabulary());
  const OrbExtractor extractor({});
  std::vector<BowVector> first;
  std::vector<BowVector> second;
  for (std::uint64_t place = 0; place < 5; ++place) {
    const cv::Mat image = MakeTexture(640, 480, 100 + place);
    cv::Mat moved;
    cv::warpAffine(image, moved, cv::getRotationMatrix2D({320, 240}, 10, 0.95), image.size());
    first.push_back(vocabulary.Transform(extractor.Extract(image).descriptors).vector);
    second.push_back(vocabulary.Transform(extractor.Extract(moved).descriptors).vector);
  }
  for (std::size_t a = 0; a < first.size(); ++a) {
    for (std::size_t b = 0; b < second.size(); ++b) {
      if (a == b) continue;
      EXPECT_GT(Score(first[a], second[a]), Score(first[a], second[b])) << a << " and " << b;
    }
  }
}

TEST(DefaultVocabulary, ScoresNeighboursInTimeAboveOtherPlacesOnRealClips) {
  const std::vector<cv::Mat> desk = LoadClipImages("fr1_desk_80", 2);
  const std::vector<cv::Mat> xyz = LoadClipImages("fr1_xyz_160", 10);
  if (desk.empty() || xyz.empty()) GTEST_SKIP() << "the real clips are not here: see SEMSLAM_CLIPS";
  const Vocabulary vocabulary = Vocabulary::Load(DefaultVocabulary());
  const OrbExtractor extractor({});
  const auto words = [&](const cv::Mat& image) {
    return vocabulary.Transform(extractor.Extract(image).descriptors).vector;
  };
  // Frame 0 of the fast sweep, its neighbour, and the end of the sweep, which shows another desk.
  const BowVector start = words(desk.front());
  const float neighbour = Score(start, words(desk[1]));
  EXPECT_GT(neighbour, 1.5F * Score(start, words(desk.back())));
  const BowVector other_start = words(xyz.front());
  EXPECT_GT(Score(other_start, words(xyz[1])), 1.5F * Score(other_start, words(desk.back())));
}

}  // namespace
}  // namespace semslam
