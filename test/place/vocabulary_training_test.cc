// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/vocabulary_training.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "place/binary_kmeans.h"
#include "place/random_descriptors.h"

namespace semslam {
namespace {

TEST(ClusterBinary, FindsClustersThatAreFarApart) {
  Random random(1);
  std::vector<Descriptor> centers(6);
  for (Descriptor& center : centers) center = RandomDescriptor(random);
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < 600; ++i) descriptors.push_back(Disturb(centers[i % 6], 20, random));
  const std::vector<Cluster> clusters = ClusterBinary(descriptors, 6, 20, random);
  ASSERT_EQ(clusters.size(), 6u);
  for (const Cluster& cluster : clusters) {
    // The majority of 100 noisy copies is the original.
    EXPECT_TRUE(std::find(centers.begin(), centers.end(), cluster.center) != centers.end());
    EXPECT_EQ(cluster.members.size(), 100u);
  }
}

TEST(ClusterBinary, GivesEachMemberItsNearestCenter) {
  Random random(2);
  std::vector<Descriptor> descriptors(700);
  for (Descriptor& d : descriptors) d = RandomDescriptor(random);
  const std::vector<Cluster> clusters = ClusterBinary(descriptors, 9, 5, random);
  std::size_t num_members = 0;
  for (const Cluster& cluster : clusters) {
    for (const Descriptor& member : cluster.members) {
      for (const Cluster& other : clusters) {
        ASSERT_LE(HammingDistance(member, cluster.center), HammingDistance(member, other.center));
      }
    }
    num_members += cluster.members.size();
  }
  EXPECT_EQ(num_members, descriptors.size());
}

TEST(ClusterBinary, MakesOneClusterOfEqualDescriptors) {
  Random random(3);
  std::vector<Descriptor> descriptors(50);
  EXPECT_EQ(ClusterBinary(descriptors, 10, 5, random).size(), 1u);
}

TEST(TrainVocabulary, ScoresViewsOfThePlaceAboveOtherPlaces) {
  const auto images = RandomPlaces(12, 3, 80, 4);
  const Vocabulary vocabulary = TrainVocabulary(images, {.branching = 8, .depth = 3}, 1);
  std::vector<BowVector> bows;
  for (const auto& image : images) bows.push_back(vocabulary.Transform(image).vector);
  for (std::size_t a = 0; a < bows.size(); ++a) {
    for (std::size_t b = 0; b < bows.size(); ++b) {
      if (a / 3 == b / 3) {
        EXPECT_GT(Score(bows[a], bows[b]), 0.3F) << a << " and " << b << ", the same place";
      } else {
        EXPECT_LT(Score(bows[a], bows[b]), 0.3F) << a << " and " << b << ", different places";
      }
    }
  }
}

TEST(TrainVocabulary, DependsOnSeedButNotOnThreads) {
  const auto images = RandomPlaces(8, 2, 100, 5);
  const auto train = [&](std::uint64_t seed, int num_threads) {
    const Vocabulary v =
        TrainVocabulary(images, {.branching = 4, .depth = 4, .seed = seed}, num_threads);
    return std::vector<Descriptor>(v.descriptors().begin(), v.descriptors().end());
  };
  EXPECT_EQ(train(1, 1), train(1, 2));
  EXPECT_NE(train(1, 1), train(2, 1));
}

TEST(TrainVocabulary, WeighsWordsByTheImagesThatShowThem) {
  const auto images = RandomPlaces(5, 2, 60, 6);
  const Vocabulary vocabulary = TrainVocabulary(images, {.branching = 6, .depth = 2}, 1);
  std::vector<std::set<std::size_t>> shown_by(vocabulary.nodes().size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (const Descriptor& d : images[i]) shown_by[vocabulary.FindLeaf(d)].insert(i);
  }
  for (std::size_t i = 0; i < shown_by.size(); ++i) {
    const Vocabulary::Node& node = vocabulary.nodes()[i];
    if (node.num_children > 0) continue;
    const double num_images = std::max<double>(1, static_cast<double>(shown_by[i].size()));
    EXPECT_NEAR(node.weight, std::log(static_cast<double>(images.size()) / num_images), 1e-5);
  }
}

TEST(TrainVocabulary, RefusesOneImageAndEqualDescriptors) {
  EXPECT_THROW(TrainVocabulary(RandomPlaces(1, 1, 50, 7), {}, 1), std::logic_error);
  const std::vector<std::vector<Descriptor>> equal(3, std::vector<Descriptor>(20));
  EXPECT_THROW(TrainVocabulary(equal, {}, 1), std::logic_error);
}

}  // namespace
}  // namespace semslam
