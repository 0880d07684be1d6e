// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/window.h"

#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr float kFontSize = 14;
constexpr float kClickPixels = 4;  // A mouse moved by more than this drags.

[[noreturn]] void Fail(const std::string& what) {
  const char* text = nullptr;
  glfwGetError(&text);
  std::string reason = text == nullptr ? "no reason given" : text;
  for (char& c : reason) c = c == '\n' ? ' ' : c;
  throw InputError("no window: " + what + ": " + reason);
}

}  // namespace

Window::Library::Library() {
  if (glfwInit() != GLFW_TRUE) Fail("GLFW does not start");
}

Window::Library::~Library() { glfwTerminate(); }

void Window::Destroy::operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }

Window::Window(const std::string& title, int width, int height) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  window_.reset(glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr));
  if (window_ == nullptr) Fail("no OpenGL 3.3");
  glfwMakeContextCurrent(window_.get());
  glfwSwapInterval(1);
  float scale_y = 1;
  glfwGetWindowContentScale(window_.get(), &scale_, &scale_y);
  scale_ = std::clamp(scale_, 1.0F, 4.0F);
  renderer_ = std::make_unique<Renderer>();
  gui_ = std::make_unique<Gui>(window_.get(), kFontSize * scale_);
}

Window::~Window() {
  gui_.reset();
  renderer_.reset();
  glfwMakeContextCurrent(nullptr);
}

bool Window::is_open() const { return glfwWindowShouldClose(window_.get()) == GLFW_FALSE; }

void Window::Begin(double max_wait_seconds) {
  if (max_wait_seconds > 0) {
    glfwWaitEventsTimeout(max_wait_seconds);
  } else {
    glfwPollEvents();
  }
  picture_.Restart();
  gui_->Begin(size());
}

std::optional<Eigen::Vector2d> Window::Steer(OrbitCamera* camera) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantCaptureMouse) {
    is_dragging_ = false;
    return std::nullopt;
  }
  constexpr double kRadiansPerPixel = 0.006;
  constexpr double kZoomPerStep = 0.88;
  const bool turns = ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClickPixels) && !io.KeyShift;
  const bool pans = ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0) ||
                    ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 0) ||
                    (ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClickPixels) && io.KeyShift);
  if (turns) {
    camera->Turn(-kRadiansPerPixel * io.MouseDelta.x, kRadiansPerPixel * io.MouseDelta.y);
  } else if (pans) {
    camera->Pan(io.MouseDelta.x, io.MouseDelta.y, static_cast<int>(io.DisplaySize.y));
  }
  if (io.MouseWheel != 0) camera->Zoom(std::pow(kZoomPerStep, io.MouseWheel));
  if (turns || pans || io.MouseWheel != 0) since_steering_.Restart();
  const bool was_dragging = is_dragging_;
  is_dragging_ = ImGui::IsMouseDown(ImGuiMouseButton_Left) && (is_dragging_ || turns || pans);
  if (was_dragging || !ImGui::IsMouseReleased(ImGuiMouseButton_Left)) return std::nullopt;
  return Eigen::Vector2d(io.MousePos.x * io.DisplayFramebufferScale.x,
                         io.MousePos.y * io.DisplayFramebufferScale.y);
}

void Window::End() {
  gui_->End();
  picture_seconds_ = picture_.Seconds();
  glfwSwapBuffers(window_.get());
}

Eigen::Vector2i Window::size() const {
  Eigen::Vector2i pixels;
  glfwGetFramebufferSize(window_.get(), &pixels.x(), &pixels.y());
  return pixels.cwiseMax(1);
}

bool Window::is_steering() const {
  constexpr double kSettled = 0.25;  // Seconds.
  return since_steering_.Seconds() < kSettled;
}

}  // namespace semslam
