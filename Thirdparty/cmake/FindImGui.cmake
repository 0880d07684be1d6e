# Finds Dear ImGui as Debian has it: one static library with its back ends for GLFW and OpenGL 3.
#   ImGui::ImGui   the library and its headers
#   ImGui_FOUND, ImGui_VERSION
# IMGUI_ROOT, as a variable or in the environment, is searched first.
find_path(ImGui_INCLUDE_DIR NAMES imgui.h
  HINTS ${IMGUI_ROOT} $ENV{IMGUI_ROOT} PATH_SUFFIXES include/imgui imgui)
find_path(ImGui_BACKENDS_DIR NAMES imgui_impl_opengl3.h
  HINTS ${ImGui_INCLUDE_DIR} PATH_SUFFIXES backends)
find_library(ImGui_LIBRARY NAMES imgui HINTS ${IMGUI_ROOT} $ENV{IMGUI_ROOT} PATH_SUFFIXES lib)
# Fonts: Debian's ImGui has these in a library of their own, that of libstb-dev.
find_library(ImGui_STB_LIBRARY NAMES stb)
if(ImGui_INCLUDE_DIR)
  file(STRINGS ${ImGui_INCLUDE_DIR}/imgui.h line REGEX "#define IMGUI_VERSION +\"")
  if("${line}" MATCHES "\"([0-9.]+)")
    set(ImGui_VERSION ${CMAKE_MATCH_1})
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ImGui
  REQUIRED_VARS ImGui_LIBRARY ImGui_INCLUDE_DIR ImGui_BACKENDS_DIR VERSION_VAR ImGui_VERSION)
if(ImGui_FOUND AND NOT TARGET ImGui::ImGui)
  add_library(ImGui::ImGui STATIC IMPORTED)
  set_target_properties(ImGui::ImGui PROPERTIES IMPORTED_LOCATION ${ImGui_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${ImGui_INCLUDE_DIR};${ImGui_BACKENDS_DIR}"
    INTERFACE_LINK_LIBRARIES "${CMAKE_DL_LIBS};glfw")
  if(ImGui_STB_LIBRARY)
    set_property(TARGET ImGui::ImGui APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${ImGui_STB_LIBRARY})
  endif()
endif()
mark_as_advanced(ImGui_INCLUDE_DIR ImGui_BACKENDS_DIR ImGui_LIBRARY ImGui_STB_LIBRARY)
