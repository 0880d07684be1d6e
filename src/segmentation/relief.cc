// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/relief.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>

#include "semslam/base/parallel.h"

#include "segmentation/local_surface.h"

namespace semslam {
namespace {

// Fewer voxels make no patch of their own.
constexpr std::size_t kMinPatchVoxels = 8;

class ReliefCut {
 public:
  ReliefCut(const VoxelGrid& grid,
            const Supervoxels& supervoxels,
            const PatchGraph& graph,
            const SurfacePieces& pieces,
            const ReliefOptions& options,
            int num_threads)
      : grid_(grid),
        old_patch_(supervoxels.patch_of_voxel),
        patch_(supervoxels.patch_of_voxel),
        num_patches_(supervoxels.num_patches),
        pieces_(pieces),
        options_(options),
        surfaces_(FindLocalSurfaces(graph, pieces, options, num_threads)),
        num_threads_(num_threads),
        home_piece_(grid.size(), kNoPiece),
        home_height_(grid.size(), 0.0F),
        is_raised_(grid.size(), 0) {
    for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
      const std::uint32_t patch = old_patch_[voxel];
      if (patch != kNoPatch) home_piece_[voxel] = pieces.piece_of_patch[patch];
    }
  }

  Supervoxels Run() {
    MeasureHomeHeights();
    FindThresholds();
    FindRaised();
    DropCrumbs();
    FollowDown();
    TakeFlush();
    CutRaised();
    return {std::move(patch_), num_patches_};
  }

