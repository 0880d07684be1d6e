// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/gui.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include "semslam/base/error.h"

namespace semslam {
namespace {

// Fonts that Debian installs with OpenCV's own dependencies; ImGui's small one if there is none.
void AddFont(float size) {
  constexpr std::array<const char*, 3> kFiles = {
      "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
      "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
      "/usr/share/fonts/truetype/freefont/FreeSans.ttf"};
  ImFontAtlas* fonts = ImGui::GetIO().Fonts;
  for (const char* file : kFiles) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    if (fonts->AddFontFromFileTTF(file, size) != nullptr) return;
  }
  ImFontConfig config;
  config.SizePixels = size;
  fonts->AddFontDefault(&config);
}

void SetStyle() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 5;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.WindowPadding = {10, 8};
  style.ItemSpacing = {8, 5};
  style.Colors[ImGuiCol_WindowBg] = {0.09F, 0.105F, 0.13F, 0.90F};
  style.Colors[ImGuiCol_TitleBg] = {0.09F, 0.105F, 0.13F, 0.95F};
  style.Colors[ImGuiCol_TitleBgActive] = {0.13F, 0.16F, 0.21F, 0.95F};
  style.Colors[ImGuiCol_PlotLines] = {0.45F, 0.74F, 1.0F, 1.0F};
}

ImU32 ToColor(Rgb color, float alpha = 1) {
  return IM_COL32(color.r, color.g, color.b, static_cast<int>(255 * alpha));
}

bool Overlap(const Plate& a, const Plate& b) {
  return (a.low.array() < b.high.array()).all() && (b.low.array() < a.high.array()).all();
}

// The plate itself, or moved up or down until it covers no other, if that is possible.
Plate Place(const Plate& plate, const std::vector<Plate>& taken, float height) {
  for (float shift = 0; shift < 0.5F * height; shift += 4) {
    for (const float sign : {-1.0F, 1.0F}) {
      Plate moved = plate;
      moved.low.y() += sign * shift;
      moved.high.y() += sign * shift;
      const bool is_inside = moved.low.y() >= 0 && moved.high.y() <= height;
      const bool is_free = std::none_of(taken.begin(), taken.end(),
                                        [&](const Plate& other) { return Overlap(moved, other); });
      if (is_inside && is_free) return moved;
    }
  }
  return plate;
}

}  // namespace

Gui::Gui(GLFWwindow* window, float font_size) : window_(window), context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().IniFilename = nullptr;  // Writes no files into the user's folder.
  SetStyle();
  AddFont(font_size);
  const bool has_window = window == nullptr || ImGui_ImplGlfw_InitForOpenGL(window, true);
  if (has_window && ImGui_ImplOpenGL3_Init("#version 330 core")) return;
  ImGui::DestroyContext(context_);
  throw InputError("Dear ImGui finds no OpenGL (libGL.so.1)");
}

Gui::~Gui() {
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_Shutdown();
  if (window_ != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
}

void Gui::Begin(const Eigen::Vector2i& pixels) {
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_NewFrame();
  if (window_ != nullptr) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    ImGui::GetIO().DisplaySize = {static_cast<float>(pixels.x()), static_cast<float>(pixels.y())};
  }
  ImGui::NewFrame();
}

void Gui::End() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

ImDrawList* Gui::background() { return ImGui::GetBackgroundDrawList(); }

std::vector<Plate> DrawLabels(ImDrawList* canvas,
                              const ViewCamera& camera,
                              std::span<const DrawList::Label> labels,
                              float scale) {
  constexpr ImU32 kPlateColor = IM_COL32(18, 21, 26, 225);
  constexpr ImU32 kTextColor = IM_COL32(236, 238, 240, 255);
  const float margin = 5 * scale;
  const Eigen::Vector2f size(static_cast<float>(camera.width), static_cast<float>(camera.height));
  std::vector<Plate> plates;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const DrawList::Label& label = labels[i];
    const Eigen::Vector3f p_camera = camera.ToCamera(label.p_world.cast<float>());
    if (!(p_camera.z() > 0.02F)) continue;
    const Eigen::Vector2f place = camera.Project(p_camera);
    if ((place.array() < 0).any() || (place.array() > size.array()).any()) continue;
    const ImVec2 text = ImGui::CalcTextSize(label.text.c_str());
    const Eigen::Vector2f half(0.5F * text.x + 1.6F * margin, 0.5F * text.y + 0.5F * margin);
    // Just above its place.
    const Eigen::Vector2f middle(place.x(), place.y() - half.y());
    const Plate plate = Place({i, middle - half, middle + half}, plates, size.y());
    plates.push_back(plate);
    const ImVec2 low(plate.low.x(), plate.low.y());
    const ImVec2 high(plate.high.x(), plate.high.y());
    const float moved = 0.5F * (low.y + high.y) - middle.y();
    if (std::abs(moved) > half.y()) {
      canvas->AddLine({place.x(), place.y()}, {place.x(), moved > 0 ? low.y : high.y},
                      ToColor(label.color, 0.8F), scale);
    }
    canvas->AddRectFilled(low, high, kPlateColor, 4 * scale);
    canvas->AddRect(low, high, ToColor(label.color), 4 * scale, 0,
                    (label.is_selected ? 2.5F : 1.2F) * scale);
    canvas->AddText({low.x + 1.6F * margin, low.y + 0.5F * margin}, kTextColor, label.text.c_str());
  }
  return plates;
}

void DrawLegend(ImDrawList* canvas,
                const ViewCamera& camera,
                const std::vector<std::pair<std::string, Rgb>>& entries,
                float scale) {
  if (entries.empty()) return;
  const float margin = 12 * scale;
  const float row = 1.35F * ImGui::GetFontSize();
  const float swatch = 0.8F * ImGui::GetFontSize();
  float width = 0;
  for (const auto& [name, color] : entries)
    width = std::max(width, ImGui::CalcTextSize(name.c_str()).x);
  const float height = row * static_cast<float>(entries.size());
  const ImVec2 corner(margin, static_cast<float>(camera.height) - margin - height - margin);
  canvas->AddRectFilled(corner,
                        {corner.x + width + swatch + 2.6F * margin, corner.y + height + margin},
                        IM_COL32(18, 21, 26, 205), 5 * scale);
  float y = corner.y + 0.5F * margin;
  for (const auto& [name, color] : entries) {
    const float top = y + 0.5F * (row - swatch);
    canvas->AddRectFilled({corner.x + 0.8F * margin, top},
                          {corner.x + 0.8F * margin + swatch, top + swatch}, ToColor(color),
                          2 * scale);
    canvas->AddText({corner.x + 1.6F * margin + swatch, y + 0.5F * (row - ImGui::GetFontSize())},
                    IM_COL32(228, 230, 233, 255), name.c_str());
    y += row;
  }
}

}  // namespace semslam
