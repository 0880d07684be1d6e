// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "semslam/features/descriptor.h"
#include "semslam/place/bag_of_words.h"

namespace semslam {

// A hierarchical vocabulary of binary words (Galvez-Lopez and Tardos, "Bags of Binary Words for
// Fast Place Recognition in Image Sequences", 2012): a tree of descriptors whose leaves are the
// words, weighted by their inverse document frequency. An immutable value, cheap to copy (copies
// share the tree), safe to share between threads.
class Vocabulary {
 public:
  // The levels of the stock tree of depth 6 that lie between the direct index and the words.
  static constexpr int kDirectIndexLevelsUp = 4;

  // Nodes lie breadth first: the root is node 0, siblings are side by side, and the children of a
  // node follow those of the node before it. Words are numbered in the same order.
  struct Node {
    std::uint32_t first_child = 0;  // Of a leaf: its word.
    std::uint32_t num_children = 0;
    float weight = 0;  // Of a leaf, >= 0; 0 for a word that tells nothing.
  };

  // Reads a text file (as ORBvoc.txt: "branching depth 0 0", then a line per node: "parent is_leaf
  // b0 ... b31 weight") or a binary one; which of them is told by the content. The binary is used
  // in place and must not be changed meanwhile. Throws InputError if it is not a sound vocabulary.
  static Vocabulary Load(const std::filesystem::path& path);

  // `nodes` and `descriptors` (of the same nodes; the root's is unused) must be laid out as above;
  // else std::logic_error.
  Vocabulary(int branching,
             int depth,
             std::vector<Node> nodes,
             std::vector<Descriptor> descriptors);

  // Throw InputError if the file cannot be written; an existing file is replaced as a whole.
  void SaveBinary(const std::filesystem::path& path) const;
  void SaveText(const std::filesystem::path& path) const;

  int branching() const { return branching_; }  // Most children a node may have.
  int depth() const { return depth_; }          // Most levels below the root.
  std::size_t num_words() const { return num_words_; }
  std::span<const Node> nodes() const { return nodes_; }
  std::span<const Descriptor> descriptors() const { return descriptors_; }

  // The leaf that a descriptor belongs to, by going down to the nearest child (the first of
  // equals).
  VocabularyNodeId FindLeaf(const Descriptor& descriptor) const;

  // Words of an image with tf-idf weights, and its direct index, whose nodes are `levels_up` levels
  // above the deepest words, but on the second level at least (where the stock tree has them), so
  // that a flatter tree still tells branches apart. Words of weight 0 are left out of the vector,
  // not of the index.
  BagOfWords Transform(std::span<const Descriptor> descriptors,
                       int levels_up = kDirectIndexLevelsUp) const;

 private:
  struct Tree;  // Owns what the spans show: memory or a mapped file.

  Vocabulary(int branching, int depth, std::shared_ptr<const Tree> tree);

  int branching_;
  int depth_;
  std::size_t num_words_ = 0;
  std::span<const Node> nodes_;
  std::span<const Descriptor> descriptors_;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace semslam
