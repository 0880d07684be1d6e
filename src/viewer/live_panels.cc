// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/live_panels.h"

#include <algorithm>
#include <cstdio>

#include <imgui.h>

#include "viewer/panels.h"

namespace semslam {
namespace {

constexpr float kCameraWidth = 328;  // Pixels of an ordinary screen.
constexpr ImU32 kLandmarkColor = IM_COL32(90, 235, 120, 255);
constexpr ImU32 kOtherColor = IM_COL32(120, 160, 230, 150);

ImTextureID ToImGui(unsigned texture) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui's back end takes OpenGL's names as pointers.
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
}

// The picture in this width. Its top left corner on the screen.
ImVec2 ShowPicture(const ImageTexture& picture, float width) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height =
      width * static_cast<float>(picture.height()) / static_cast<float>(picture.width());
  ImGui::Image(ToImGui(picture.id()), {width, height});
  return corner;
}

void Append(float value, std::vector<float>* values) {
  constexpr std::size_t kMaxValues = 240;
  values->push_back(value);
  if (values->size() > kMaxValues) values->erase(values->begin());
}

void Plot(const char* id, const std::vector<float>& values, const std::string& text, float scale) {
  if (values.empty()) return;
  const float largest = *std::max_element(values.begin(), values.end());
  ImGui::PushID(id);
  ImGui::PlotLines("##plot", values.data(), static_cast<int>(values.size()), 0, text.c_str(), 0,
                   std::max(1e-3F, 1.15F * largest),
                   {ImGui::GetContentRegionAvail().x, 24 * scale});
  ImGui::PopID();
}

std::string WithNumber(const std::string& name, const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return name + "  " + text;
}

}  // namespace

