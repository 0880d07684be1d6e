// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/vocabulary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "semslam/place/vocabulary_training.h"

#include "place/random_descriptors.h"

namespace semslam {
namespace {

class VocabularyTest : public testing::Test {
 protected:
  const std::vector<std::vector<Descriptor>> images_ = RandomPlaces(10, 3, 100, 1);
  const Vocabulary vocabulary_ =
      TrainVocabulary(images_, {.branching = 5, .depth = 4, .min_descriptors_per_node = 4}, 1);
};

TEST_F(VocabularyTest, AddsUpTheWeightsOfEachWordAndScalesThemToOne) {
  std::map<WordId, double> weights;
  double sum = 0;
  for (const Descriptor& d : images_[0]) {
    const Vocabulary::Node& leaf = vocabulary_.nodes()[vocabulary_.FindLeaf(d)];
    weights[leaf.first_child] += leaf.weight;
    sum += leaf.weight;
  }
  std::erase_if(weights, [](const auto& entry) { return entry.second == 0; });
  const BowVector bow = vocabulary_.Transform(images_[0]).vector;
  ASSERT_EQ(bow.entries.size(), weights.size());
  auto expected = weights.begin();
  for (const BowVector::Entry& entry : bow.entries) {
    EXPECT_EQ(entry.word, expected->first);
    EXPECT_NEAR(entry.weight, expected->second / sum, 1e-6);
    ++expected;
  }
}

TEST_F(VocabularyTest, SortsWords) {
  const BowVector bow = vocabulary_.Transform(images_[3]).vector;
  for (std::size_t i = 1; i < bow.entries.size(); ++i) {
    ASSERT_LT(bow.entries[i - 1].word, bow.entries[i].word);
  }
}

TEST_F(VocabularyTest, PutsEveryFeatureIntoTheBranchAboveItsWord) {
  std::vector<VocabularyNodeId> parents(vocabulary_.nodes().size(), 0);
  for (VocabularyNodeId i = 0; i < parents.size(); ++i) {
    const Vocabulary::Node& node = vocabulary_.nodes()[i];
    for (std::uint32_t c = 0; c < node.num_children; ++c) parents[node.first_child + c] = i;
  }
  std::vector<int> times_seen(images_[0].size(), 0);
  for (const auto& branch : vocabulary_.Transform(images_[0]).direct_index.branches) {
    EXPECT_TRUE(std::is_sorted(branch.features.begin(), branch.features.end()));
    for (const int feature : branch.features) {
      ++times_seen[feature];
      VocabularyNodeId node = vocabulary_.FindLeaf(images_[0][feature]);
      while (node != branch.node && node != 0) node = parents[node];
      EXPECT_EQ(node, branch.node) << "feature " << feature;
      EXPECT_EQ(parents[parents[branch.node]], 0u) << "expected a node of the second level";
    }
  }
  EXPECT_EQ(std::count(times_seen.begin(), times_seen.end(), 1),
            static_cast<std::ptrdiff_t>(images_[0].size()));
}

TEST_F(VocabularyTest, HasNoWordsForAnImageWithoutFeatures) {
  const BagOfWords bag = vocabulary_.Transform({});
  EXPECT_TRUE(bag.vector.entries.empty());
  EXPECT_TRUE(bag.direct_index.branches.empty());
  EXPECT_EQ(Score(bag.vector, vocabulary_.Transform(images_[0]).vector), 0.0F);
}

TEST(Score, IsOneMinusHalfTheDistance) {
  const BowVector a{{{0, 0.25F}, {2, 0.25F}, {7, 0.5F}}};
  const BowVector b{{{2, 0.5F}, {5, 0.25F}, {7, 0.25F}}};
  const double distance = 0.25 + 0.25 + 0.25 + 0.25;
  EXPECT_NEAR(Score(a, b), 1 - distance / 2, 1e-6);
  EXPECT_EQ(Score(a, b), Score(b, a));
  EXPECT_NEAR(Score(a, a), 1, 1e-6);
}

TEST(Vocabulary, RefusesNodesOutOfOrder) {
  // A root whose only child claims to be its parent.
  EXPECT_THROW(Vocabulary(2, 1, {{1, 1, 0}, {0, 1, 0}}, std::vector<Descriptor>(2)),
               std::logic_error);
  EXPECT_THROW(Vocabulary(2, 1, {{1, 1, 0}, {1, 0, 1}}, std::vector<Descriptor>(2)),
               std::logic_error);
  EXPECT_NO_THROW(Vocabulary(2, 1, {{1, 1, 0}, {0, 0, 1}}, std::vector<Descriptor>(2)));
}

}  // namespace
}  // namespace semslam
