// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/render/clip.h"

namespace semslam::testing {

// The desk that tests run on: exact truth, nothing read from files. A test that needs it links
// semslam::render.
//
//   RenderedClip clip(DeskClipOptions(30));
//   while (std::optional<RgbdImage> image = clip.Next()) ...  // clip.T_world_camera(i): the truth.
inline RenderedClip::Options DeskClipOptions(int num_frames) {
  return {.scene = "desk", .num_frames = num_frames};
}

// The same in a quarter of the pixels and without shadows: five times as fast.
inline RenderedClip::Options SmallDeskClipOptions(int num_frames) {
  RenderedClip::Options options = DeskClipOptions(num_frames);
  PinholeCamera::Parameters& camera = options.camera;
  camera.width /= 2;
  camera.height /= 2;
  camera.fx /= 2;
  camera.fy /= 2;
  camera.cx = 0.5 * (camera.cx + 0.5) - 0.5;  // Pixel (0, 0) is the centre of the first pixel.
  camera.cy = 0.5 * (camera.cy + 0.5) - 0.5;
  options.rendering = {.smooth_edges = true, .shadows = false, .occlusion_reach = 0};
  return options;
}

// The desk without noise, blur, missing depth and lens distortion.
inline RenderedClip::Options CleanDeskClipOptions(int num_frames) {
  RenderedClip::Options options = DeskClipOptions(num_frames);
  options.camera = CameraByName("TUM3");
  options.MakeClean();
  return options;
}

}  // namespace semslam::testing
