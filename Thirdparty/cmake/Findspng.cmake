# Finds libspng, whose Debian package ships no CMake package.
#   spng::spng      the library and its headers
#   spng_FOUND, spng_VERSION
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_spng QUIET spng)
endif()

find_path(spng_INCLUDE_DIR NAMES spng.h HINTS ${PC_spng_INCLUDE_DIRS})
find_library(spng_LIBRARY NAMES spng HINTS ${PC_spng_LIBRARY_DIRS})
set(spng_VERSION ${PC_spng_VERSION})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(spng
  REQUIRED_VARS spng_LIBRARY spng_INCLUDE_DIR VERSION_VAR spng_VERSION)
if(spng_FOUND AND NOT TARGET spng::spng)
  add_library(spng::spng UNKNOWN IMPORTED)
  set_target_properties(spng::spng PROPERTIES
    IMPORTED_LOCATION ${spng_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${spng_INCLUDE_DIR})
endif()
mark_as_advanced(spng_INCLUDE_DIR spng_LIBRARY)
