// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/panels.h"

#include <array>
#include <cstdio>
#include <utility>

#include <imgui.h>

#include "semslam/viewer/picture.h"

namespace semslam {
namespace {

template <typename... Values>
std::string Line(const char* format, Values... values) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

bool ChooseColors(ColorMode* color) {
  constexpr std::array<std::pair<const char*, ColorMode>, 4> kModes = {
      {{"photo", ColorMode::kPhoto},
       {"segments", ColorMode::kSegments},
       {"classes", ColorMode::kClasses},
       {"height", ColorMode::kHeight}}};
  bool has_changed = false;
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(kModes[i].first, *color == kModes[i].second)) {
      has_changed = *color != kModes[i].second;
      *color = kModes[i].second;
    }
  }
  return has_changed;
}

bool ChooseViewpoint(OrbitCamera* camera) {
  constexpr std::array<std::pair<const char*, Viewpoint>, 6> kViewpoints = {
      {{"view", Viewpoint::kPerspective},
       {"top", Viewpoint::kTop},
       {"front", Viewpoint::kFront},
       {"back", Viewpoint::kBack},
       {"left", Viewpoint::kLeft},
       {"right", Viewpoint::kRight}}};
  bool is_chosen = false;
  for (std::size_t i = 0; i < kViewpoints.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    if (!ImGui::SmallButton(kViewpoints[i].first)) continue;
    const ViewDirection direction = DirectionOf(kViewpoints[i].second);
    camera->SetDirection(direction.azimuth, direction.elevation);
    is_chosen = true;
  }
  return is_chosen;
}

bool ChooseObject(std::span<const ObjectRecord> objects,
                  std::span<const ClassRecord> classes,
                  std::optional<std::uint32_t>* selected) {
  bool has_changed = false;
  for (const ObjectRecord& object : objects) {
    const Rgb color = ObjectColor(object, classes);
    ImGui::PushID(static_cast<int>(object.id));
    ImGui::ColorButton("##color",
                       {static_cast<float>(color.r) / 255.0F, static_cast<float>(color.g) / 255.0F,
                        static_cast<float>(color.b) / 255.0F, 1.0F},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder,
                       {0.8F * ImGui::GetFontSize(), 0.8F * ImGui::GetFontSize()});
    ImGui::SameLine();
    const bool is_selected = *selected == object.id;
    if (ImGui::Selectable(ObjectTitle(object, classes).c_str(), is_selected)) {
      *selected = is_selected ? std::nullopt : std::optional(object.id);
      has_changed = true;
    }
    ImGui::PopID();
  }
  return has_changed;
}

void TellObject(const ObjectRecord& object, std::span<const ClassRecord> classes) {
  const Eigen::Vector3d size = 2 * object.box.half_size;
  ImGui::Text("%s", ObjectTitle(object, classes).c_str());
  if (!ImGui::BeginTable("facts", 2)) return;
  TellFact("id", Line("%u", object.id));
  TellFact("seen in", Line("%llu keyframes", static_cast<unsigned long long>(object.num_views)));
  TellFact("points", Line("%llu", static_cast<unsigned long long>(object.num_points)));
  TellFact("size", Line("%.2f x %.2f x %.2f m", size.x(), size.y(), size.z()));
  TellFact("centre",
           Line("%.2f %.2f %.2f m", object.centroid.x(), object.centroid.y(), object.centroid.z()));
  ImGui::EndTable();
}

void TellFact(const char* name, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value.c_str());
}

}  // namespace semslam
