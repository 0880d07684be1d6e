// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "semslam/base/stopwatch.h"
#include "semslam/viewer/orbit_camera.h"
#include "semslam/viewer/renderer.h"

#include "viewer/gui.h"

struct GLFWwindow;

namespace semslam {

// A window with OpenGL, panels and a mouse that steers a camera. Belongs to one thread, and there
// is one in a process at a time.
class Window {
 public:
  // Throws InputError if there is no screen, or no OpenGL 3.3.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Nobody asked to close it.
  bool is_open() const;
  // Takes what keyboard and mouse did, at once or, with nothing to take, after so many seconds;
  // then panels may be drawn.
  void Begin(double max_wait_seconds);
  // Turns, moves and zooms by the mouse where it is on no panel. Where it was clicked, in pixels of
  // the picture.
  std::optional<Eigen::Vector2d> Steer(OrbitCamera* camera);
  // Panels over what was drawn, and all onto the screen.
  void End();

  // Of the picture, pixels; at least 1.
  Eigen::Vector2i size() const;
  // Pixels of the picture in a unit of panels: more than 1 on fine screens.
  float scale() const { return scale_; }
  // A mouse button is down, or the camera has just been moved.
  bool is_steering() const;
  // Seconds that the last picture took, without waiting.
  double picture_seconds() const { return picture_seconds_; }

  Renderer& renderer() { return *renderer_; }
  Gui& gui() { return *gui_; }

 private:
  // What GLFW needs, in the order in which it comes and goes.
  struct Library {
    Library();
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
  };
  struct Destroy {
    void operator()(GLFWwindow* window) const;
  };

  Library library_;
  std::unique_ptr<GLFWwindow, Destroy> window_;
  float scale_ = 1;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<Gui> gui_;
  bool is_dragging_ = false;
  Stopwatch since_steering_;
  Stopwatch picture_;
  double picture_seconds_ = 0;
};

}  // namespace semslam
