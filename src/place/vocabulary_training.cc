// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/vocabulary_training.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "semslam/base/check.h"
#include "semslam/base/parallel.h"
#include "semslam/base/random.h"

#include "place/binary_kmeans.h"

namespace semslam {
namespace {

using Node = Vocabulary::Node;

// A node whose children are still to be found, with the descriptors that belong to it.
struct OpenNode {
  VocabularyNodeId id;
  std::span<Descriptor> members;
};

// A tree that grows by whole levels.
struct Tree {
  std::vector<Node> nodes{Node{}};
  std::vector<Descriptor> descriptors{Descriptor{}};
};

// Adds the clusters of each open node as its children; gives the nodes to be divided next.
std::vector<OpenNode> GrowLevel(const std::vector<OpenNode>& open,
                                const VocabularyTrainingOptions& options,
                                int num_threads,
                                Tree& tree) {
  std::vector<std::vector<Cluster>> clusters(open.size());
  ParallelFor(open.size(), 1, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Random random(options.seed * 0x9e3779b97f4a7c15ULL + open[i].id);
      clusters[i] =
          ClusterBinary(open[i].members, options.branching, options.max_iterations, random);
    }
  });
  std::vector<OpenNode> next;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (clusters[i].size() < 2) continue;  // All the same: stays a leaf.
    tree.nodes[open[i].id].first_child = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes[open[i].id].num_children = static_cast<std::uint32_t>(clusters[i].size());
    for (const Cluster& cluster : clusters[i]) {
      const auto id = static_cast<VocabularyNodeId>(tree.nodes.size());
      tree.nodes.emplace_back();
      tree.descriptors.push_back(cluster.center);
      if (cluster.members.size() >= static_cast<std::size_t>(options.min_descriptors_per_node)) {
        next.push_back({id, cluster.members});
      }
    }
  }
  return next;
}

// Words in the order of the nodes.
void NumberWords(Tree& tree) {
  std::uint32_t num_words = 0;
  for (Node& node : tree.nodes) {
    if (node.num_children == 0) node.first_child = num_words++;
  }
}

// ln(images / images that show the word); a word that none shows counts as shown by one.
void SetWeights(std::span<const std::vector<Descriptor>> images,
                const VocabularyTrainingOptions& options,
                int num_threads,
                Tree& tree) {
  const Vocabulary unweighted(options.branching, options.depth, tree.nodes, tree.descriptors);
  std::vector<std::vector<VocabularyNodeId>> leaves(images.size());
  ParallelFor(images.size(), 1, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      for (const Descriptor& d : images[i]) leaves[i].push_back(unweighted.FindLeaf(d));
      std::sort(leaves[i].begin(), leaves[i].end());
      leaves[i].erase(std::unique(leaves[i].begin(), leaves[i].end()), leaves[i].end());
    }
  });
  std::vector<int> num_images(tree.nodes.size(), 0);
  for (const auto& shown : leaves) {
    for (const VocabularyNodeId leaf : shown) ++num_images[leaf];
  }
  const auto total = static_cast<double>(images.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (tree.nodes[i].num_children > 0) continue;
    tree.nodes[i].weight = static_cast<float>(std::log(total / std::max(num_images[i], 1)));
  }
}

}  // namespace

void VocabularyTrainingOptions::Validate() const {
  SEMSLAM_CHECK(branching >= 2 && branching <= 256) << "branching = " << branching;
  SEMSLAM_CHECK(depth >= 1 && depth <= 16) << "depth = " << depth;
  SEMSLAM_CHECK(min_descriptors_per_node >= 2)
      << "min_descriptors_per_node = " << min_descriptors_per_node;
  SEMSLAM_CHECK(max_iterations >= 1) << "max_iterations = " << max_iterations;
}

Vocabulary TrainVocabulary(std::span<const std::vector<Descriptor>> images,
                           const VocabularyTrainingOptions& options,
                           int num_threads) {
  options.Validate();
  SEMSLAM_CHECK(images.size() >= 2) << images.size() << " images";
  std::vector<Descriptor> all;
  for (const auto& image : images) all.insert(all.end(), image.begin(), image.end());

  Tree tree;
  std::vector<OpenNode> open{{0, all}};
  for (int level = 0; level < options.depth && !open.empty(); ++level) {
    open = GrowLevel(open, options, num_threads, tree);
  }
  SEMSLAM_CHECK(tree.nodes.size() > 1) << "expected different descriptors among " << all.size();
  NumberWords(tree);
  SetWeights(images, options, num_threads, tree);
  return {options.branching, options.depth, std::move(tree.nodes), std::move(tree.descriptors)};
}

}  // namespace semslam
