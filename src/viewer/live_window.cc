// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/live_window.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <imgui.h>

#include "semslam/base/stopwatch.h"
#include "semslam/viewer/picture.h"

#include "viewer/line_styles.h"
#include "viewer/live_panels.h"
#include "viewer/live_points.h"
#include "viewer/panels.h"
#include "viewer/window.h"

namespace semslam {
namespace {

constexpr double kGraphInterval = 0.25;           // Seconds between two looks at the graph.
constexpr double kMapInterval = 3;                // At least, between two labelled maps.
constexpr double kPictureInterval = 1.0 / 30;     // With a graphics card, seconds.
constexpr double kSoftwareInterval = 1.0 / 6;     // Without.
constexpr std::size_t kSoftwarePoints = 200'000;  // That many are drawn then.
constexpr double kSoftwareShare = 0.25;           // Of a core, at most, but
constexpr double kMaxInterval = 0.6;              // on a busy machine no fewer than this.
constexpr int kPicturesAtOnce = 3;                // At first: panels take two to find their size.

constexpr LineStyle kCovisibleStyle{
    .color = {96, 200, 150}, .alpha = 0.30F, .width = 1.0F, .hidden_share = 0.1F};
constexpr LineStyle kTreeStyle{
    .color = {96, 220, 160}, .alpha = 0.6F, .width = 1.2F, .hidden_share = 0.1F};
constexpr LineStyle kLoopStyle{
    .color = {255, 80, 110}, .alpha = 0.95F, .width = 2.2F, .hidden_share = 0.4F};
constexpr LineStyle kCameraStyle{
    .color = {255, 236, 120}, .alpha = 1.0F, .width = 2.4F, .hidden_share = 0.6F};

class LiveWindow {
 public:
  LiveWindow(LiveSource& source, const LiveWindowOptions& options)
      : source_(source),
        window_(options.title, options.width, options.height),
        points_(&window_.renderer(), source.voxel_size()) {
    const PinholeCamera::Parameters camera = source.camera();
    half_width_ = 0.5 * camera.width / camera.fx;
    half_height_ = 0.5 * camera.height / camera.fy;
    camera_.SetDirection(0.35, 0.5);
    camera_.LookAt({0, 0, 1.2}, 3.2);
  }

  void Run(const std::stop_token& stop) {
    while (window_.is_open() && !stop.stop_requested()) {
      window_.Begin(Wait());
      since_picture_.Restart();
      Update();
      DrawPanels();
      if (const auto place = window_.Steer(&camera_)) Click(*place);
      FollowCamera();
      DrawScene();
      window_.End();
    }
  }

 private:
  bool is_software() { return window_.renderer().is_software(); }

  // Until the next picture. Without a graphics card so long that the run keeps its cores.
  double Wait() {
    if (num_pictures_++ < kPicturesAtOnce) return 0;
    const double interval = is_software() ? std::clamp(window_.picture_seconds() / kSoftwareShare,
                                                       kSoftwareInterval, kMaxInterval)
                                          : kPictureInterval;
    return std::max(0.001, interval - since_picture_.Seconds());
  }

  void Update() {
    status_ = source_.status();
    if (!has_graph_ || since_graph_.Seconds() > kGraphInterval) {
      since_graph_.Restart();
      has_graph_ = true;
      graph_ = source_.graph();
      clouds_ = source_.clouds();
    }
    points_.Follow(clouds_);
    if (!has_asked_ || since_map_.Seconds() > kMapInterval) {
      since_map_.Restart();
      has_asked_ = true;
      if (!status_.has_ended) source_.RequestMap();
    }
    if (std::shared_ptr<const LiveMap> map = source_.map()) {
      if (map != map_) {
        map_ = std::move(map);
        points_.SetMap(map_);
        Level();
      }
    }
    points_.SetMode(choices_.color);
    points_.Color();
    sightings_.Select(source_, Selected());
  }

  // The camera turns about what is upwards as soon as that is known.
  void Level() {
    if (is_level_) return;
    is_level_ = true;
    OrbitCamera level(points_.level());
    level.SetDirection(camera_.azimuth(), camera_.elevation());
    level.LookAt(camera_.target(), camera_.distance());
    camera_ = level;
  }

  const ObjectRecord* Selected() const {
    if (map_ == nullptr || !choices_.overlay.selected_object) return nullptr;
    for (const ObjectRecord& object : map_->map.objects) {
      if (object.id == *choices_.overlay.selected_object) return &object;
    }
    return nullptr;
  }

