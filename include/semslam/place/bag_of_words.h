// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace semslam {

using WordId = std::uint32_t;            // 0 ... number of words - 1.
using VocabularyNodeId = std::uint32_t;  // Node of the vocabulary's tree; 0 is the root.

// How much of an image each visual word makes up: sorted by word, each word once, weights > 0 whose
// sum is 1. Empty if the image shows no word that tells places apart.
struct BowVector {
  struct Entry {
    WordId word = 0;
    float weight = 0;
    friend bool operator==(const Entry&, const Entry&) = default;
  };
  std::vector<Entry> entries;
};

// The features of an image by the branch of the tree their words hang on: features of two images
// can only show the same word if they are in the same branch, so matching need look no further.
struct DirectIndex {
  struct Branch {
    VocabularyNodeId node = 0;
    std::vector<int> features;  // Ascending.
  };
  std::vector<Branch> branches;  // Sorted by node, each node once.
};

// What a vocabulary makes of an image.
struct BagOfWords {
  BowVector vector;
  DirectIndex direct_index;
};

// Similarity of two images, 0 (nothing in common) ... 1 (the same words with the same weights):
// 1 - |a - b|_1 / 2 (Galvez-Lopez and Tardos, "Bags of Binary Words", 2012, equation 2).
float Score(const BowVector& a, const BowVector& b);

}  // namespace semslam
