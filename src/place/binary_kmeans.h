// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "semslam/base/random.h"
#include "semslam/features/descriptor.h"

namespace semslam {

// Descriptors that are nearer to this centre than to the others of the same clustering.
struct Cluster {
  Descriptor center;
  std::span<Descriptor> members;  // Never empty.
};

// Divides descriptors into up to `num_clusters` clusters (fewer if there are fewer different ones):
// Lloyd's iteration with Hamming distance and centres by majority of each bit, seeded by k-means++.
// Sorts `descriptors` by cluster; the members are parts of it, in their former order.
std::vector<Cluster> ClusterBinary(std::span<Descriptor> descriptors,
                                   int num_clusters,
                                   int max_iterations,
                                   Random& random);

}  // namespace semslam
