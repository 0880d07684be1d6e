# Installs libraries, headers and data, and a CMake package of them:
#   find_package(semslam REQUIRED)
#   target_link_libraries(mine PRIVATE semslam::semslam)   # or a single module, semslam::segmentation
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/semslam)
set(data_dir ${CMAKE_INSTALL_DATADIR}/semslam)
get_property(modules GLOBAL PROPERTY SEMSLAM_MODULE_TARGETS)

install(TARGETS ${modules} semslam EXPORT semslam-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT semslam-targets NAMESPACE semslam:: DESTINATION ${package_dir})
install(DIRECTORY include/semslam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY DESTINATION ${data_dir})
foreach(folder config Vocabulary)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${folder} DESTINATION ${data_dir} PATTERN "*.md" EXCLUDE)
  endif()
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# What a user of the static libraries must find again, read off what the modules link. Each line:
# a pattern of link names, and how to find the package that has them. @COMPONENTS@ becomes the
# names that matched, without the part before the last "::" or the given prefix.
set(semslam_packages
  "^Threads::|Threads"
  "^Eigen3::|Eigen3 3.4 NO_MODULE"
  "^TBB::|TBB"
  "^(Ceres::|ceres$)|Ceres 2.1"
  "^embree|embree 3"
  "^yaml-cpp|yaml-cpp"
  "^nlohmann_json::|nlohmann_json 3.10"
  "^OpenNI2::|OpenNI2"
  "^OpenGL::|OpenGL COMPONENTS @COMPONENTS@"
  "^glfw$|glfw3 3.3"
  "^ImGui::|ImGui"
  "^(Boost::headers|Boost::boost)$|Boost"
  "^Boost::|Boost COMPONENTS @COMPONENTS@"
  "^libjpeg-turbo::|libjpeg-turbo 2.1"
  "^liblzf::|liblzf 3.6"
  "^protobuf::|Protobuf 3.12"
  "^spng::|spng 0.7"
  "^opencv_|OpenCV 4.5 COMPONENTS @COMPONENTS@")

# Sets `result` to the plain names that the modules link from outside the project.
function(semslam_external_links result)
  set(names "")
  foreach(module IN LISTS ARGN)
    get_target_property(links ${module} INTERFACE_LINK_LIBRARIES)
    foreach(link IN LISTS links)
      if(link MATCHES "BUILD_INTERFACE")
        continue()
      endif()
      string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" link "${link}")
      if(link AND NOT link MATCHES "^semslam(::|_)")
        list(APPEND names ${link})
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES names)
  set(${result} ${names} PARENT_SCOPE)
endfunction()

# Sets `result` to the find_dependency lines for those names.
function(semslam_find_lines result)
  set(lines "")
  foreach(entry IN LISTS semslam_packages)
    string(REGEX MATCH "^(.*)\\|([^|]*)$" whole "${entry}")
    set(pattern "${CMAKE_MATCH_1}")
    set(call "${CMAKE_MATCH_2}")
    set(components "")
    foreach(name IN LISTS ARGN)
      if(name MATCHES "${pattern}")
        list(REMOVE_ITEM ARGN ${name})
        string(REGEX REPLACE "^(.*::|opencv_)" "" component ${name})
        list(APPEND components ${component})
      endif()
    endforeach()
    if(components)
      list(SORT components)
      list(JOIN components " " components)
      string(REPLACE "@COMPONENTS@" "${components}" call "${call}")
      string(APPEND lines "find_dependency(${call})\n")
    endif()
  endforeach()
  if(ARGN)
    message(FATAL_ERROR "cmake/SemslamInstall.cmake: no package is known for the linked ${ARGN}")
  endif()
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

semslam_external_links(names ${modules})
semslam_find_lines(SEMSLAM_FIND_DEPENDENCIES ${names})
configure_package_config_file(cmake/semslam-config.cmake.in ${PROJECT_BINARY_DIR}/semslam-config.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS data_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/semslam-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/semslam-config.cmake ${PROJECT_BINARY_DIR}/semslam-config-version.cmake
  DESTINATION ${package_dir})
install(FILES Thirdparty/cmake/FindImGui.cmake Thirdparty/cmake/FindOpenNI2.cmake
        Thirdparty/cmake/Findspng.cmake DESTINATION ${package_dir})
