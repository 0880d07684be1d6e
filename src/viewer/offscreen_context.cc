// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/offscreen_context.h"

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "semslam/base/error.h"

namespace semslam {
namespace {

std::string ErrorText() {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
  return text.data();
}

[[noreturn]] void Fail(const std::string& what) {
  throw InputError("no OpenGL 3.3 without a window: " + what + " (EGL error " + ErrorText() + ")");
}

bool HasClientExtension(const char* name) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return extensions != nullptr && std::strstr(extensions, name) != nullptr;
}

// Every display that needs no window system: Mesa's surfaceless one, then graphics cards.
std::vector<EGLDisplay> CandidateDisplays() {
  std::vector<EGLDisplay> displays;
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) return displays;
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  if (HasClientExtension("EGL_EXT_device_enumeration") && query_devices != nullptr) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE)
      count = 0;
    for (int i = 0; i < count; ++i) {
      displays.push_back(
          get_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    }
  }
  if (HasClientExtension("EGL_MESA_platform_surfaceless")) {
    displays.insert(displays.begin(),
                    get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  return displays;
}

EGLContext MakeContext(EGLDisplay display) {
  constexpr std::array<EGLint, 5> kConfig = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                             EGL_DONT_CARE, EGL_NONE};
  constexpr std::array<EGLint, 7> kContext = {EGL_CONTEXT_MAJOR_VERSION,
                                              3,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              3,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_NONE};
  EGLConfig config = nullptr;
  EGLint num_configs = 0;
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
      eglChooseConfig(display, kConfig.data(), &config, 1, &num_configs) == EGL_FALSE ||
      num_configs == 0)
    return EGL_NO_CONTEXT;
  return eglCreateContext(display, config, EGL_NO_CONTEXT, kContext.data());
}

}  // namespace

struct OffscreenContext::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  ~State() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
  }
};

OffscreenContext::OffscreenContext() {
  const std::vector<EGLDisplay> displays = CandidateDisplays();
  if (displays.empty()) Fail("EGL has no surfaceless platform");
  for (const EGLDisplay display : displays) {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
      continue;
    auto state = std::make_unique<State>();
    state->display = display;
    state->context = MakeContext(display);
    if (state->context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context) == EGL_FALSE)
      continue;
    state_ = std::move(state);
    return;
  }
  Fail("no display gives a context");
}

OffscreenContext::~OffscreenContext() = default;

}  // namespace semslam