void CameraPanel::Draw(const LiveSource& source, float scale, float top) {
  const float width = kCameraWidth * scale;
  ImGui::SetNextWindowPos({10 * scale, top}, ImGuiCond_Always);
  ImGui::Begin("Camera", nullptr,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  const auto frame = source.frame();
  if (frame != nullptr) DrawFrame(*frame, width);
  const auto detections = source.detections();
  if (detections != nullptr) {
    if (detections != detections_)
      detection_picture_.Set(detections->color, static_cast<int>(width));
    detections_ = detections;
    DrawDetections(*detections, width);
  }
  ImGui::End();
}

void CameraPanel::DrawFrame(const LiveFrame& frame, float width) {
  if (frame_number_ != frame.number)
    frame_picture_.Set(frame.image->color, static_cast<int>(width));
  frame_number_ = frame.number;
  const ImVec2 corner = ShowPicture(frame_picture_, width);
  const float scale = width / static_cast<float>(frame.image->color.cols);
  ImDrawList* canvas = ImGui::GetWindowDrawList();
  std::size_t num_landmarks = 0;
  const std::size_t num_keypoints = frame.features ? frame.features->keypoints.size() : 0;
  for (std::size_t i = 0; i < num_keypoints; ++i) {
    const Eigen::Vector2f& pixel = frame.features->keypoints[i].raw_pixel;
    const bool is_landmark = i < frame.shows_landmark.size() && frame.shows_landmark[i];
    if (is_landmark) ++num_landmarks;
    const ImVec2 place(corner.x + scale * pixel.x(), corner.y + scale * pixel.y());
    const float half = is_landmark ? 1.6F : 1.0F;
    canvas->AddRectFilled({place.x - half, place.y - half}, {place.x + half, place.y + half},
                          is_landmark ? kLandmarkColor : kOtherColor);
  }
  const bool is_lost = !frame.T_world_camera;
  ImGui::TextColored(is_lost ? ImVec4(1.0F, 0.45F, 0.4F, 1.0F) : ImVec4(0.5F, 0.95F, 0.6F, 1.0F),
                     "%s", frame.state.c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("frame %zu, %zu of %zu keypoints in the map", frame.number, num_landmarks,
                      num_keypoints);
}

void CameraPanel::DrawDetections(const LiveDetections& detections, float width) {
  const ImVec2 corner = ShowPicture(detection_picture_, width);
  const float scale = width / static_cast<float>(detections.color.cols);
  ImDrawList* canvas = ImGui::GetWindowDrawList();
  for (const LiveDetections::Box& box : detections.boxes) {
    const ImU32 color = IM_COL32(box.color.r, box.color.g, box.color.b, 255);
    const ImVec2 low(corner.x + scale * box.box.min_x, corner.y + scale * box.box.min_y);
    const ImVec2 high(corner.x + scale * box.box.max_x, corner.y + scale * box.box.max_y);
    canvas->AddRect(low, high, color, 0, 0, 1.5F);
    const ImVec2 text = ImGui::CalcTextSize(box.title.c_str());
    const ImVec2 plate(low.x, std::max(corner.y, low.y - text.y));
    canvas->AddRectFilled(plate, {plate.x + text.x + 4, plate.y + text.y},
                          IM_COL32(18, 21, 26, 200));
    canvas->AddText({plate.x + 2, plate.y}, IM_COL32(236, 238, 240, 255), box.title.c_str());
  }
  ImGui::TextDisabled("newest labelled keyframe, %zu objects", detections.boxes.size());
}

void SpeedPanel::Sample(const LiveStatus& status) {
  Append(static_cast<float>(status.frames_per_second), &frames_per_second_);
  Append(static_cast<float>(status.memory_megabytes), &memory_);
  queues_.resize(status.queues.size());
  for (std::size_t i = 0; i < queues_.size(); ++i)
    Append(static_cast<float>(status.queues[i].second), &queues_[i]);
}

float SpeedPanel::Draw(const LiveSource& source,
                       const LiveStatus& status,
                       float scale,
                       float window_width) {
  if (!status.is_paused && !status.has_ended) Sample(status);
  ImGui::SetNextWindowPos({window_width - 10 * scale, 10 * scale}, ImGuiCond_Always, {1, 0});
  ImGui::SetNextWindowSize({kSidePanelWidth * scale, 0}, ImGuiCond_Always);
  ImGui::Begin(
      "Speed", nullptr,
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  Plot("rate", frames_per_second_, WithNumber("frames", "%.1f/s", status.frames_per_second), scale);
  for (const LiveTiming& timing : source.timings()) {
    if (timing.milliseconds.empty()) continue;
    Plot(timing.name.c_str(), timing.milliseconds,
         WithNumber(timing.name, "%.1f ms", timing.milliseconds.back()), scale);
  }
  if (ImGui::CollapsingHeader("queues", ImGuiTreeNodeFlags_DefaultOpen)) {
    for (std::size_t i = 0; i < status.queues.size() && i < queues_.size(); ++i) {
      Plot(status.queues[i].first.c_str(), queues_[i],
           WithNumber(status.queues[i].first, "%.0f", static_cast<double>(status.queues[i].second)),
           scale);
    }
  }
  Plot("memory", memory_, WithNumber("memory", "%.0f MB", status.memory_megabytes), scale);
  const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
  ImGui::End();
  return bottom;
}

void SightingsPanel::Select(const LiveSource& source, const ObjectRecord* object) {
  const std::optional<std::uint32_t> id =
      object == nullptr ? std::nullopt : std::optional(object->id);
  if (id == object_) return;
  object_ = id;
  pictures_.clear();
  titles_.clear();
  if (object == nullptr) return;
  constexpr int kMaxWidth = 400;
  for (const LiveSighting& sighting : source.Sightings(*object)) {
    pictures_.push_back(std::make_unique<ImageTexture>());
    pictures_.back()->Set(sighting.color, kMaxWidth);
    titles_.push_back(sighting.title);
  }
}

void SightingsPanel::Draw(float width) const {
  constexpr int kColumns = 2;
  const float column = 0.5F * (width - ImGui::GetStyle().ItemSpacing.x);
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (i % kColumns != 0) ImGui::SameLine();
    ImGui::BeginGroup();
    ShowPicture(*pictures_[i], column);
    ImGui::TextDisabled("%s", titles_[i].c_str());
    ImGui::EndGroup();
  }
}

}  // namespace semslam
