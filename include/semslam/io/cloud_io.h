// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "semslam/dense/rgb.h"

namespace semslam {

// The columns of a point cloud file, wherever they are kept. Each is empty, and then not written,
// or as long as the positions.
struct CloudView {
  std::span<const Eigen::Vector3f> positions = {};  // Metres, world frame.
  std::span<const Rgb> colors = {};
  std::span<const Eigen::Vector3f> normals = {};  // Unit length.
  std::span<const std::uint32_t> labels = {};     // Class id, or whatever the file is about.
  std::span<const std::uint32_t> segments = {};   // Segment id.
  std::span<const std::uint32_t> objects = {};    // Object id.
  std::span<const float> confidences = {};        // Of the label, in [0, 1].
  std::span<const float> entropies = {};          // In [0, 1]: 0 sure, 1 nothing is known.
};

// The columns of a file, each empty if the file has none of it.
struct CloudColumns {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Rgb> colors;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> segments;
  std::vector<std::uint32_t> objects;
  std::vector<float> confidences;
  std::vector<float> entropies;

  CloudView View() const {
    return {.positions = positions,
            .colors = colors,
            .normals = normals,
            .labels = labels,
            .segments = segments,
            .objects = objects,
            .confidences = confidences,
            .entropies = entropies};
  }
};

// Writes a binary-compressed PCD file with the fields x y z, rgba (alpha 255), normal_x normal_y
// normal_z, label, segment, object, confidence, entropy, as far as given: so XYZRGBA, XYZL and
// XYZRGBL for PCL, CloudCompare, MeshLab and Open3D. It holds at most 3.7 GB of values.
// Throws InputError.
void WritePcd(const std::filesystem::path& path, const CloudView& cloud);

// Writes a binary PLY file with the properties x y z, nx ny nz, red green blue, label, segment,
// object, confidence, entropy, as far as given. Throws InputError.
void WritePly(const std::filesystem::path& path, const CloudView& cloud);

// Reads the fields x y z, rgb or rgba, normal_x normal_y normal_z and label of a PCD file (ascii,
// binary or compressed); other fields are passed over, and points without a finite position left
// out. Throws InputError that says what is wrong with the file.
CloudColumns ReadPcd(const std::filesystem::path& path);

// Reads the properties of WritePly from a PLY file (ascii or binary, of either byte order) whose
// vertices come first, of whatever number types; others are passed over, and vertices without a
// finite position left out. Throws InputError that says what is wrong with the file.
CloudColumns ReadPly(const std::filesystem::path& path);

}  // namespace semslam