  // The place looked at goes with the camera, softly; how it is looked at is the user's.
  void FollowCamera() {
    const auto frame = source_.frame();
    if (!follows_ || frame == nullptr || !frame->T_world_camera) return;
    constexpr double kAhead = 1.0;     // Metres.
    constexpr double kSoftness = 0.2;  // Share of the way in a picture.
    const Eigen::Vector3d goal = *frame->T_world_camera * Eigen::Vector3d(0, 0, kAhead);
    camera_.SetTarget(camera_.target() + kSoftness * (goal - camera_.target()));
  }

  void Fit() {
    const Eigen::Vector2i size = window_.size();
    follows_ = false;
    camera_.Fit(points_.Sample(), size.x(), size.y());
  }

  void DrawPanels() {
    const float scale = window_.scale();
    const float controls_end = DrawControls();
    camera_panel_.Draw(source_, scale, controls_end + 8 * scale);
    const float speed_end =
        speed_panel_.Draw(source_, status_, scale, static_cast<float>(window_.size().x()));
    if (map_ != nullptr && !map_->map.objects.empty()) DrawObjects(speed_end + 8 * scale);
  }

  // Where it ends.
  float DrawControls() {
    const float scale = window_.scale();
    ImGui::SetNextWindowPos({10 * scale, 10 * scale}, ImGuiCond_Always);
    ImGui::SetNextWindowSize({1.16F * kSidePanelWidth * scale, 0}, ImGuiCond_Always);
    ImGui::Begin(
        "Run", nullptr,
        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    DrawCommands();
    ImGui::Separator();
    DrawChoices();
    ImGui::Separator();
    if (ImGui::BeginTable("status", 2)) {
      for (const auto& [name, value] : status_.facts) TellFact(name.c_str(), value);
      TellFact("points shown", std::to_string(window_.renderer().num_points()));
      ImGui::EndTable();
    }
    const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
    ImGui::End();
    return bottom;
  }

  void DrawCommands() {
    if (status_.has_ended) {
      ImGui::TextDisabled("the run has ended");
    } else {
      if (ImGui::Button(status_.is_paused ? "go on" : "pause"))
        source_.SetPaused(!status_.is_paused);
      ImGui::SameLine();
      if (ImGui::Button("step")) source_.Step();
      ImGui::SameLine();
      if (ImGui::Button("save")) source_.Save();
      ImGui::SameLine();
      if (ImGui::Button("reset")) source_.Reset();
      bool localization = status_.is_localization_only;
      if (ImGui::Checkbox("localisation only", &localization))
        source_.SetLocalizationOnly(localization);
    }
    if (!status_.message.empty()) ImGui::TextWrapped("%s", status_.message.c_str());
  }

  void DrawChoices() {
    ChooseColors(&choices_.color);
    ImGui::Checkbox("follow", &follows_);
    ImGui::SameLine();
    if (ChooseViewpoint(&camera_)) Fit();
    ImGui::Checkbox("objects", &choices_.overlay.objects);
    ImGui::SameLine();
    ImGui::Checkbox("keyframes", &shows_keyframes_);
    ImGui::SameLine();
    ImGui::Checkbox("edges", &shows_edges_);
    ImGui::Checkbox("way", &choices_.overlay.trajectory);
    ImGui::SameLine();
    ImGui::Checkbox("floor", &choices_.overlay.grid);
    ImGui::SameLine();
    ImGui::Checkbox("depth", &choices_.eye_dome);
  }

  // In the lower right corner, below `top`.
  void DrawObjects(float top) {
    const float scale = window_.scale();
    const Eigen::Vector2f size = window_.size().cast<float>();
    const float width = kSidePanelWidth * scale;
    const float max_height = std::max(200 * scale, size.y() - top - 10 * scale);
    ImGui::SetNextWindowPos({size.x() - 10 * scale, size.y() - 10 * scale}, ImGuiCond_Always,
                            {1, 1});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, max_height});
    ImGui::Begin("Objects", nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ListObjects();
    ImGui::End();
  }

  void ListObjects() {
    constexpr float kMaxHeight = 150;
    const auto num_objects = static_cast<float>(map_->map.objects.size());
    const float height = std::min(kMaxHeight * window_.scale(),
                                  num_objects * ImGui::GetTextLineHeightWithSpacing() + 4);
    ImGui::BeginChild("list", {0, height});
    const bool has_changed =
        ChooseObject(map_->map.objects, map_->map.classes, &choices_.overlay.selected_object);
    ImGui::EndChild();
    const ObjectRecord* selected = Selected();
    if (selected == nullptr) return;
    if (has_changed) {
      follows_ = false;
      camera_.LookAt(selected->box.T_world_box.translation,
                     std::max(0.8, 7 * selected->box.half_size.norm()));
    }
    TellObject(*selected, map_->map.classes);
    sightings_.Draw(ImGui::GetContentRegionAvail().x);
  }

