# How the softbody packages themselves are built. Nothing here reaches a package that does not call it.

# C++17, warnings, and an optimised build where no build type was chosen.
macro(softbody_build_settings)
  set(CMAKE_CXX_STANDARD 17)
  set(CMAKE_CXX_STANDARD_REQUIRED ON)
  set(CMAKE_CXX_EXTENSIONS OFF)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
  endif()
  add_compile_options(-Wall -Wextra)
  softbody_sanitize()
endmacro()

# SOFTBODY_SANITIZE=address,undefined or thread: instruments everything, with assertions switched on.
macro(softbody_sanitize)
  set(SOFTBODY_SANITIZE "" CACHE STRING "sanitizers of GCC: address,undefined or thread")
  if(SOFTBODY_SANITIZE)
    # -g1: line numbers are enough for a stack, and variables would need gigabytes.
    add_compile_options(-fsanitize=${SOFTBODY_SANITIZE} -fno-omit-frame-pointer -O1 -g1 -UNDEBUG
      -D_GLIBCXX_ASSERTIONS)
    add_link_options(-fsanitize=${SOFTBODY_SANITIZE})
  endif()
endmacro()

# The sources of a folder are compiled as one: what they include is read once. So names that are local to a source differ
# within its folder. CMAKE_UNITY_BUILD=OFF compiles each source alone. A source that Highway compiles once for each vector
# width stands alone, without precompiled headers: those would bring back the options that it switches off.
function(softbody_unite_folders target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(base ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    get_filename_component(source ${source} ABSOLUTE BASE_DIR ${base})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER "${folder}" group)
    file(STRINGS ${source} vector_widths REGEX foreach_target)
    string(COMPARE NOTEQUAL "${vector_widths}" "" alone)
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group}
      SKIP_UNITY_BUILD_INCLUSION ${alone} SKIP_PRECOMPILE_HEADERS ${alone})
  endforeach()
  if(NOT DEFINED CMAKE_UNITY_BUILD OR CMAKE_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  endif()
endfunction()

# softbody_sources(TARGET FOLDER...): adds all sources of these folders of the package, without their subfolders and
# without what nodes have as main programs (NAME_main.cpp).
function(softbody_sources target)
  foreach(folder IN LISTS ARGN)
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
    list(FILTER sources EXCLUDE REGEX "_main\\.cpp$")
    if(NOT sources)
      message(FATAL_ERROR "${target}: no sources in ${PROJECT_SOURCE_DIR}/${folder}")
    endif()
    target_sources(${target} PRIVATE ${sources})
  endforeach()
endfunction()

# softbody_unite_folders for a target that gets its sources later.
function(softbody_unite_folders_later target)
  cmake_language(EVAL CODE "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]] CALL softbody_unite_folders ${target})")
endfunction()

# The headers from outside that most sources include are read once, for this target and for all that reuse them
# (REUSE_FROM) with the same compile options. Every source still includes what it uses:
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
function(softbody_precompile_headers target)
  target_precompile_headers(${target} PRIVATE <Eigen/Dense> <algorithm> <fmt/format.h> <functional> <map> <memory>
    <opencv2/core.hpp> <optional> <string> <unordered_map> <vector> ${ARGN})
endfunction()

# softbody_core_library(TARGET NAME [LIBRARY]): a library without ROS, which other packages link as softbody::NAME.
# softbody_sources gives it its sources. It reuses the precompiled headers of LIBRARY, which has the same
# compile options and no other macros.
function(softbody_core_library target name)
  add_library(${target})
  add_library(softbody::${name} ALIAS ${target})
  # Precompiled headers are reused only by targets with the same macros, so none for the target itself (DEFINE_SYMBOL).
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} DEFINE_SYMBOL "")
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src/core)
  if(ARGC GREATER 2)
    target_precompile_headers(${target} REUSE_FROM ${ARGV2})
  else()
    softbody_precompile_headers(${target})
  endif()
  softbody_unite_folders_later(${target})
  install(TARGETS ${target} EXPORT ${PROJECT_NAME}-targets
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

# softbody_ros_library(TARGET LIBRARY...): a library that may use ROS, with the libraries it builds on. If the first one is
# such a library of the same package, its precompiled headers are reused.
function(softbody_ros_library target)
  add_library(${target})
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "")
  add_dependencies(${target} ${catkin_EXPORTED_TARGETS})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src
    ${PROJECT_SOURCE_DIR}/src/core)
  target_include_directories(${target} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
  target_link_libraries(${target} PUBLIC ${ARGN} ${catkin_LIBRARIES} PRIVATE fmt::fmt)
  get_property(ros_libraries GLOBAL PROPERTY softbody_ros_libraries)
  if(ARGV1 IN_LIST ros_libraries)
    target_precompile_headers(${target} REUSE_FROM ${ARGV1})
  else()
    softbody_precompile_headers(${target} <ros/ros.h>)
  endif()
  set_property(GLOBAL APPEND PROPERTY softbody_ros_libraries ${target})
  softbody_unite_folders_later(${target})
  install(TARGETS ${target}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

# softbody_program(NAME SOURCE LIBRARY...): an installed executable. It knows its package and version.
function(softbody_program name source)
  add_executable(${name} ${source})
  softbody_tell_version(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/src/core)
  target_link_libraries(${name} ${ARGN})
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()

# Tells a program, which links softbody::common, the name and version in its package.xml.
function(softbody_tell_version program)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/package_version.cpp)
  set(version ${${PROJECT_NAME}_VERSION})
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include "softbody_common/tools/package_version.h"
static const bool told = softbody::setPackageVersion("@PROJECT_NAME@ @version@");
]])
  target_sources(${program} PRIVATE ${source})
