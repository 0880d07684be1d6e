# Installs the build in BUILD_DIR to a prefix of its own, builds this folder's project against it in
# WORK_DIR, and runs that.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: exit code ${code}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
# Found there as by a user of the installed package: nothing of the source or build tree may leak.
file(GLOB exported ${WORK_DIR}/prefix/lib*/cmake/semslam/*.cmake
  ${WORK_DIR}/prefix/lib*/*/cmake/semslam/*.cmake)
if(NOT exported)
  message(FATAL_ERROR "no package files under ${WORK_DIR}/prefix")
endif()
foreach(file IN LISTS exported)
  file(STRINGS ${file} leaks REGEX "semslam_flags|${SOURCE_DIR}/(src|include)")
  if(leaks)
    message(FATAL_ERROR "${file}: ${leaks}")
  endif()
endforeach()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
if(NOT output STREQUAL "3.000\n")
  message(FATAL_ERROR "expected 3.000, found ${output}")
endif()