  void Click(const Eigen::Vector2d& place) {
    choices_.overlay.selected_object = std::nullopt;
    if (map_ == nullptr || !choices_.overlay.objects) return;
    const Eigen::Vector2i size = window_.size();
    const ViewCamera camera = camera_.At(size.x(), size.y());
    choices_.overlay.selected_object =
        PickObject(map_->map.objects, camera.p_world.cast<double>(), PixelRay(camera, place));
    for (const Plate& plate : plates_) {
      const bool is_inside = (place.cast<float>().array() >= plate.low.array()).all() &&
                             (place.cast<float>().array() <= plate.high.array()).all();
      if (is_inside && plate.label < map_->map.objects.size())
        choices_.overlay.selected_object = map_->map.objects[plate.label].id;
    }
  }

  DrawList MakeLines() const {
    DrawList list;
    if (map_ != nullptr) {
      MapScene scene;
      scene.map = map_->map;
      OverlayOptions overlay = choices_.overlay;
      overlay.trajectory = false;
      list = MakeOverlay(scene, points_.level(), overlay);
    }
    AddEdges(&list);
    constexpr double kKeyframeDepth = 0.05;  // Metres.
    constexpr double kCameraDepth = 0.12;
    if (shows_keyframes_) {
      for (const Rigid3& keyframe : graph_.keyframes)
        list.AddFrustum(keyframe, half_width_, half_height_, kKeyframeDepth, kKeyframeStyle);
    }
    if (choices_.overlay.trajectory) list.AddPath(graph_.trajectory, kTrajectoryStyle);
    const auto frame = source_.frame();
    if (frame != nullptr && frame->T_world_camera)
      list.AddFrustum(*frame->T_world_camera, half_width_, half_height_, kCameraDepth,
                      kCameraStyle);
    return list;
  }

  void AddEdges(DrawList* list) const {
    if (!shows_edges_) return;
    const auto add = [&](const std::vector<LiveGraph::Edge>& edges, const LineStyle& style) {
      for (const auto& [a, b] : edges)
        list->AddLine(graph_.keyframes[a].translation, graph_.keyframes[b].translation, style);
    };
    add(graph_.covisible, kCovisibleStyle);
    add(graph_.tree, kTreeStyle);
    add(graph_.loops, kLoopStyle);
  }

  void DrawScene() {
    const Eigen::Vector2i size = window_.size();
    const ViewCamera camera = camera_.At(size.x(), size.y());
    const DrawList list = MakeLines();
    const bool fine = !is_software();
    Renderer::Options options;
    options.point_size = source_.voxel_size();
    options.eye_dome = choices_.eye_dome;
    options.fill_gaps = fine;
    options.shade_by_normals = choices_.color != ColorMode::kPhoto;
    options.round_points = fine;
    if (!fine) options.max_points = kSoftwarePoints;
    options.pixel_scale = window_.scale();
    window_.renderer().Draw(camera, list, options, 0);
    plates_ = DrawLabels(window_.gui().background(), camera, list.labels(), window_.scale());
  }

  LiveSource& source_;
  Window window_;
  OrbitCamera camera_;
  LivePoints points_;
  CameraPanel camera_panel_;
  SpeedPanel speed_panel_;
  SightingsPanel sightings_;
  ViewChoices choices_;
  LiveStatus status_;
  LiveGraph graph_;
  std::vector<LiveCloud> clouds_;
  std::shared_ptr<const LiveMap> map_;
  std::vector<Plate> plates_;
  double half_width_ = 0;  // Tangents of the camera's view.
  double half_height_ = 0;
  bool follows_ = true;
  bool shows_keyframes_ = true;
  bool shows_edges_ = true;
  bool is_level_ = false;
  int num_pictures_ = 0;
  bool has_graph_ = false;
  bool has_asked_ = false;
  Stopwatch since_graph_;
  Stopwatch since_map_;
  Stopwatch since_picture_;
};

}  // namespace

void ShowRun(LiveSource& source, const LiveWindowOptions& options, const std::stop_token& stop) {
  LiveWindow(source, options).Run(stop);
}

}  // namespace semslam
