# semslam_embed_scenes(OUTPUT file.cc FILES a.yaml ...): writes a source file that holds the texts of
# the scene files, for src/render/built_in_scenes.h. A changed file is written anew at the next build.
function(semslam_embed_scenes)
  cmake_parse_arguments(ARG "" "OUTPUT" "FILES" ${ARGN})
  set(entries "")
  foreach(file IN LISTS ARG_FILES)
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"scene(${text})scene\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  file(CONFIGURE OUTPUT ${ARG_OUTPUT} @ONLY CONTENT [[
// Written by cmake/SemslamEmbed.cmake.
#include "render/built_in_scenes.h"

namespace semslam {
namespace {

constexpr BuiltInScene kScenes[] = {
@entries@};

}  // namespace

std::span<const BuiltInScene> BuiltInScenes() { return kScenes; }

}  // namespace semslam
]])
endfunction()