 private:
  // Calls body(voxel) for all voxels, side by side.
  template <typename Body>
  void ForVoxels(const Body& body) const {
    constexpr std::size_t kGrain = 16384;
    ParallelFor(grid_.size(), kGrain, num_threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t voxel = first; voxel < last; ++voxel) {
        body(static_cast<std::uint32_t>(voxel));
      }
    });
  }

  // The piece that the voxel's patch belongs to.
  std::uint32_t HomePiece(std::uint32_t voxel) const { return home_piece_[voxel]; }
  bool IsFlat(std::uint32_t voxel) const {
    return home_piece_[voxel] != kNoPiece && is_raised_[voxel] == 0;
  }

  std::optional<double> HeightOver(std::uint32_t piece, std::uint32_t voxel) const {
    const std::uint32_t patch = old_patch_[voxel];
    if (patch == kNoPatch) return std::nullopt;
    for (const LocalSurface& surface : surfaces_[patch]) {
      if (surface.piece != piece) continue;
      return surface.plane.SignedDistance(grid_.centroids[voxel].cast<double>());
    }
    return std::nullopt;
  }

  void MeasureHomeHeights() {
    ForVoxels([&](std::uint32_t voxel) {
      const std::uint32_t piece = HomePiece(voxel);
      if (piece == kNoPiece) return;
      home_height_[voxel] = static_cast<float>(HeightOver(piece, voxel).value_or(0));
    });
  }

  // Of each piece from its own noise: by the median, which things on it do not touch.
  void FindThresholds() {
    constexpr double kSigmaOfMedian = 1.4826;
    std::vector<std::vector<float>> heights(pieces_.pieces.size());
    for (std::uint32_t voxel = 0; voxel < grid_.size(); ++voxel) {
      const std::uint32_t piece = HomePiece(voxel);
      if (piece != kNoPiece) heights[piece].push_back(std::abs(home_height_[voxel]));
    }
    for (std::vector<float>& piece_heights : heights) {
      const auto middle =
          piece_heights.begin() + static_cast<std::ptrdiff_t>(piece_heights.size() / 2);
      std::nth_element(piece_heights.begin(), middle, piece_heights.end());
      const double noise = kSigmaOfMedian * *middle;
      thresholds_.push_back(std::max(options_.min_height, options_.noise_factor * noise));
      rim_thresholds_.push_back(
          std::max(options_.min_rim_height, options_.rim_noise_factor * noise));
    }
  }

  // Not only the voxel itself, but also the mean around it: single voxels are noise.
  void FindRaised() {
    ForVoxels([&](std::uint32_t voxel) {
      const std::uint32_t piece = HomePiece(voxel);
      if (piece == kNoPiece || home_height_[voxel] <= thresholds_[piece]) return;
      float sum = home_height_[voxel];
      float count = 1;
      for (const std::uint32_t other : grid_.NeighboursOf(voxel)) {
        if (HomePiece(other) != piece) continue;
        sum += home_height_[other];
        count += 1;
      }
      is_raised_[voxel] = sum > 0.5 * thresholds_[piece] * count ? 1 : 0;
    });
  }

  // The raised voxels connected with one, of the same patch if asked. Marks them as visited.
  std::vector<std::uint32_t> CollectRaised(std::uint32_t first,
                                           bool within_patch,
                                           std::vector<bool>& is_visited) const {
    std::vector<std::uint32_t> region = {first};
    is_visited[first] = true;
    for (std::size_t i = 0; i < region.size(); ++i) {
      for (const std::uint32_t other : grid_.NeighboursOf(region[i])) {
        if (is_raised_[other] == 0 || is_visited[other]) continue;
        if (within_patch && old_patch_[other] != old_patch_[first]) continue;
        is_visited[other] = true;
        region.push_back(other);
      }
    }
    return region;
  }

  // Small bumps that touch no thing stay with the surface.
  void DropCrumbs() {
    const double min_voxels = options_.min_area / (grid_.voxel_size * grid_.voxel_size);
    std::vector<bool> is_visited(grid_.size(), false);
    for (std::uint32_t voxel = 0; voxel < grid_.size(); ++voxel) {
      if (is_raised_[voxel] == 0 || is_visited[voxel]) continue;
      const auto region = CollectRaised(voxel, false, is_visited);
      if (static_cast<double>(region.size()) >= min_voxels) continue;
      const bool touches_thing =
          std::any_of(region.begin(), region.end(), [&](std::uint32_t member) {
            const auto neighbours = grid_.NeighboursOf(member);
            return std::any_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t other) {
              return old_patch_[other] != kNoPatch && HomePiece(other) != HomePiece(member);
            });
          });
      if (touches_thing) continue;
      for (const std::uint32_t member : region) is_raised_[member] = 0;
    }
  }

  // Low, but not as low as the noise, and next to a thing: its rim, its cable. Hysteresis: on their
  // own they would be taken for the surface. Voxel by voxel, so that it ends near the thing.
  void FollowDown() {
    std::vector<std::uint8_t> is_low(grid_.size());
    ForVoxels([&](std::uint32_t voxel) {
      is_low[voxel] = IsFlat(voxel) && home_height_[voxel] > rim_thresholds_[HomePiece(voxel)];
    });
    std::vector<std::uint32_t> front;
    for (std::uint32_t voxel = 0; voxel < grid_.size(); ++voxel) {
      if (is_low[voxel] != 0 && TouchesThing(voxel)) front.push_back(voxel);
    }
    for (const std::uint32_t voxel : front) is_raised_[voxel] = 1;
    for (double rim = grid_.voxel_size; rim < options_.max_rim; rim += grid_.voxel_size) {
      std::vector<std::uint32_t> next;
      for (const std::uint32_t voxel : front) {
        for (const std::uint32_t other : grid_.NeighboursOf(voxel)) {
          if (is_low[other] == 0 || is_raised_[other] != 0) continue;
          is_raised_[other] = 1;
          next.push_back(other);
        }
      }
      front = std::move(next);
    }
  }

  // Next to what is raised or of no surface.
  bool TouchesThing(std::uint32_t voxel) const {
    const auto neighbours = grid_.NeighboursOf(voxel);
    return std::any_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t other) {
      return is_raised_[other] != 0 ||
             (HomePiece(other) == kNoPiece && old_patch_[other] != kNoPatch);
    });
  }

  // From the flat voxels of each piece over what of other patches is as low as they are.
  void TakeFlush() {
    std::vector<std::uint32_t> queue;
    std::vector<std::uint8_t> is_flat(grid_.size());
    ForVoxels([&](std::uint32_t voxel) { is_flat[voxel] = IsFlat(voxel) ? 1 : 0; });
    std::vector<std::uint8_t> is_border(grid_.size());
    ForVoxels([&](std::uint32_t voxel) {
      if (is_flat[voxel] == 0) return;
      const auto neighbours = grid_.NeighboursOf(voxel);
      is_border[voxel] = std::any_of(neighbours.begin(), neighbours.end(),
                                     [&](std::uint32_t other) { return is_flat[other] == 0; });
    });
    for (std::uint32_t voxel = 0; voxel < grid_.size(); ++voxel) {
      if (is_border[voxel] != 0) queue.push_back(voxel);
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t voxel = queue[i];
      const std::uint32_t piece = pieces_.piece_of_patch[patch_[voxel]];
      for (const std::uint32_t other : grid_.NeighboursOf(voxel)) {
        // What rises from this very piece was told from it before.
        if (is_flat[other] != 0 || HomePiece(other) == piece) continue;
        const std::optional<double> height = HeightOver(piece, other);
        if (!height || std::abs(*height) > 0.5 * thresholds_[piece]) continue;
        is_flat[other] = 1;
        is_raised_[other] = 0;
        patch_[other] = patch_[voxel];
        queue.push_back(other);
      }
    }
  }

  // Of the patches outside the region's piece the one with most contacts.
  std::uint32_t NeighbourOf(const std::vector<std::uint32_t>& region) const {
    std::map<std::uint32_t, std::size_t> contacts;
    const std::uint32_t piece = HomePiece(region.front());
    for (const std::uint32_t voxel : region) {
      for (const std::uint32_t other : grid_.NeighboursOf(voxel)) {
        const std::uint32_t patch = patch_[other];
        if (patch == kNoPatch || is_raised_[other] != 0) continue;
        const bool is_cut = patch >= pieces_.piece_of_patch.size();
        if (is_cut || pieces_.piece_of_patch[patch] != piece) ++contacts[patch];
      }
    }
    const auto most =
        std::max_element(contacts.begin(), contacts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == contacts.end() ? kNoPatch : most->first;
  }

  // The raised part of a patch is a patch, or if it is small part of its neighbour.
  void CutRaised() {
    std::vector<bool> is_visited(grid_.size(), false);
    std::vector<std::vector<std::uint32_t>> small;
    for (std::uint32_t voxel = 0; voxel < grid_.size(); ++voxel) {
      if (is_raised_[voxel] == 0 || is_visited[voxel]) continue;
      std::vector<std::uint32_t> region = CollectRaised(voxel, true, is_visited);
      if (region.size() < kMinPatchVoxels) {
        small.push_back(std::move(region));
        continue;
      }
      for (const std::uint32_t member : region) {
        patch_[member] = num_patches_;
        is_raised_[member] = 0;
      }
      ++num_patches_;
    }
    for (const std::vector<std::uint32_t>& region : small) {
      const std::uint32_t neighbour = NeighbourOf(region);
      for (const std::uint32_t member : region) {
        if (neighbour != kNoPatch) patch_[member] = neighbour;
        is_raised_[member] = 0;
      }
    }
  }

  const VoxelGrid& grid_;
  const std::vector<std::uint32_t>& old_patch_;
  std::vector<std::uint32_t> patch_;
  std::uint32_t num_patches_;
  const SurfacePieces& pieces_;
  const ReliefOptions& options_;
  std::vector<std::vector<LocalSurface>> surfaces_;
  int num_threads_;
  std::vector<std::uint32_t> home_piece_;
  std::vector<float> home_height_;  // Over the home piece.
  // By piece: of what is raised on its own, and of what continues a thing.
  std::vector<double> thresholds_;
  std::vector<double> rim_thresholds_;
  // Not of bool: several threads write.
  std::vector<std::uint8_t> is_raised_;
};

