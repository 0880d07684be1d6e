// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "semslam/geometry/plane.h"
#include "semslam/segmentation/options.h"

#include "segmentation/patches.h"

namespace semslam {

constexpr std::uint32_t kNoPiece = std::numeric_limits<std::uint32_t>::max();

// A connected piece of one plane, of structural size: floor, wall, table.
struct SurfacePiece {
  std::uint32_t plane_label = 0;
  Plane plane;                         // Towards the viewer.
  std::vector<std::uint32_t> patches;  // Ascending.
};

struct SurfacePieces {
  std::vector<SurfacePiece> pieces;           // By their first patch.
  std::vector<std::uint32_t> piece_of_patch;  // kNoPiece for the others.
};

SurfacePieces FindStructuralPieces(const PatchGraph& graph,
                                   const std::vector<Plane>& planes,
                                   const std::vector<std::uint32_t>& plane_labels,
                                   double min_area);

// Where a piece of surface lies beneath or beside one patch.
struct LocalSurface {
  std::uint32_t piece = 0;
  Plane plane;  // Towards the viewer.
};

// For every patch the surfaces of the pieces it belongs to (first) or touches. A surface of a real
// camera is warped by centimetres, but slowly: near a patch it is the plane that most of the piece
// within `reference_radius` lies in, which things on it do not lift while they cover less than
// half.
std::vector<std::vector<LocalSurface>> FindLocalSurfaces(const PatchGraph& graph,
                                                         const SurfacePieces& pieces,
                                                         const ReliefOptions& options,
                                                         int num_threads);

}  // namespace semslam
