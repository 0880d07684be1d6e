// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/local_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "semslam/base/parallel.h"

#include "segmentation/disjoint_sets.h"

namespace semslam {
namespace {

using Adjacency = std::vector<std::vector<std::uint32_t>>;

Adjacency NeighboursOf(const PatchGraph& graph) {
  Adjacency neighbours(graph.patches.size());
  for (const PatchEdge& edge : graph.edges) {
    neighbours[edge.a].push_back(edge.b);
    neighbours[edge.b].push_back(edge.a);
  }
  return neighbours;
}

Plane TowardsViewer(const PatchGraph& graph, const SurfacePiece& piece, const Plane& plane) {
  double votes = 0;
  for (const std::uint32_t patch : piece.patches) {
    votes += graph.patches[patch].area * graph.patches[patch].normal.dot(plane.normal);
  }
  return votes < 0 ? plane.Flipped() : plane;
}

// Finds the patches of a piece near a place, over edges within the piece.
class NearPatches {
 public:
  NearPatches(const PatchGraph& graph, const SurfacePieces& pieces, const Adjacency& neighbours)
      : graph_(graph),
        pieces_(pieces),
        neighbours_(neighbours),
        visit_(graph.patches.size(), kNoPatch) {}

  // Those within `radius` of patch `centre`, which belongs to the piece or touches it.
  std::vector<std::uint32_t> Find(std::uint32_t centre, std::uint32_t piece, double radius) {
    std::vector<std::uint32_t> found;
    const auto offer = [&](std::uint32_t patch) {
      if (pieces_.piece_of_patch[patch] != piece || visit_[patch] == num_searches_) return;
      const Eigen::Vector3d offset =
          graph_.patches[patch].centroid - graph_.patches[centre].centroid;
      if (offset.squaredNorm() > radius * radius) return;
      visit_[patch] = num_searches_;
      found.push_back(patch);
    };
    offer(centre);
    for (const std::uint32_t patch : neighbours_[centre]) offer(patch);
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (const std::uint32_t patch : neighbours_[found[i]]) offer(patch);
    }
    ++num_searches_;
    return found;
  }

 private:
  const PatchGraph& graph_;
  const SurfacePieces& pieces_;
  const Adjacency& neighbours_;
  std::vector<std::uint32_t> visit_;
  std::uint32_t num_searches_ = 0;
};

// Height of a patch over a plane, at a place along it.
struct Sample {
  Eigen::Vector3d place;  // 1, and two coordinates along the plane, metres.
  double height = 0;
  double area = 0;
};

double MedianHeight(std::vector<Sample> samples) {
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.height < b.height; });
  double half = 0;
  for (const Sample& sample : samples) half += 0.5 * sample.area;
  for (const Sample& sample : samples) {
    half -= sample.area;
    if (half <= 0) return sample.height;
  }
  return 0;
}

// Coefficients of height = c . place. Samples far from the median, then from the fit, are things on
// the surface. A narrow strip of surface does not tell its slope: then the plane's stays.
Eigen::Vector3d FitHeights(const std::vector<Sample>& samples, double tolerance) {
  constexpr double kMinSpread = 0.05;  // Metres.
  Eigen::Vector3d coefficients(MedianHeight(samples), 0, 0);
  for (int iteration = 0; iteration < 2; ++iteration) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Sample& sample : samples) {
      if (std::abs(sample.height - coefficients.dot(sample.place)) > tolerance) continue;
      normal += sample.area * sample.place * sample.place.transpose();
      right += sample.area * sample.height * sample.place;
    }
    if (!(normal(0, 0) > 0)) break;
    const double ridge = normal(0, 0) * kMinSpread * kMinSpread;
    normal(1, 1) += ridge;
    normal(2, 2) += ridge;
    coefficients = normal.ldlt().solve(right);
  }
  return coefficients;
}

