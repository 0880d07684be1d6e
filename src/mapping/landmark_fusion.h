// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mapping/mapping_context.h"

namespace semslam {

struct FusionOptions {
  std::size_t num_neighbours;         // Covisible keyframes,
  std::size_t num_second_neighbours;  // and of each so many of its own.
};

// Searches the keyframe's landmarks in its neighbours and theirs in it. A hit on a free feature
// becomes an observation; a hit on another landmark merges the two. Returns how many hits were
// committed.
int FuseWithNeighbours(const MappingContext& context,
                       KeyframeId keyframe,
                       const FusionOptions& options);

}  // namespace semslam
