// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include <Eigen/Core>

#include "semslam/dense/rgb.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/io/view_camera.h"
#include "semslam/viewer/draw_list.h"

namespace semslam {

// Draws point clouds and lines with OpenGL 3.3, into a window or a picture. Points are kept by the
// graphics card in chunks that can be moved and coloured anew; lines come with each picture.
//
// A picture is made in two passes: points with colour and depth, then eye-dome shading (Boucheny
// 2009) over a background, on which the lines are drawn, fainter where points hide them.
//
// Belongs to the thread in which its OpenGL context is the current one, from first to last.
class Renderer {
 public:
  using ChunkId = std::uint32_t;

  struct Options {
    double point_size = 0.01;      // Metres: what a point covers.
    bool eye_dome = true;          // Darkens what is behind an edge, so that depth can be read.
    bool fill_gaps = false;        // Small ones, of surfaces seen from afar; costs time.
    bool shade_by_normals = true;  // Darkens surfaces seen from the side; needs normals.
    bool round_points = true;      // Slower than squares where there is no graphics card.
    // With more than these every second, third ... is drawn, larger.
    std::size_t max_points = std::numeric_limits<std::size_t>::max();
    float pixel_scale = 1;  // Pixels of the target in a pixel of the picture that people see.
    Rgb background_top{52, 60, 72};
    Rgb background_bottom{23, 26, 31};
  };

  // Uses the thread's current context. Throws InputError if that is none of OpenGL 3.3.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Positions (metres) and normals (unit length, or none) in a frame of the chunk's own. All points
  // are grey until SetColors.
  ChunkId AddChunk(std::span<const Eigen::Vector3f> positions,
                   std::span<const Eigen::Vector3f> normals);
  // One colour a point.
  void SetColors(ChunkId chunk, std::span<const Rgb> colors);
  void SetPose(ChunkId chunk, const Rigid3& T_world_chunk);
  void RemoveChunk(ChunkId chunk);
  std::size_t num_points() const;

  // Into a framebuffer of OpenGL (0: the window's) of the camera's size.
  void Draw(const ViewCamera& camera,
            const DrawList& list,
            const Options& options,
            unsigned framebuffer);

  // The name of what draws, as OpenGL tells it.
  std::string device() const;
  // No graphics card: the processor does it.
  bool is_software() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace semslam
