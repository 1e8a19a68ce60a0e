# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT

add_library(motex_build_flags INTERFACE)
# Contraction off: gcc and clang must give the same bytes for the same seed.
target_compile_options(motex_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror -ffp-contract=off -fPIC)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # False alarms of g++ 12 inside Eigen and std::string at -O3.
  target_compile_options(motex_build_flags INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow
                         -Wno-stringop-overread -Wno-restrict)
endif()

# motex_module(name PUBLIC deps... PRIVATE deps...)
#   src/motex/<name>/*.cpp       -> motex_<name>, alias motex::<name>
#   src/motex/<name>/*_test.cpp  -> motex_<name>_test, registered with CTest
function(motex_module name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  set(dir ${PROJECT_SOURCE_DIR}/src/motex/${name})
  file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  set(target motex_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:motex_build_flags>)
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)
    target_compile_features(${target} PUBLIC cxx_std_20)
    motex_precompile(${target})
  else()
    add_library(${target} INTERFACE)
    target_compile_features(${target} INTERFACE cxx_std_20)
    target_link_libraries(${target} INTERFACE ${arg_PUBLIC})
    target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(motex::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY MOTEX_MODULES ${name})
  if(MOTEX_BUILD_TESTS AND tests)
    add_executable(${target}_test ${tests})
    target_link_libraries(${target}_test PRIVATE ${target} motex_build_flags GTest::gtest_main)
    target_compile_definitions(${target}_test PRIVATE MOTEX_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
    motex_precompile(${target}_test)
    gtest_discover_tests(${target}_test DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 600 TEST_PREFIX ${name}.)
  endif()
endfunction()

# Eigen costs seconds in every translation unit; one precompiled header serves all modules.
function(motex_precompile target)
  if(NOT MOTEX_PCH)
    return()
  elseif(target STREQUAL "motex_core")
    target_precompile_headers(motex_core PRIVATE <Eigen/Core> <Eigen/Geometry> <algorithm> <cmath> <functional> <string>
                              <vector> <stdexcept>)
  else()
    target_precompile_headers(${target} REUSE_FROM motex_core)
  endif()
endfunction()
