// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "semslam/geometry/oriented_box.h"

namespace semslam {

// One thing of a rendered clip, as render_clip's instances.json names it.
struct InstanceRecord {
  std::uint32_t id = 0;  // Its value in the label images, from 1.
  std::string class_name;
  OrientedBox box;  // World; encloses all of it, along its own axes.
};

// The instances in ascending order of their ids. Throws InputError that names file and field; ids
// must be above 0 and unique.
std::vector<InstanceRecord> ReadInstances(const std::filesystem::path& path);

}  // namespace semslam
