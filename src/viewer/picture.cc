// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/picture.h"

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <opencv2/imgproc.hpp>

#include "semslam/base/error.h"
#include "semslam/viewer/offscreen_context.h"
#include "semslam/viewer/orbit_camera.h"
#include "semslam/viewer/renderer.h"

#include "viewer/gl_objects.h"
#include "viewer/gui.h"

namespace semslam {
namespace {

constexpr float kFontSize = 15;  // Pixels.

void LimitToDevice(const Renderer& renderer, int width, int height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width <= largest && height <= largest) return;
  throw InputError(renderer.device() + " draws at most " + std::to_string(largest) +
                   " pixels a side, expected " + std::to_string(std::max(width, height)));
}

OrbitCamera MakeCamera(const MapScene& scene,
                       const LevelFrame& level,
                       const PictureOptions& options) {
  OrbitCamera camera(level);
  const ViewDirection direction = DirectionOf(options.from);
  camera.SetDirection(direction.azimuth, direction.elevation);
  // From above almost without perspective, as a plan.
  if (options.from == Viewpoint::kTop) camera.SetFieldOfView(0.2);
  camera.Fit(PointsToShow(scene, options.overlay), options.width, options.height);
  return camera;
}

}  // namespace

void PictureOptions::Validate() const {
  constexpr int kMinSize = 16;
  constexpr int kMaxSize = 8192;
  for (const int size : {width, height}) {
    if (size >= kMinSize && size <= kMaxSize) continue;
    throw InputError("size of the picture: expected " + std::to_string(kMinSize) + " to " +
                     std::to_string(kMaxSize) + " pixels, found " + std::to_string(size));
  }
  if (supersampling < 1 || supersampling > 4)
    throw InputError("supersampling: expected 1 to 4, found " + std::to_string(supersampling));
}

cv::Mat TakePicture(const MapScene& scene, const PictureOptions& options) {
  options.Validate();
  const LevelFrame level = FindLevelFrame(scene.map);
  const HeightRange heights = FindHeightRange(scene.map.cloud.positions, level.up);
  const int scale = options.supersampling;
  const ViewCamera camera =
      MakeCamera(scene, level, options).At(options.width * scale, options.height * scale);
  const OffscreenContext context;
  Renderer renderer;
  LimitToDevice(renderer, camera.width, camera.height);
  const Renderer::ChunkId chunk =
      renderer.AddChunk(scene.map.cloud.positions, scene.map.cloud.normals);
  renderer.SetColors(chunk, PointColors(scene.map, options.color, level.up, heights));
  const DrawList list = MakeOverlay(scene, level, options.overlay);

  GlTarget target(false);
  target.Resize(camera.width, camera.height);
  renderer.Draw(camera, list,
                {.point_size = scene.map.point_size,
                 .eye_dome = options.eye_dome,
                 .fill_gaps = true,
                 .shade_by_normals = options.color != ColorMode::kPhoto,
                 .pixel_scale = static_cast<float>(scale)},
                target.framebuffer());
  const auto text_scale = static_cast<float>(scale);
  Gui gui(nullptr, kFontSize * text_scale);
  gui.Begin({camera.width, camera.height});
  DrawLabels(gui.background(), camera, list.labels(), text_scale);
  if (options.legend) {
    DrawLegend(gui.background(), camera, ColorLegend(scene.map, options.color, heights),
               text_scale);
  }
  gui.End();
  cv::Mat picture;
  cv::resize(target.Read(), picture, {options.width, options.height}, 0, 0, cv::INTER_AREA);
  return picture;
}

ViewDirection DirectionOf(Viewpoint viewpoint) {
  constexpr double kRightAngle = 0.5 * std::numbers::pi;
  constexpr double kAlmostLevel = 0.15;
  switch (viewpoint) {
    case Viewpoint::kTop:
      return {0, kRightAngle};
    case Viewpoint::kPerspective:
      return {0.45, 0.6};
    case Viewpoint::kFront:
      return {0, kAlmostLevel};
    case Viewpoint::kBack:
      return {2 * kRightAngle, kAlmostLevel};
    case Viewpoint::kLeft:
      return {kRightAngle, kAlmostLevel};
    case Viewpoint::kRight:
      return {-kRightAngle, kAlmostLevel};
  }
  return {};
}

std::vector<std::pair<std::string, Rgb>> ColorLegend(const LabelledMapView& map,
                                                     ColorMode mode,
                                                     const HeightRange& heights) {
  std::vector<std::pair<std::string, Rgb>> entries;
  if (mode == ColorMode::kClasses) {
    const std::set<std::uint32_t> present(map.cloud.labels.begin(), map.cloud.labels.end());
    for (const ClassRecord& entry : map.classes) {
      if (entry.label != 0 && present.contains(entry.label))
        entries.emplace_back(entry.name, entry.color);
    }
  }
  if (mode == ColorMode::kHeight) {
    for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.2f m", share * (heights.high - heights.low));
      entries.emplace_back(text.data(), HeightColor(share));
    }
  }
  return entries;
}

}  // namespace semslam
