# How Rodeira's libraries, programs and tests are declared, and which may use which.

find_program(RODEIRA_CCACHE ccache)
if(RODEIRA_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${RODEIRA_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${RODEIRA_CCACHE})
endif()
find_program(RODEIRA_MOLD mold)
if(RODEIRA_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# The same bits on every machine (law L7): no contraction, no value-changing optimisation, no -march.
add_compile_options(-ffp-contract=off -fno-fast-math)
if(RODEIRA_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=address,undefined)
endif()
set(RODEIRA_WARNINGS -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wsuggest-override
                     -Wdouble-promotion -Wimplicit-fallthrough -Wunused -Werror)

file(STRINGS ${CMAKE_SOURCE_DIR}/cmake/layers.txt RODEIRA_LAYER_LINES REGEX "^[a-z]")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/layers.txt)

# A room is the folder of a target: rodeira::base is common/base, rodeira::node_clock is nodes/clock.
function(rodeira_room_of target out)
  string(REPLACE "rodeira::" "" name "${target}")
  if(name STREQUAL "idl" OR name STREQUAL "launch_library")
    set(room ${name})
  elseif(name MATCHES "^node_(.*)$")
    set(room "nodes/${CMAKE_MATCH_1}")
  else()
    set(room "common/${name}")
  endif()
  set(${out} ${room} PARENT_SCOPE)
endfunction()

function(rodeira_check_layers room)
  set(allowed "")
  foreach(line IN LISTS RODEIRA_LAYER_LINES)
    if(line MATCHES "^([a-z/]+):(.*)$")
      if(CMAKE_MATCH_1 STREQUAL room)
        set(allowed "${CMAKE_MATCH_2} ")
      endif()
    endif()
  endforeach()
  foreach(target IN LISTS ARGN)
    if(target MATCHES "^rodeira::")
      rodeira_room_of(${target} used)
      if(NOT allowed MATCHES " ${used} " AND NOT allowed MATCHES " \\* ")
        message(FATAL_ERROR "${room} links ${target}, but cmake/layers.txt does not let ${room} use ${used}")
      endif()
    endif()
  endforeach()
endfunction()

# rodeira_library(base SOURCES a.cpp … PUBLIC fmt::fmt … PRIVATE …): the library of the current folder.
function(rodeira_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  file(RELATIVE_PATH room ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  rodeira_check_layers(${room} ${ARG_PUBLIC} ${ARG_PRIVATE})
  add_library(rodeira_${name} STATIC ${ARG_SOURCES})
  add_library(rodeira::${name} ALIAS rodeira_${name})
  target_include_directories(rodeira_${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_compile_options(rodeira_${name} PRIVATE ${RODEIRA_WARNINGS})
  target_link_libraries(rodeira_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()

# rodeira_program(rodeira-clock SOURCES main.cpp LINK …)
function(rodeira_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${name} PRIVATE ${RODEIRA_WARNINGS})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
endfunction()

# rodeira_test(base SOURCES … LINK …): one GoogleTest program a room, every case known to ctest.
# PROPERTIES are passed to the discovered tests (TIMEOUT, RUN_SERIAL, LABELS …).
function(rodeira_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PROPERTIES" ${ARGN})
  add_executable(${name}_test ${ARG_SOURCES})
  target_include_directories(${name}_test PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${name}_test PRIVATE ${RODEIRA_WARNINGS})
  target_compile_definitions(${name}_test PRIVATE
    RODEIRA_SOURCE_DIR="${CMAKE_SOURCE_DIR}" RODEIRA_BINARY_DIR="${CMAKE_BINARY_DIR}")
  target_link_libraries(${name}_test PRIVATE ${ARG_LINK} GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 ${ARG_PROPERTIES})
endfunction()

# rodeira_bench(suelo SOURCES … LINK …): a Google Benchmark program, not a test.
function(rodeira_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name}_bench ${ARG_SOURCES})
  target_include_directories(${name}_bench PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${name}_bench PRIVATE ${RODEIRA_WARNINGS})
  target_compile_definitions(${name}_bench PRIVATE RODEIRA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_link_libraries(${name}_bench PRIVATE ${ARG_LINK})
endfunction()

# Rooms are entered in the order of the dependencies; a room that is not built yet is passed over.
function(rodeira_add_rooms)
  foreach(room IN LISTS ARGN)
    if(EXISTS ${CMAKE_SOURCE_DIR}/${room}/CMakeLists.txt)
      add_subdirectory(${room})
    endif()
  endforeach()
endfunction()
