// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison.h"

// What the methods made of one cloud; without the points.
struct CloudReport {
  std::string name;
  std::size_t num_points = 0;
  std::size_t num_regions = 0;  // True ones; 0 without labels.
  std::vector<MethodResult> results;
};

// The lines of a table: its head, those of a cloud, and the means over all clouds.
std::string TableHead();
std::string TableRows(const CloudReport& report);
std::string TableMeans(const std::vector<CloudReport>& reports);

std::string ComparisonJson(const std::vector<CloudReport>& reports);

// Writes NAME_METHOD.png and, with labels, NAME_truth.png: the cloud from behind the first camera,
// its colours beside its segments. Throws InputError.
void WritePictures(const std::filesystem::path& folder,
                   const LabelledCloud& cloud,
                   const std::vector<MethodResult>& results);
