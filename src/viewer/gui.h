// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "semslam/io/view_camera.h"
#include "semslam/viewer/draw_list.h"

struct GLFWwindow;
struct ImDrawList;
struct ImGuiContext;

namespace semslam {

// Dear ImGui over OpenGL, with a window or without. Belongs to the thread of the OpenGL context,
// and there must be one at a time in a process: ImGui keeps the present one in a global.
class Gui {
 public:
  // `window` may be null. Text is of this height. Throws InputError if OpenGL does not take it.
  Gui(GLFWwindow* window, float font_size);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // What is drawn between the two ends up in the framebuffer that is bound at the end. `pixels` is
  // the size of a picture without a window.
  void Begin(const Eigen::Vector2i& pixels);
  void End();
  // Below all panels.
  ImDrawList* background();

 private:
  GLFWwindow* window_;
  ImGuiContext* context_;
};

// A name plate in the picture, in pixels from the top left.
struct Plate {
  std::size_t label = 0;  // Place in the draw list.
  Eigen::Vector2f low;
  Eigen::Vector2f high;
};

// Writes the labels on plates near their places, as far as possible beside each other; those
// behind the camera or outside the picture are left out. In a picture, `scale` enlarges them.
std::vector<Plate> DrawLabels(ImDrawList* canvas,
                              const ViewCamera& camera,
                              std::span<const DrawList::Label> labels,
                              float scale);

// A list of colours with their names in the lower left corner of a picture.
void DrawLegend(ImDrawList* canvas,
                const ViewCamera& camera,
                const std::vector<std::pair<std::string, Rgb>>& entries,
                float scale);

}  // namespace semslam
