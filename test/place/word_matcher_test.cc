// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/place/word_matcher.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/random.h"
#include "semslam/place/vocabulary_training.h"

#include "place/random_descriptors.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using ::testing::FieldsAre;
using ::testing::IsEmpty;

Frame MakeFrame(std::vector<Descriptor> descriptors) {
  Frame frame;
  frame.keypoints.resize(descriptors.size());
  frame.descriptors = std::move(descriptors);
  return frame;
}

// All features under one node.
BagOfWords OneBranch(const Frame& frame) {
  BagOfWords words;
  words.direct_index.branches = {{.node = 1, .features = {}}};
  words.direct_index.branches[0].features.resize(frame.keypoints.size());
  std::iota(words.direct_index.branches[0].features.begin(),
            words.direct_index.branches[0].features.end(), 0);
  return words;
}

Descriptor BitsAway(Descriptor descriptor, int num_bits) {
  for (int bit = 0; bit < num_bits; ++bit) {
    descriptor.bits[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

// What the header says, the slow way: for every feature of the first, all of the second under the
// same node. Angles are all equal here, so that no pair turns.
std::map<int, std::pair<int, int>> MatchByBruteForce(const WordMatchImage& first,
                                                     const WordMatchImage& second,
                                                     const WordMatchOptions& options) {
  const auto nodes_of = [](const WordMatchImage& image) {
    std::map<int, VocabularyNodeId> nodes;
    for (const DirectIndex::Branch& branch : image.words.direct_index.branches) {
      for (const int feature : branch.features) nodes[feature] = branch.node;
    }
    return nodes;
  };
  const std::map<int, VocabularyNodeId> first_nodes = nodes_of(first);
  const std::map<int, VocabularyNodeId> second_nodes = nodes_of(second);
  std::map<int, std::pair<int, int>> holder;  // By feature: distance, query.
  for (const auto& [a, node] : first_nodes) {
    if (!first.is_candidate.empty() && first.is_candidate[a] == 0) continue;
    std::vector<std::pair<int, int>> candidates;
    for (const auto& [b, other_node] : second_nodes) {
      if (node != other_node) continue;
      if (!second.is_candidate.empty() && second.is_candidate[b] == 0) continue;
      if (options.accept && !options.accept(a, b)) continue;
      candidates.emplace_back(
          HammingDistance(first.frame.descriptors[a], second.frame.descriptors[b]), b);
    }
    std::sort(candidates.begin(), candidates.end());
    if (candidates.empty() || candidates[0].first > options.max_distance) continue;
    const int rival = candidates.size() > 1 ? candidates[1].first : kDescriptorBits + 1;
    if (static_cast<float>(candidates[0].first) > options.max_ratio * static_cast<float>(rival)) {
      continue;
    }
    const auto [it, is_new] = holder.try_emplace(candidates[0].second);
    if (is_new || candidates[0].first < it->second.first) {
      it->second = {candidates[0].first, a};
    }
  }
  std::map<int, std::pair<int, int>> by_query;
  for (const auto& [feature, held] : holder) by_query[held.second] = {feature, held.first};
  return by_query;
}

TEST(WordMatcherTest, FindsWhatBruteForceFindsUnderEachNode) {
  Random random(21);
  const auto images = RandomPlaces(3, 2, 400, 17);
  const Vocabulary vocabulary =
      TrainVocabulary(images, {.branching = 5, .depth = 3, .max_iterations = 3}, 1);
  std::size_t num_matches = 0;
  for (int round = 0; round < 6; ++round) {
    std::vector<Descriptor> seen_again = images[0];
    for (std::size_t i = 0; i < seen_again.size(); ++i) {
      // Some appear twice, so that ratio and conflicts matter.
      seen_again[i] =
          Disturb(images[0][i % 5 == 0 ? i / 2 : i], static_cast<int>(random.Index(60)), random);
    }
    const Frame first = MakeFrame(images[0]);
    const Frame second = MakeFrame(seen_again);
    const BagOfWords first_words = vocabulary.Transform(first.descriptors);
    const BagOfWords second_words = vocabulary.Transform(second.descriptors);
    std::vector<std::uint8_t> is_candidate(first.keypoints.size());
    for (std::uint8_t& candidate : is_candidate) candidate = random.Index(4) == 0 ? 0 : 1;
    WordMatchOptions options;
    options.max_ratio = round % 2 == 0 ? 0.7F : 1.0F;
    if (round >= 3) options.accept = [](int a, int b) { return (a + b) % 3 != 0; };
    const WordMatchImage a{first, first_words, is_candidate};
    const WordMatchImage b{second, second_words, {}};
    std::map<int, std::pair<int, int>> found;
    int last_query = -1;
    for (const FeatureMatch& match : MatchByWords(a, b, options)) {
      EXPECT_GT(match.query, last_query) << "not sorted";
      last_query = match.query;
      found[match.query] = {match.feature, match.distance};
    }
    ASSERT_EQ(found, MatchByBruteForce(a, b, options)) << "round " << round;
    num_matches += found.size();
  }
  EXPECT_GT(num_matches, 300u) << "the test has too little to compare";
}

class WordMatcherCases : public ::testing::Test {
 protected:
  std::vector<FeatureMatch> Match(const std::vector<Descriptor>& first,
                                  const std::vector<Descriptor>& second,
                                  const WordMatchOptions& options = {}) const {
    const Frame a = MakeFrame(first);
    const Frame b = MakeFrame(second);
    return MatchByWords({a, OneBranch(a), first_candidates_}, {b, OneBranch(b), {}}, options);
  }

  Random random_{4};
  Descriptor base_ = RandomDescriptor(random_);
  std::vector<std::uint8_t> first_candidates_;
};

TEST_F(WordMatcherCases, RefusesAMatchWithANearlyAsGoodSecond) {
  EXPECT_THAT(Match({base_}, {BitsAway(base_, 30), BitsAway(base_, 40)}), IsEmpty());
  EXPECT_THAT(Match({base_}, {BitsAway(base_, 30), BitsAway(base_, 50)}),
              ElementsAre(FieldsAre(0, 0, 30)));
}

TEST_F(WordMatcherCases, TheNearerOfTwoFeaturesGetsTheOneTheyWant) {
  EXPECT_THAT(Match({BitsAway(base_, 10), base_}, {BitsAway(base_, 3)}),
              ElementsAre(FieldsAre(1, 0, 3)));
}

TEST_F(WordMatcherCases, LeavesOutWhatIsNoCandidate) {
  first_candidates_ = {0, 1};
  EXPECT_THAT(Match({base_, BitsAway(base_, 20)}, {base_}), ElementsAre(FieldsAre(1, 0, 20)));
}

TEST_F(WordMatcherCases, ARefusedPairIsNoRival) {
  const WordMatchOptions options{.accept = [](int, int b) { return b != 1; }};
  EXPECT_THAT(Match({base_}, {BitsAway(base_, 30), BitsAway(base_, 31)}, options),
              ElementsAre(FieldsAre(0, 0, 30)));
}

TEST_F(WordMatcherCases, FeaturesUnderDifferentNodesAreNeverPaired) {
  const Frame frame = MakeFrame({base_});
  BagOfWords elsewhere = OneBranch(frame);
  elsewhere.direct_index.branches[0].node = 2;
  EXPECT_THAT(MatchByWords({frame, OneBranch(frame), {}}, {frame, elsewhere, {}}, {}), IsEmpty());
}

TEST_F(WordMatcherCases, ImagesWithoutFeaturesGiveNoMatch) {
  EXPECT_THAT(Match({}, {}), IsEmpty());
  EXPECT_THAT(Match({base_}, {}), IsEmpty());
}

TEST_F(WordMatcherCases, DropsPairsThatTurnOtherwise) {
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < 60; ++i) descriptors.push_back(RandomDescriptor(random_));
  Frame a = MakeFrame(descriptors);
  Frame b = a;
  for (std::size_t i = 0; i < 60; ++i) {
    a.keypoints[i].angle = 0.1F * static_cast<float>(i);
    b.keypoints[i].angle = a.keypoints[i].angle - 1.0F;  // All turn by one radian
  }
  b.keypoints[7].angle += 2.0F;  // but these.
  b.keypoints[8].angle -= 2.0F;
  b.keypoints[9].angle += 1.0F;
  const auto matches = MatchByWords({a, OneBranch(a), {}}, {b, OneBranch(b), {}}, {});
  EXPECT_EQ(matches.size(), 57u);
  for (const FeatureMatch& match : matches) {
    EXPECT_EQ(match.query, match.feature);
    EXPECT_TRUE(match.query < 7 || match.query > 9);
  }
}

}  // namespace
}  // namespace semslam
