// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/keyframe_index.h"

#include <gtest/gtest.h>

#include "semslam/place/vocabulary_training.h"

#include "place/random_descriptors.h"

namespace semslam {
namespace {

class KeyframeIndexTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto images = RandomPlaces(6, 3, 80, 1);
    const Vocabulary vocabulary = TrainVocabulary(images, {.branching = 6, .depth = 3}, 1);
    for (const auto& image : images) bows_.push_back(vocabulary.Transform(image).vector);
    for (std::uint32_t i = 0; i < bows_.size(); ++i) index_.Add(KeyframeId{i}, bows_[i]);
  }

  static int CountShared(const BowVector& a, const BowVector& b) {
    int count = 0;
    for (const auto& x : a.entries) {
      for (const auto& y : b.entries) count += x.word == y.word;
    }
    return count;
  }

  std::vector<BowVector> bows_;
  KeyframeIndex index_;
};

TEST_F(KeyframeIndexTest, FindsWhatComparingWithAllFinds) {
  for (const BowVector& query : bows_) {
    std::size_t num_expected = 0;
    for (const BowVector& bow : bows_) num_expected += CountShared(query, bow) > 0;
    const std::vector<KeyframeIndex::Match> matches = index_.FindSimilar(query);
    ASSERT_EQ(matches.size(), num_expected);
    for (const KeyframeIndex::Match& match : matches) {
      const BowVector& bow = bows_[match.keyframe.value];
      EXPECT_EQ(match.num_shared_words, CountShared(query, bow));
      EXPECT_EQ(match.score, Score(query, bow));
    }
  }
}

TEST_F(KeyframeIndexTest, PutsViewsOfThePlaceFirst) {
  for (std::uint32_t i = 0; i < bows_.size(); ++i) {
    const std::vector<KeyframeIndex::Match> matches = index_.FindSimilar(bows_[i]);
    ASSERT_GE(matches.size(), 3u);
    EXPECT_EQ(matches[0].keyframe, KeyframeId{i});
    EXPECT_EQ(matches[1].keyframe.value / 3, i / 3);
    EXPECT_EQ(matches[2].keyframe.value / 3, i / 3);
  }
}

TEST_F(KeyframeIndexTest, ForgetsErasedKeyframes) {
  index_.Erase(KeyframeId{4}, bows_[4]);
  EXPECT_EQ(index_.num_keyframes(), bows_.size() - 1);
  for (const KeyframeIndex::Match& match : index_.FindSimilar(bows_[4])) {
    EXPECT_NE(match.keyframe, KeyframeId{4});
  }
  EXPECT_THROW(index_.Erase(KeyframeId{4}, bows_[4]), std::logic_error);
}

}  // namespace
}  // namespace semslam
