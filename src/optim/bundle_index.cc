// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "optim/bundle_index.h"

#include <numeric>

namespace semslam::internal {
namespace {

// Groups items by key: `first` has the start of each group (and the end of the last), `items` the
// items of group after group, each in the order given.
struct Groups {
  std::vector<int> first;
  std::vector<int> items;
};

template <typename Key>
Groups GroupByKey(const std::vector<int>& items, int num_keys, const Key& key) {
  Groups groups;
  groups.first.assign(num_keys + 1, 0);
  for (const int item : items) ++groups.first[key(item) + 1];
  std::partial_sum(groups.first.begin(), groups.first.end(), groups.first.begin());
  std::vector<int> next(groups.first.begin(), groups.first.end() - 1);
  groups.items.resize(items.size());
  for (const int item : items) groups.items[next[key(item)]++] = item;
  return groups;
}

}  // namespace

BundleIndex MakeBundleIndex(const BundleProblem& problem,
                            const std::vector<std::uint8_t>& is_active,
                            const Chi2Limits& limits) {
  BundleIndex index;
  std::vector<int> free_of_pose(problem.T_world_camera.size(), BundleIndex::kFixed);
  for (std::size_t pose = 0; pose < free_of_pose.size(); ++pose) {
    if (problem.pose_is_fixed[pose]) continue;
    free_of_pose[pose] = index.num_free_poses();
    index.pose_of_free_pose.push_back(static_cast<int>(pose));
  }

  std::vector<int> active;
  for (std::size_t i = 0; i < is_active.size(); ++i) {
    if (is_active[i]) active.push_back(static_cast<int>(i));
  }
  const auto& observations = problem.observations;
  // Sorting by pose and then, stably, by point leaves each point's observations ordered by pose.
  const Groups by_pose = GroupByKey(active, index.num_free_poses() + 1,
                                    [&](int i) { return free_of_pose[observations[i].pose] + 1; });
  Groups by_point = GroupByKey(by_pose.items, static_cast<int>(problem.p_world.size()),
                               [&](int i) { return observations[i].point; });

  index.slots.reserve(active.size());
  index.first_slot_of_point = std::move(by_point.first);
  index.first_free_slot_of_point.assign(index.first_slot_of_point.begin(),
                                        index.first_slot_of_point.end() - 1);
  std::vector<int> free_slots;
  for (const int i : by_point.items) {
    const auto& [pose, point, image] = observations[i];
    if (free_of_pose[pose] == BundleIndex::kFixed) {
      ++index.first_free_slot_of_point[point];
    } else {
      free_slots.push_back(static_cast<int>(index.slots.size()));
    }
    index.slots.push_back({pose, free_of_pose[pose], point, limits.Of(image), image});
  }
  Groups by_free_pose = GroupByKey(free_slots, index.num_free_poses(),
                                   [&](int slot) { return index.slots[slot].free_pose; });
  index.first_of_free_pose = std::move(by_free_pose.first);
  index.slots_of_free_pose = std::move(by_free_pose.items);
  return index;
}

}  // namespace semslam::internal
