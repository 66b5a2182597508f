# SPDX-License-Identifier: Apache-2.0
# What makes a first build short: the headers that nearly every source reads are compiled once, and a module's sources
# are compiled in batches. docs/performance.md has the times; tests/rebuilt builds without both and compares digests.

option(RODEIRA_UNITY "Compile the sources of a module in batches" ON)
option(RODEIRA_PCH "Precompile the headers that nearly every source reads" ON)

# Sources a batch, at most. A changed source compiles its batch again. A change in these two groups compiles much of
# what lies above them, too: their batches are smaller, so that a test of the changed source runs sooner.
set(RODEIRA_BATCH 16 CACHE STRING "Sources a batch, at most")
set(RODEIRA_SMALL_BATCH 10 CACHE STRING "The same in common/core and common/world")
set(RODEIRA_SMALL_BATCH_GROUPS "^${CMAKE_SOURCE_DIR}/common/(core|world)/")

# GCC collects garbage only beyond this many kilobytes: 4 % less processor time, 130 MB more memory a compiler.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("SHELL:--param ggc-min-heapsize=1048576")
endif()

# Creates an object library whose precompiled header other targets share.
function(rodeira_add_pch name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/pch/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/pch/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  target_compile_options(${name} PRIVATE ${RODEIRA_WARNINGS} ${RODEIRA_PCH_WARNINGS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# Of a precompiled header GCC 12 no longer knows that its parts are the system's, so that its false alarms about
# std::string in them (its bug 105329) would be errors.
set(RODEIRA_PCH_WARNINGS)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(RODEIRA_PCH_WARNINGS -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict)
endif()

if(RODEIRA_PCH AND NOT RODEIRA_FUZZ)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
  set(headers <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <set>
      <span> <string> <string_view> <tuple> <unordered_map> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry>
      <fmt/format.h>)
  rodeira_add_pch(rodeira_pch HEADERS ${headers} LINK Eigen3::Eigen fmt::fmt)
  if(RODEIRA_TESTS)
    rodeira_add_pch(rodeira_pch_test HEADERS ${headers} <fstream> <sstream> <gtest/gtest.h> <gmock/gmock.h>
                    LINK Eigen3::Eigen fmt::fmt GTest::gmock GTest::gtest)
  endif()
endif()

# The target reads the precompiled header `pch`, where there is one.
function(rodeira_precompile target pch)
  if(TARGET ${pch})
    target_precompile_headers(${target} REUSE_FROM ${pch})
    target_compile_options(${target} PRIVATE ${RODEIRA_PCH_WARNINGS})
  endif()
endfunction()

function(rodeira_compile_fast target)
  rodeira_precompile(${target} rodeira_pch)
  if(RODEIRA_UNITY)
    set(limit ${RODEIRA_BATCH})
    if(CMAKE_CURRENT_SOURCE_DIR MATCHES "${RODEIRA_SMALL_BATCH_GROUPS}")
      set(limit ${RODEIRA_SMALL_BATCH})
    endif()
    # As few batches as the limit allows, of equal sizes.
    get_target_property(sources ${target} SOURCES)
    list(LENGTH sources count)
    math(EXPR batches "(${count} + ${limit} - 1) / ${limit}")
    math(EXPR batch "(${count} + ${batches} - 1) / ${batches}")
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
endfunction()

# rodeira_vectorise(network cluster.cpp …): sources of the library of the current folder whose loops the compiler
# vectorises: -O3, and square roots that set no errno. Every result keeps its bits. They are a batch of their own, and
# read no precompiled header: GCC would compile them at its level, -O2, and say nothing.
function(rodeira_vectorise name)
  set(sources ${ARGN})
  if(RODEIRA_UNITY)
    set(batch ${CMAKE_CURRENT_BINARY_DIR}/vectorised.cpp)
    list(TRANSFORM sources REPLACE "(.+)" "#include \"${CMAKE_CURRENT_SOURCE_DIR}/\\1\"\n" OUTPUT_VARIABLE includes)
    string(CONCAT text ${includes})
    file(CONFIGURE OUTPUT ${batch} CONTENT "${text}" @ONLY)
    set_source_files_properties(${sources} PROPERTIES HEADER_FILE_ONLY ON)
    target_sources(rodeira_${name} PRIVATE ${batch})
    set(sources ${batch})
  endif()
  set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS "-O3;-fno-math-errno"
    SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Sources that are compiled alone, because they define macros, or headers of other libraries define some for them.
function(rodeira_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
