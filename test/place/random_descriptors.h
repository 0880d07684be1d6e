// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "semslam/base/random.h"
#include "semslam/features/descriptor.h"

namespace semslam {

inline Descriptor RandomDescriptor(Random& random) {
  Descriptor descriptor;
  for (std::uint64_t& word : descriptor.bits) word = random();
  return descriptor;
}

// The descriptor with `num_flips` random bits flipped (some perhaps twice).
inline Descriptor Disturb(Descriptor descriptor, int num_flips, Random& random) {
  for (int i = 0; i < num_flips; ++i) {
    const std::uint32_t bit = random.Index(kDescriptorBits);
    descriptor.bits[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

// Images of `num_places` places, side by side in the list, each seen `num_views` times: the places
// differ in their features, the views in noise on these.
inline std::vector<std::vector<Descriptor>> RandomPlaces(int num_places,
                                                         int num_views,
                                                         int num_features,
                                                         std::uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<Descriptor>> images;
  for (int place = 0; place < num_places; ++place) {
    std::vector<Descriptor> features(num_features);
    for (Descriptor& d : features) d = RandomDescriptor(random);
    for (int view = 0; view < num_views; ++view) {
      images.push_back(features);
      for (Descriptor& d : images.back()) d = Disturb(d, 12, random);
    }
  }
  return images;
}

}  // namespace semslam
