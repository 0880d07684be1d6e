// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/place/vocabulary.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/base/mapped_file.h"

#include "place/vocabulary_file.h"

namespace semslam {

struct Vocabulary::Tree {
  VocabularyArrays arrays;
  std::vector<Node> nodes;
  std::vector<Descriptor> descriptors;
  std::optional<MappedFile> file;
};

namespace {

void ReplaceFile(const std::filesystem::path& path, const std::string& content) {
  // A reader, and a program that is stopped half-way, must never see half a file.
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream stream(part, std::ios::binary | std::ios::trunc);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(part, path, error);
  if (!stream || error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw InputError(path.string() + ": cannot be written" +
                     (error ? ": " + error.message() : std::string()));
  }
}

// Sums of equal words, in the order of the words, scaled to a sum of 1.
BowVector MakeBowVector(std::vector<BowVector::Entry> occurrences) {
  std::sort(occurrences.begin(), occurrences.end(),
            [](const auto& a, const auto& b) { return a.word < b.word; });
  BowVector bow;
  double sum = 0;
  for (const BowVector::Entry& occurrence : occurrences) {
    sum += occurrence.weight;
    if (!bow.entries.empty() && bow.entries.back().word == occurrence.word) {
      bow.entries.back().weight += occurrence.weight;
    } else {
      bow.entries.push_back(occurrence);
    }
  }
  const auto scale = static_cast<float>(1.0 / sum);
  for (BowVector::Entry& entry : bow.entries) entry.weight *= scale;
  return bow;
}

DirectIndex MakeDirectIndex(std::vector<std::pair<VocabularyNodeId, int>> features) {
  std::sort(features.begin(), features.end());
  DirectIndex index;
  for (const auto& [node, feature] : features) {
    if (index.branches.empty() || index.branches.back().node != node) {
      index.branches.push_back({node, {}});
    }
    index.branches.back().features.push_back(feature);
  }
  return index;
}

}  // namespace

std::optional<std::string> FindFault(const VocabularyArrays& tree) {
  if (tree.branching < 2 || tree.branching > kMaxBranching || tree.depth < 1 ||
      tree.depth > kMaxDepth) {
    return "expected 2 ... " + std::to_string(kMaxBranching) + " branches and 1 ... " +
           std::to_string(kMaxDepth) + " levels, found " + std::to_string(tree.branching) +
           " and " + std::to_string(tree.depth);
  }
  if (tree.nodes.size() < 2 || tree.nodes.size() != tree.descriptors.size()) {
    return "expected at least 2 nodes, found " + std::to_string(tree.nodes.size());
  }
  std::uint32_t num_words = 0;
  std::size_t next_child = 1;
  std::size_t level_end = 1;  // First node below the current level.
  int level = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (i == level_end) {
      level_end = next_child;
      ++level;
    }
    const Vocabulary::Node& node = tree.nodes[i];
    const auto fault = [i](const std::string& what) {
      return "node " + std::to_string(i) + ": " + what;
    };
    if (i >= next_child) return fault("is the child of none");
    if (level > tree.depth) return fault("lies below level " + std::to_string(tree.depth));
    if (node.num_children > static_cast<std::uint32_t>(tree.branching)) {
      return fault("expected at most " + std::to_string(tree.branching) + " children, found " +
                   std::to_string(node.num_children));
    }
    const bool is_leaf = node.num_children == 0;
    if (node.first_child != (is_leaf ? num_words : next_child)) return fault("is out of order");
    if (!(node.weight >= 0) || !std::isfinite(node.weight)) return fault("weight is not >= 0");
    num_words += is_leaf ? 1 : 0;
    next_child += node.num_children;
  }
  if (next_child != tree.nodes.size()) return "cut short: nodes are missing";
  return std::nullopt;
}

Vocabulary::Vocabulary(int branching, int depth, std::shared_ptr<const Tree> tree)
    : branching_(branching),
      depth_(depth),
      nodes_(tree->arrays.nodes),
      descriptors_(tree->arrays.descriptors),
      tree_(std::move(tree)) {
  num_words_ = static_cast<std::size_t>(std::count_if(
      nodes_.begin(), nodes_.end(), [](const Node& node) { return node.num_children == 0; }));
}