// Whether the patches, by their numbers now, have voxels and have others than before.
struct PatchChanges {
  std::vector<bool> is_used;
  std::vector<bool> has_changed;
};

PatchChanges CompareVoxels(const Supervoxels& before, const Supervoxels& now) {
  PatchChanges changes{std::vector<bool>(now.num_patches), std::vector<bool>(now.num_patches)};
  for (std::size_t voxel = 0; voxel < now.patch_of_voxel.size(); ++voxel) {
    const std::uint32_t from = before.patch_of_voxel[voxel];
    const std::uint32_t to = now.patch_of_voxel[voxel];
    if (to != kNoPatch) changes.is_used[to] = true;
    if (from == to) continue;
    if (from != kNoPatch) changes.has_changed[from] = true;
    if (to != kNoPatch) changes.has_changed[to] = true;
  }
  return changes;
}

// Renumbers the patches that have voxels left.
CutPatches Compact(const Supervoxels& before,
                   Supervoxels now,
                   std::vector<std::uint32_t> plane_labels) {
  plane_labels.resize(now.num_patches, 0);
  const PatchChanges changes = CompareVoxels(before, now);
  CutPatches result;
  std::vector<std::uint32_t> new_number(now.num_patches, kNoPatch);
  for (std::uint32_t patch = 0; patch < now.num_patches; ++patch) {
    if (!changes.is_used[patch]) continue;
    new_number[patch] = static_cast<std::uint32_t>(result.plane_labels.size());
    result.plane_labels.push_back(plane_labels[patch]);
    result.old_number.push_back(changes.has_changed[patch] ? kNoPatch : patch);
  }
  for (std::uint32_t& patch : now.patch_of_voxel) {
    if (patch != kNoPatch) patch = new_number[patch];
  }
  result.supervoxels.patch_of_voxel = std::move(now.patch_of_voxel);
  result.supervoxels.num_patches = static_cast<std::uint32_t>(result.plane_labels.size());
  return result;
}

}  // namespace

CutPatches CutAtRelief(const VoxelGrid& grid,
                       const Supervoxels& supervoxels,
                       const PatchGraph& graph,
                       const std::vector<Plane>& planes,
                       const std::vector<std::uint32_t>& plane_labels,
                       double min_structural_area,
                       const ReliefOptions& options,
                       int num_threads) {
  const SurfacePieces pieces =
      FindStructuralPieces(graph, planes, plane_labels, min_structural_area);
  ReliefCut cut(grid, supervoxels, graph, pieces, options, num_threads);
  return Compact(supervoxels, cut.Run(), plane_labels);
}

}  // namespace semslam
