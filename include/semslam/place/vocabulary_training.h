// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "semslam/place/vocabulary.h"

namespace semslam {

struct VocabularyTrainingOptions {
  int branching = 10;                // Children of a node, 2 ... 256.
  int depth = 5;                     // Levels below the root, 1 ... 16.
  int min_descriptors_per_node = 4;  // A node with fewer is not divided; >= 2.
  int max_iterations = 11;           // Of k-means per node; >= 1.
  std::uint64_t seed = 1;

  // Throws std::logic_error if a value is out of its range.
  void Validate() const;
};

// Learns a vocabulary from the descriptors of each of many images: k-medians clustering (Hamming
// distance, centres by majority of each bit, seeded by k-means++, Arthur and Vassilvitskii 2007),
// level by level; then weights ln(images / images with the word). The result depends on the input
// and the options only, not on `num_threads` (0: all cores). Needs two images and two different
// descriptors at least; else std::logic_error.
Vocabulary TrainVocabulary(std::span<const std::vector<Descriptor>> images,
                           const VocabularyTrainingOptions& options,
                           int num_threads);

}  // namespace semslam