Vocabulary::Vocabulary(int branching,
                       int depth,
                       std::vector<Node> nodes,
                       std::vector<Descriptor> descriptors)
    : Vocabulary(branching, depth, [&] {
        auto tree = std::make_shared<Tree>();
        tree->nodes = std::move(nodes);
        tree->descriptors = std::move(descriptors);
        tree->arrays = {branching, depth, tree->nodes, tree->descriptors};
        const std::optional<std::string> fault = FindFault(tree->arrays);
        SEMSLAM_CHECK(!fault) << *fault;
        return tree;
      }()) {}

Vocabulary Vocabulary::Load(const std::filesystem::path& path) {
  auto tree = std::make_shared<Tree>();
  tree->file.emplace(path);
  const std::span<const std::byte> bytes = tree->file->bytes();
  if (bytes.empty()) throw InputError(path.string() + ": expected a vocabulary, found no content");
  if (IsBinaryVocabulary(bytes)) {
    tree->arrays = ParseBinary(bytes, path);
  } else if (const auto first = static_cast<char>(bytes[0]); first >= '0' && first <= '9') {
    ParsedVocabulary parsed = ParseText(bytes, path);
    tree->nodes = std::move(parsed.nodes);
    tree->descriptors = std::move(parsed.descriptors);
    tree->arrays = {parsed.branching, parsed.depth, tree->nodes, tree->descriptors};
    tree->file.reset();
  } else {
    throw InputError(path.string() +
                     ": expected a binary vocabulary of semslam or a text one (\"10 6 0 0\"), "
                     "found neither");
  }
  if (const auto fault = FindFault(tree->arrays)) throw InputError(path.string() + ": " + *fault);
  return {tree->arrays.branching, tree->arrays.depth, tree};
}

void Vocabulary::SaveBinary(const std::filesystem::path& path) const {
  ReplaceFile(path, FormatBinary(tree_->arrays));
}

void Vocabulary::SaveText(const std::filesystem::path& path) const {
  ReplaceFile(path, FormatText(tree_->arrays));
}

namespace {

VocabularyNodeId NearestChild(std::span<const Descriptor> descriptors,
                              const Vocabulary::Node& node,
                              const Descriptor& descriptor) {
  VocabularyNodeId nearest = node.first_child;
  int nearest_distance = kDescriptorBits + 1;
  for (VocabularyNodeId c = node.first_child; c < node.first_child + node.num_children; ++c) {
    const int distance = HammingDistance(descriptor, descriptors[c]);
    if (distance < nearest_distance) {
      nearest = c;
      nearest_distance = distance;
    }
  }
  return nearest;
}

}  // namespace

VocabularyNodeId Vocabulary::FindLeaf(const Descriptor& descriptor) const {
  VocabularyNodeId node = 0;
  while (nodes_[node].num_children > 0) {
    node = NearestChild(descriptors_, nodes_[node], descriptor);
  }
  return node;
}

BagOfWords Vocabulary::Transform(std::span<const Descriptor> descriptors, int levels_up) const {
  constexpr int kHighestIndexLevel = 2;
  const int index_level =
      std::clamp(depth_ - levels_up, std::min(kHighestIndexLevel, depth_), depth_);
  std::vector<BowVector::Entry> words;
  std::vector<std::pair<VocabularyNodeId, int>> branches;
  words.reserve(descriptors.size());
  branches.reserve(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    VocabularyNodeId node = 0;
    VocabularyNodeId branch = 0;
    for (int level = 1; nodes_[node].num_children > 0; ++level) {
      node = NearestChild(descriptors_, nodes_[node], descriptors[i]);
      if (level <= index_level) branch = node;
    }
    branches.emplace_back(branch, static_cast<int>(i));
    const Node& leaf = nodes_[node];
    if (leaf.weight > 0) words.push_back({leaf.first_child, leaf.weight});
  }
  return {MakeBowVector(std::move(words)), MakeDirectIndex(std::move(branches))};
}

}  // namespace semslam
