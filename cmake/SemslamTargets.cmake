# semslam_add_module(NAME SOURCES file.cc ... DEPENDS targets ... PRIVATE_DEPENDS targets ...)
# One static library a module. Sources are relative to src/NAME; headers are in include/semslam/NAME.
# DEPENDS is what its headers need, PRIVATE_DEPENDS what only its sources need; the layer check reads both.
function(semslam_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target semslam_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(semslam::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS}
                        $<BUILD_INTERFACE:semslam_flags>)
  semslam_enable_tidy(${target})
  set_property(GLOBAL APPEND PROPERTY SEMSLAM_MODULE_TARGETS ${target})
endfunction()

# The one target users link: every module.
function(semslam_add_umbrella)
  get_property(targets GLOBAL PROPERTY SEMSLAM_MODULE_TARGETS)
  add_library(semslam INTERFACE)
  add_library(semslam::semslam ALIAS semslam)
  target_link_libraries(semslam INTERFACE ${targets})
endfunction()

# semslam_add_program(NAME SOURCES file.cc ... DEPENDS targets ...): a program in bin/, installed.
function(semslam_add_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/Examples)
  target_compile_definitions(${name} PRIVATE SEMSLAM_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} semslam_flags)
  semslam_enable_tidy(${name})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# semslam_add_tests(NAME SOURCES file_test.cc ... DEPENDS targets ... [LABELS unit] [TIMEOUT 60]
#                   [WHOLE])
# One test program of GoogleTest cases; each case is a ctest test, or with WHOLE the program is one:
# where the cases share something costly. One label: unit, threads (also run under the thread
# sanitizer), integration, dataset (needs real clips).
function(semslam_add_tests name)
  cmake_parse_arguments(ARG "WHOLE" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PRIVATE SEMSLAM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} semslam_flags GTest::gmock GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/test)
  # What measures time or takes all cores runs alone; the rest may run side by side.
  set(serial TRUE)
  if(ARG_LABELS MATCHES "^(unit|threads)$")
    set(serial FALSE)
  endif()
  if(SEMSLAM_SANITIZE)
    # Halves of programs: a sanitized process needs about a second to start, too much for each of a
    # thousand cases.
    foreach(shard 0 1)
      add_test(NAME ${name}_${shard} COMMAND ${name})
      set_tests_properties(${name}_${shard} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 600
        ENVIRONMENT "GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=${shard}")
    endforeach()
  elseif(ARG_WHOLE)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
      RUN_SERIAL ${serial})
  else()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT} RUN_SERIAL ${serial})
  endif()
  semslam_collect_sanitized_tests(${name} ${ARG_LABELS})
endfunction()

# The targets that scripts/sanitize.sh builds: the test programs that fit each sanitizer.
function(semslam_collect_sanitized_tests name label)
  foreach(target semslam_asan_tests semslam_tsan_tests)
    if(NOT TARGET ${target})
      add_custom_target(${target})
    endif()
  endforeach()
  if(label MATCHES "^(unit|threads)$")
    add_dependencies(semslam_asan_tests ${name})
  endif()
  if(label STREQUAL "threads")
    add_dependencies(semslam_tsan_tests ${name})
  endif()
endfunction()

function(semslam_enable_tidy target)
  if(SEMSLAM_TIDY)
    set_target_properties(${target} PROPERTIES
      CXX_CLANG_TIDY "${CLANG_TIDY_PROGRAM};--quiet;--extra-arg=-Wno-unknown-warning-option")
  endif()
endfunction()
