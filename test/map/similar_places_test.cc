// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/map/similar_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/random_frames.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// An image that shows these words, all alike.
BowVector Bow(const std::vector<WordId>& words) {
  BowVector bow;
  for (const WordId word : words)
    bow.entries.push_back({word, 1.0F / static_cast<float>(words.size())});
  return bow;
}

class SimilarPlacesTest : public ::testing::Test {
 protected:
  KeyframeId Add(const std::vector<WordId>& words) {
    const KeyframeId id = map_.AddKeyframe(testing::RandomFrame(20, random_), Rigid3());
    map_.SetWords(id, std::make_shared<const BagOfWords>(BagOfWords{Bow(words), {}}));
    return id;
  }
  void MakeCovisible(KeyframeId a, KeyframeId b) {
    const LandmarkId landmark = map_.AddLandmark({0, 0, 1}, {a, next_feature_});
    map_.AddObservation(landmark, {b, next_feature_++});
  }

  Random random_{1};
  Map map_;
  int next_feature_ = 0;
};

TEST_F(SimilarPlacesTest, NothingIsSimilarToAnEmptyImageOrInAnEmptyMap) {
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({1, 2}), {}), IsEmpty());
  Add({1, 2});
  EXPECT_THAT(FindSimilarPlaces(map_, {}, {}), IsEmpty());
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({3, 4}), {}), IsEmpty());
}

TEST_F(SimilarPlacesTest, TheMostSimilarComesFirstAndThoseWithTooFewCommonWordsNotAtAll) {
  Add({1, 2, 30, 31, 32, 33, 34, 35, 36, 37});  // Shares less than 0.8 of five.
  const KeyframeId good = Add({1, 2, 3, 4, 40, 41, 42, 43});
  const KeyframeId best = Add({1, 2, 3, 4, 5, 50, 51, 52});
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({1, 2, 3, 4, 5}), {}), ElementsAre(best, good));
}

TEST_F(SimilarPlacesTest, AGroupOfNeighboursBeatsASingleKeyframeThatIsAsSimilar) {
  const KeyframeId single = Add({1, 2, 3, 4, 5, 60});
  const KeyframeId a = Add({1, 2, 3, 4, 5, 70});
  const KeyframeId b = Add({1, 2, 3, 4, 5, 71, 72});
  MakeCovisible(a, b);
  const std::vector<KeyframeId> places = FindSimilarPlaces(map_, Bow({1, 2, 3, 4, 5}), {});
  EXPECT_THAT(places, ElementsAre(a)) << "one for the group; the single has half its score";
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({1, 2, 3, 4, 5}), {.min_group_score = 0.4}),
              ElementsAre(a, single));
}

TEST_F(SimilarPlacesTest, ExcludedAndErasedKeyframesAreAsIfTheyWereNotThere) {
  const KeyframeId first = Add({1, 2, 9});
  const KeyframeId a = Add({1, 2, 3});
  const KeyframeId b = Add({1, 2, 3});
  map_.ChooseParent(b);
  const BowVector bow = Bow({1, 2, 3});
  EXPECT_THAT(FindSimilarPlaces(map_, bow, {.excluded = {a}}), ElementsAre(b));
  map_.EraseKeyframe(b);
  EXPECT_THAT(FindSimilarPlaces(map_, bow, {.excluded = {a}}), ElementsAre(first))
      << "the word that only the excluded one shares does not count";
  map_.Clear();
  EXPECT_THAT(FindSimilarPlaces(map_, bow, {}), IsEmpty());
}

TEST_F(SimilarPlacesTest, AKeyframeMustBeSimilarEnoughByItself) {
  const KeyframeId a = Add({1, 2, 3, 4});
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({1, 2}), {.min_score = 0.49F}), ElementsAre(a));
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({1, 2}), {.min_score = 0.51F}), IsEmpty());
}

TEST_F(SimilarPlacesTest, NewWordsReplaceTheOldOnes) {
  const KeyframeId a = Add({1, 2});
  map_.SetWords(a, std::make_shared<const BagOfWords>(BagOfWords{Bow({7, 8}), {}}));
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({1, 2}), {}), IsEmpty());
  EXPECT_THAT(FindSimilarPlaces(map_, Bow({7, 8}), {}), ElementsAre(a));
  map_.CheckConsistency();
}

}  // namespace
}  // namespace semslam
