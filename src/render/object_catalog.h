// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include <Eigen/Core>

#include "semslam/render/scene.h"

namespace semslam {

// A ready-made object that scene files can ask for by name.
struct CatalogEntry {
  const char* name;
  int num_sizes;  // How many numbers its size has: 0 (always the same size) to 3.
  // Its size in metres is drawn between these if the file does not say; the file may say up to
  // kSizeFreedom times less or more.
  std::array<float, 3> low;
  std::array<float, 3> high;
  Object (*make)(const Eigen::Vector3f& size, std::uint64_t seed);
};
constexpr float kSizeFreedom = 4;

std::span<const CatalogEntry> ObjectCatalog();

}  // namespace semslam
