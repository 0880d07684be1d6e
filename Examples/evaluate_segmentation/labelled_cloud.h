// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/rgb.h"

// A cloud to segment, with the region that each point truly belongs to, if the file says so.
struct LabelledCloud {
  std::string name;
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;  // Empty if the file has none.
  std::vector<semslam::Rgb> colors;      // Empty if the file has none.
  std::vector<std::uint32_t> truth;      // 0: unknown. Empty if the file has no labels.
};

// The PCD files among the given ones and in the given folders, by name. Throws InputError if there
// is nothing, or a folder without any.
std::vector<std::filesystem::path> FindClouds(const std::vector<std::string>& paths);

// Reads a PCD file; points at the origin stand for missing depth and are left out. With `parts`
// labels 1-9 are parts of one table, 20-29 of a first thing, 30-39 of a second, and so on, as the
// Object Segmentation Database has them; else every label is a region. Throws InputError.
LabelledCloud ReadLabelledCloud(const std::filesystem::path& path, bool parts);
