# semslam_embed_texts(OUTPUT file.cc HEADER header.h FUNCTION function NAMES NAME|NAME_WE
#                     FILES a.yaml ...)
# Writes a source file that holds the texts of files, each as an EmbeddedText of name (with or
# without ending) and text; `function`, declared in the header, gives them as a span in that order. A changed
# file is written anew at the next build.
function(semslam_embed_texts)
  cmake_parse_arguments(ARG "" "OUTPUT;HEADER;FUNCTION;NAMES" "FILES" ${ARGN})
  set(entries "")
  foreach(file IN LISTS ARG_FILES)
    get_filename_component(name ${file} ${ARG_NAMES})
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  file(CONFIGURE OUTPUT ${ARG_OUTPUT} @ONLY CONTENT [[
// Written by cmake/SemslamEmbed.cmake.
#include "@ARG_HEADER@"

namespace semslam {
namespace {

constexpr EmbeddedText kTexts[] = {
@entries@};

}  // namespace

std::span<const EmbeddedText> @ARG_FUNCTION@() { return kTexts; }

}  // namespace semslam
]])
endfunction()
