// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace semslam {

// Step 1: supervoxels (Papon et al., "Voxel cloud connectivity segmentation", CVPR 2013).
struct SupervoxelOptions {
  double voxel_size = 0.008;  // Metres.
  // Clouds sparser than the voxels would fall apart: then the voxels grow, up to this factor.
  double max_voxel_growth = 4.0;
  double seed_spacing = 0.08;       // Metres between the seeds of supervoxels.
  double spatial_weight = 0.4;      // Of the distance in seed spacings.
  double normal_weight = 1.0;       // Of one minus the cosine between the normals.
  double offset_weight = 2.4;       // Of the distance from the tangent plane, in seed spacings,
  double offset_tolerance = 0.004;  // as far as it is more than noise, metres.
  int num_passes = 2;               // Each further pass grows again from the centres of the last.
  std::size_t min_voxels = 8;       // Smaller supervoxels are left to their neighbours.
};

// Steps 2 and 3: plane hypotheses and their support (Pham et al., IROS 2016).
struct PlaneHypothesisOptions {
  double tolerance = 0.01;         // tau: distance of a patch that belongs to a plane, metres.
  double min_area = 0.01;          // A_min: support a plane needs, square metres.
  double min_normal_cosine = 0.8;  // Between the normals of plane and patch.
  double max_variation = 0.01;     // Surface variation of a patch that proposes its own plane.
  int max_ransac_planes = 1000;    // From random triples of patches.
  int num_ransac_trials = 20000;
  std::uint64_t seed = 1;
  double merge_angle = 0.0175;   // Cell of near-duplicates, radians.
  double merge_distance = 0.01;  // The same, metres; not above the tolerance, or of a wall and a
                                 // whiteboard on it one is lost.
  std::size_t max_planes = 500;  // The best supported stay.
};

// Step 4: which planes explain the scene (Gorelick et al., "Submodularization for binary pairwise
// energies", CVPR 2014).
struct PlaneSelectionOptions {
  double initial_lambda = 0.1;
  double max_lambda_change = 1.5;  // Factor a step.
  double min_reduction_ratio = 0.25;
  int num_restarts = 5;  // From random subsets.
  int max_iterations = 200;
  std::uint64_t seed = 1;
};

// Step 5: a plane or none for every patch (Boykov, Veksler and Zabih, PAMI 2001).
struct PlaneAssignmentOptions {
  double no_plane_cost = 1.0;      // In tolerances.
  double smoothness = 0.5;         // Of two labels on an edge, in tolerances.
  double min_smooth_cosine = 0.5;  // Neighbours whose normals differ more do not pull.
  int max_sweeps = 10;
};

// Between steps 5 and 6: what rises from a large plane is no part of it.
struct ReliefOptions {
  double min_height = 0.004;       // Of a thing over the surface it lies on, metres, and
  double noise_factor = 3;         // in standard deviations of the surface's own roughness.
  double min_rim_height = 0.001;   // The same of what continues a thing. A voxel of noise has about
  double rim_noise_factor = 2.5;   // eight neighbours: at two deviations or more less than one of
                                   // them is as high, so that noise does not spread.
  double max_rim = 0.08;           // How far that reaches from the thing, metres.
  double reference_radius = 0.25;  // Of the surface a height is measured from, metres.
  double min_area = 0.002;         // Of a thing that nothing else tells of, square metres.
};

// Step 6: components (Stein et al., "Object partitioning using local convexity", CVPR 2014).
struct ComponentOptions {
  double concavity_tolerance = 0.1745;  // Bend that still counts as flat, radians.
  double step_tolerance = 0.004;        // Step that still counts as smooth, metres.
  double min_thing_area = 0.01;  // Smaller things join the one they touch most, square metres,
  double max_part_gap = 0.04;    // or, if they touch nothing, one that is this near, metres.
  // Of the contacts of a thing those with a larger rounded one, to be a part of that.
  double min_resting_share = 0.6;
  std::size_t min_patches = 2;        // Components of fewer patches are unassigned
  double min_area = 0.002;            // if they are smaller than this, square metres.
  double min_structural_area = 0.25;  // Planes from here on are floor, wall, table: square metres.
  double min_piece_area = 0.04;  // Pieces of such a plane from here on belong to it, square metres,
  double max_gap = 1.0;          // over gaps up to this: a wall behind a monitor, metres.
  double flush_tolerance = 0.008;  // Of a patch against its neighbour's tangent plane, metres.
  double min_core_area = 0.1;      // A plane from here on, square metres, also takes patches that
  double warp_tolerance = 0.045;   // continue it and are this near, metres.
};

}  // namespace semslam