Plane FitLocally(const PatchGraph& graph,
                 const Plane& plane,
                 const Eigen::Vector3d& centre,
                 const std::vector<std::uint32_t>& near,
                 double tolerance) {
  const Eigen::Vector3d u = plane.normal.unitOrthogonal();
  const Eigen::Vector3d v = plane.normal.cross(u);
  std::vector<Sample> samples;
  for (const std::uint32_t index : near) {
    const Patch& patch = graph.patches[index];
    const Eigen::Vector3d offset = patch.centroid - centre;
    samples.push_back(
        {{1, u.dot(offset), v.dot(offset)}, plane.SignedDistance(patch.centroid), patch.area});
  }
  const Eigen::Vector3d c = FitHeights(samples, tolerance);
  const Eigen::Vector3d normal = (plane.normal - c[1] * u - c[2] * v).normalized();
  const Eigen::Vector3d foot = centre + (c[0] - plane.SignedDistance(centre)) * plane.normal;
  return {normal, -normal.dot(foot)};
}

// The piece a patch belongs to, then those it touches, each once.
std::vector<std::uint32_t> PiecesAt(std::uint32_t patch,
                                    const SurfacePieces& pieces,
                                    const Adjacency& neighbours) {
  const std::uint32_t own = pieces.piece_of_patch[patch];
  std::vector<std::uint32_t> touched;
  for (const std::uint32_t other : neighbours[patch]) {
    const std::uint32_t piece = pieces.piece_of_patch[other];
    if (piece != kNoPiece && piece != own) touched.push_back(piece);
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  if (own != kNoPiece) touched.insert(touched.begin(), own);
  return touched;
}

}  // namespace

SurfacePieces FindStructuralPieces(const PatchGraph& graph,
                                   const std::vector<Plane>& planes,
                                   const std::vector<std::uint32_t>& plane_labels,
                                   double min_area) {
  DisjointSets sets(graph.patches.size());
  for (const PatchEdge& edge : graph.edges) {
    if (plane_labels[edge.a] == plane_labels[edge.b]) sets.Join(edge.a, edge.b);
  }
  std::map<std::uint32_t, std::pair<SurfacePiece, double>> candidates;  // With their area.
  for (std::uint32_t i = 0; i < graph.patches.size(); ++i) {
    if (plane_labels[i] == 0) continue;
    auto& [piece, area] = candidates[sets.Find(i)];
    piece.plane_label = plane_labels[i];
    piece.patches.push_back(i);
    area += graph.patches[i].area;
  }
  SurfacePieces result;
  result.piece_of_patch.assign(graph.patches.size(), kNoPiece);
  for (auto& [representative, candidate] : candidates) {
    auto& [piece, area] = candidate;
    if (area < min_area) continue;
    piece.plane = TowardsViewer(graph, piece, planes[piece.plane_label - 1]);
    for (const std::uint32_t patch : piece.patches) {
      result.piece_of_patch[patch] = static_cast<std::uint32_t>(result.pieces.size());
    }
    result.pieces.push_back(std::move(piece));
  }
  return result;
}

std::vector<std::vector<LocalSurface>> FindLocalSurfaces(const PatchGraph& graph,
                                                         const SurfacePieces& pieces,
                                                         const ReliefOptions& options,
                                                         int num_threads) {
  constexpr std::size_t kGrain = 512;  // Each chunk searches with scratch memory of its own.
  const Adjacency neighbours = NeighboursOf(graph);
  std::vector<std::vector<LocalSurface>> surfaces(graph.patches.size());
  ParallelFor(surfaces.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    NearPatches near_patches(graph, pieces, neighbours);
    for (std::size_t i = first; i < last; ++i) {
      const auto patch = static_cast<std::uint32_t>(i);
      for (const std::uint32_t piece : PiecesAt(patch, pieces, neighbours)) {
        const auto near = near_patches.Find(patch, piece, options.reference_radius);
        surfaces[i].push_back(
            {piece, FitLocally(graph, pieces.pieces[piece].plane, graph.patches[i].centroid, near,
                               options.min_height)});
      }
    }
  });
  return surfaces;
}

}  // namespace semslam
