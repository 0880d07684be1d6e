set(SEMSLAM_VIEWER AUTO CACHE STRING
  "Window and pictures of the map by OpenGL: AUTO (if its packages are here), ON (they must be), OFF")
set_property(CACHE SEMSLAM_VIEWER PROPERTY STRINGS AUTO ON OFF)

# Sets `result` to whether the viewer is to be built, and finds what it needs.
macro(semslam_find_viewer result)
  set(${result} FALSE)
  if(SEMSLAM_VIEWER STREQUAL "OFF")
    message(STATUS "SEMSLAM_VIEWER is OFF: no view_map, no --viewer")
  else()
    find_package(OpenGL COMPONENTS OpenGL EGL)
    find_package(glfw3 3.3 QUIET)
    find_package(ImGui 1.86)
    if(OpenGL_FOUND AND glfw3_FOUND AND ImGui_FOUND)
      set(${result} TRUE)
    elseif(SEMSLAM_VIEWER STREQUAL "AUTO")
      message(STATUS "Packages of the viewer are missing (libegl-dev, libopengl-dev, libglfw3-dev, "
        "libimgui-dev): no view_map, no --viewer")
    else()
      message(FATAL_ERROR "SEMSLAM_VIEWER is ON, and packages of the viewer are missing: "
        "libegl-dev, libopengl-dev, libglfw3-dev, libimgui-dev")
    endif()
  endif()
endmacro()
