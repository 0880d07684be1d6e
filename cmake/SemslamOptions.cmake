# Options, output folders and the flags that every target of this project shares.
include(CTest)
include(GNUInstallDirs)

option(SEMSLAM_FILL_MATRICES_WITH_NAN "Initialise Eigen matrices with NaN, so that unset values show" OFF)
option(SEMSLAM_TIDY "Run clang-tidy on every own file" OFF)
set(SEMSLAM_SANITIZE "" CACHE STRING "Value for -fsanitize, for example address,undefined")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set_property(GLOBAL PROPERTY GLOBAL_DEPENDS_NO_CYCLES ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
if(SEMSLAM_TIDY)
  find_program(CLANG_TIDY_PROGRAM NAMES clang-tidy-14 clang-tidy REQUIRED)
endif()

find_package(Threads REQUIRED)

# Flags for own code only: they must not reach anyone who links the library.
add_library(semslam_flags INTERFACE)
target_compile_options(semslam_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  # A false alarm of optimised std::string concatenation (GCC bug 105651).
  target_compile_options(semslam_flags INTERFACE -Wno-restrict)
endif()
if(SEMSLAM_FILL_MATRICES_WITH_NAN)
  target_compile_definitions(semslam_flags INTERFACE EIGEN_INITIALIZE_MATRICES_BY_NAN)
endif()
if(SEMSLAM_SANITIZE)
  add_compile_options(-fsanitize=${SEMSLAM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if(SEMSLAM_SANITIZE MATCHES undefined)
    # A third of the compile time, for what the address sanitizer sees too once it does harm.
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
  endif()
  add_link_options(-fsanitize=${SEMSLAM_SANITIZE})
endif()
