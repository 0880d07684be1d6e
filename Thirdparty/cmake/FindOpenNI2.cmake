# Finds OpenNI2, which ships no CMake package.
#   OpenNI2::OpenNI2   the library and its headers
#   OpenNI2_FOUND, OpenNI2_VERSION
# OPENNI2_ROOT, as a variable or in the environment, is searched first.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_OpenNI2 QUIET libopenni2)
endif()

find_path(OpenNI2_INCLUDE_DIR NAMES OpenNI.h
  HINTS ${OPENNI2_ROOT} $ENV{OPENNI2_ROOT} ${PC_OpenNI2_INCLUDE_DIRS}
  PATH_SUFFIXES include/openni2 openni2 include Include)
find_library(OpenNI2_LIBRARY NAMES OpenNI2
  HINTS ${OPENNI2_ROOT} $ENV{OPENNI2_ROOT} ${PC_OpenNI2_LIBRARY_DIRS}
  PATH_SUFFIXES lib Redist)

set(OpenNI2_VERSION ${PC_OpenNI2_VERSION})
if(OpenNI2_INCLUDE_DIR AND NOT OpenNI2_VERSION AND EXISTS ${OpenNI2_INCLUDE_DIR}/OniVersion.h)
  file(STRINGS ${OpenNI2_INCLUDE_DIR}/OniVersion.h lines
    REGEX "#define ONI_VERSION_(MAJOR|MINOR|MAINTENANCE|BUILD)")
  set(numbers "")
  foreach(part MAJOR MINOR MAINTENANCE BUILD)
    if("${lines}" MATCHES "ONI_VERSION_${part}[ \t]+([0-9]+)")
      list(APPEND numbers ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(JOIN numbers "." OpenNI2_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenNI2
  REQUIRED_VARS OpenNI2_LIBRARY OpenNI2_INCLUDE_DIR VERSION_VAR OpenNI2_VERSION)
if(OpenNI2_FOUND AND NOT TARGET OpenNI2::OpenNI2)
  add_library(OpenNI2::OpenNI2 UNKNOWN IMPORTED)
  set_target_properties(OpenNI2::OpenNI2 PROPERTIES
    IMPORTED_LOCATION ${OpenNI2_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${OpenNI2_INCLUDE_DIR})
endif()
mark_as_advanced(OpenNI2_INCLUDE_DIR OpenNI2_LIBRARY)
