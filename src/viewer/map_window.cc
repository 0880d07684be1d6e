// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/map_window.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <imgui.h>

#include "semslam/viewer/picture.h"

#include "viewer/panels.h"
#include "viewer/window.h"

namespace semslam {
namespace {

constexpr std::size_t kMaxPointsWhileSteering = 250'000;  // Without a graphics card.
constexpr float kPanelWidth = 330;                        // Pixels of an ordinary screen.
constexpr double kMaxWait = 0.2;                          // Seconds between two looks at the world.

class MapWindow {
 public:
  MapWindow(const MapScene& scene, const MapWindowOptions& options)
      : scene_(scene),
        options_(options),
        level_(FindLevelFrame(scene.map)),
        heights_(FindHeightRange(scene.map.cloud.positions, level_.up)),
        window_(options.title, options.width, options.height),
        camera_(level_) {
    choices_.color = options.color;
    chunk_ = window_.renderer().AddChunk(scene.map.cloud.positions, scene.map.cloud.normals);
    Color();
    const ViewDirection direction = DirectionOf(Viewpoint::kPerspective);
    camera_.SetDirection(direction.azimuth, direction.elevation);
    Fit();
  }

  void Run() {
    while (window_.is_open() && !(options_.should_close && options_.should_close())) {
      // Two more pictures after an event let the panels settle.
      window_.Begin(num_due_ > 0 ? 0 : kMaxWait);
      num_due_ = WasTouched() ? 3 : std::max(0, num_due_ - 1);
      DrawPanel();
      if (const auto place = window_.Steer(&camera_)) Click(*place);
      DrawScene();
      window_.End();
    }
  }

 private:
  bool WasTouched() {
    const ImGuiIO& io = ImGui::GetIO();
    const Eigen::Vector2i size = window_.size();
    const bool was_resized = std::exchange(size_, size) != size;
    const bool has_input = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 ||
                           ImGui::IsAnyMouseDown() || ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    return was_resized || has_input || window_.is_steering() || std::exchange(is_coarse_, false);
  }

  void Color() {
    window_.renderer().SetColors(chunk_,
                                 PointColors(scene_.map, choices_.color, level_.up, heights_));
    num_due_ = 3;
  }

  void Fit() {
    const Eigen::Vector2i size = window_.size();
    camera_.Fit(PointsToShow(scene_, choices_.overlay), size.x(), size.y());
    num_due_ = 3;
  }

  void FlyTo(std::uint32_t id) {
    for (const ObjectRecord& object : scene_.map.objects) {
      if (object.id != id) continue;
      constexpr double kDistancePerSize = 7;
      camera_.LookAt(object.box.T_world_box.translation,
                     std::max(0.8, kDistancePerSize * object.box.half_size.norm()));
    }
    num_due_ = 3;
  }

  void DrawPanel() {
    const float scale = window_.scale();
    ImGui::SetNextWindowPos({10 * scale, 10 * scale}, ImGuiCond_Once);
    ImGui::SetNextWindowSize({kPanelWidth * scale, 0}, ImGuiCond_Once);
    ImGui::Begin("Map", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    if (ChooseColors(&choices_.color)) Color();
    if (ChooseViewpoint(&camera_)) Fit();
    OverlayOptions& overlay = choices_.overlay;
    ImGui::Checkbox("objects", &overlay.objects);
    ImGui::SameLine();
    ImGui::Checkbox("camera", &overlay.trajectory);
    ImGui::SameLine();
    ImGui::Checkbox("floor", &overlay.grid);
    ImGui::SameLine();
    ImGui::Checkbox("depth", &choices_.eye_dome);
    ImGui::Text("%zu points, %zu objects", scene_.map.cloud.positions.size(),
                scene_.map.objects.size());
    if (ChooseObject(scene_.map.objects, scene_.map.classes, &overlay.selected_object) &&
        overlay.selected_object) {
      FlyTo(*overlay.selected_object);
    }
    for (const ObjectRecord& object : scene_.map.objects) {
      if (overlay.selected_object != object.id) continue;
      ImGui::Separator();
      TellObject(object, scene_.map.classes);
    }
    ImGui::End();
  }

  void Click(const Eigen::Vector2d& place) {
    const Eigen::Vector2i size = window_.size();
    const ViewCamera camera = camera_.At(size.x(), size.y());
    choices_.overlay.selected_object = std::nullopt;
    if (!choices_.overlay.objects) return;
    choices_.overlay.selected_object =
        PickObject(scene_.map.objects, camera.p_world.cast<double>(), PixelRay(camera, place));
    // Names stand above boxes, so they come first.
    for (const Plate& plate : plates_) {
      const bool is_inside = (place.cast<float>().array() >= plate.low.array()).all() &&
                             (place.cast<float>().array() <= plate.high.array()).all();
      if (is_inside) choices_.overlay.selected_object = scene_.map.objects[plate.label].id;
    }
    num_due_ = 3;
  }

  void DrawScene() {
    const Eigen::Vector2i size = window_.size();
    const ViewCamera camera = camera_.At(size.x(), size.y());
    const DrawList list = MakeOverlay(scene_, level_, choices_.overlay);
    const bool is_software = window_.renderer().is_software();
    is_coarse_ = is_software && (is_first_ || window_.is_steering());
    is_first_ = false;
    window_.renderer().Draw(camera, list,
                            {.point_size = scene_.map.point_size,
                             .eye_dome = choices_.eye_dome,
                             .fill_gaps = !is_coarse_,
                             .shade_by_normals = choices_.color != ColorMode::kPhoto,
                             .round_points = !is_coarse_,
                             .max_points = is_coarse_ ? kMaxPointsWhileSteering
                                                      : std::numeric_limits<std::size_t>::max(),
                             .pixel_scale = window_.scale()},
                            0);
    plates_ = DrawLabels(window_.gui().background(), camera, list.labels(), window_.scale());
    DrawLegend(window_.gui().background(), camera,
               ColorLegend(scene_.map, choices_.color, heights_), window_.scale());
  }

  const MapScene& scene_;
  const MapWindowOptions& options_;
  const LevelFrame level_;
  const HeightRange heights_;
  Window window_;
  OrbitCamera camera_;
  ViewChoices choices_;
  Renderer::ChunkId chunk_ = 0;
  std::vector<Plate> plates_;
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  int num_due_ = 3;         // Pictures to draw at once.
  bool is_first_ = true;    // The first picture comes soon, if coarse.
  bool is_coarse_ = false;  // The last one was drawn with fewer points.
};

}  // namespace

void ShowMap(const MapScene& scene, const MapWindowOptions& options) {
  MapWindow(scene, options).Run();
}

}  // namespace semslam
