// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace semslam {

// A number that cannot be mixed up with the ids of another kind of thing.
template <typename Tag>
struct Id {
  std::uint32_t value = 0;
  friend auto operator<=>(Id, Id) =
      default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14.
};

using KeyframeId = Id<struct KeyframeTag>;  // In the order of insertion, never reused within a map.
using LandmarkId = Id<struct LandmarkTag>;  // Never reused within a map.

}  // namespace semslam

template <typename Tag>
struct std::hash<semslam::Id<Tag>> {
  std::size_t operator()(semslam::Id<Tag> id) const noexcept { return id.value; }
};