endfunction()

# softbody_development_program(NAME SOURCE...): an executable for make targets, not installed. The caller links it. It is
# where rosrun, which completes the names of programs, does not look. The targets `development` and `tests` build it.
function(softbody_development_program name)
  add_executable(${name} EXCLUDE_FROM_ALL ${ARGN})
  if(NOT TARGET development)
    add_custom_target(development)
  endif()
  add_dependencies(development ${name})
  if(TARGET tests)
    add_dependencies(tests ${name})
  endif()
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib/development/${PROJECT_NAME})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/test
    ${PROJECT_SOURCE_DIR}/src/core ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
endfunction()

# Writes the core libraries' targets for packages that find this one, in the devel and the install space.
macro(softbody_export_core_libraries)
  export(EXPORT ${PROJECT_NAME}-targets NAMESPACE softbody::
    FILE ${CATKIN_DEVEL_PREFIX}/share/${PROJECT_NAME}/cmake/${PROJECT_NAME}-targets.cmake)
  install(EXPORT ${PROJECT_NAME}-targets NAMESPACE softbody::
    DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
endmacro()

# softbody_test_headers(TARGET): what all tests of a package include is read once. Tests are compiled fast: what takes
# time in them are the libraries that they test.
function(softbody_test_headers target)
  # The macro that catkin defines for every gtest.
  set(options $<$<CONFIG:Release>:-O1> -DGTEST_HAS_PTHREAD=1)
  set(headers ${PROJECT_NAME}_test_headers)
  if(NOT TARGET ${headers})
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${headers}.cpp CONTENT "")
    add_library(${headers} OBJECT ${PROJECT_BINARY_DIR}/${headers}.cpp)
    set_target_properties(${headers} PROPERTIES EXCLUDE_FROM_ALL ON)
    target_compile_options(${headers} PRIVATE ${options})
    target_link_libraries(${headers} softbody::common fmt::fmt gtest)
    softbody_precompile_headers(${headers} <gtest/gtest.h>)
  endif()
  target_compile_options(${target} PRIVATE ${options})
  target_link_libraries(${target} fmt::fmt)
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()

# softbody_gtest(NAME PLACE...): one test program from source files, and from all sources of folders, linked to
# ${test_libraries}. It finds <test_support/...>, which the tests of all packages share.
function(softbody_gtest name)
  set(sources "")
  foreach(place IN LISTS ARGN)
    if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${place})
      file(GLOB place CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${place}/*.cpp)
    endif()
    list(APPEND sources ${place})
  endforeach()
  catkin_add_gtest(${name} ${sources})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test ${PROJECT_SOURCE_DIR}/src
    ${PROJECT_SOURCE_DIR}/src/core ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  target_compile_definitions(${name} PRIVATE ${test_definitions})
  target_link_libraries(${name} ${test_libraries} gtest_main)
  softbody_test_headers(${name})
  softbody_unite_folders(${name})
endfunction()

# softbody_rostests(FOLDER [NAME...]): all rostests of a folder, without the named ones, which want more than their file.
function(softbody_rostests folder)
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.test)
  foreach(test IN LISTS tests)
    get_filename_component(name ${test} NAME_WE)
    if(NOT name IN_LIST ARGN)
      add_rostest(${test})
    endif()
  endforeach()
endfunction()
