# SPDX-License-Identifier: Apache-2.0
# How Rodeira's libraries, programs and tests are declared, and which may use which.

set(RODEIRA_LAUNCHER "" CACHE STRING "The program that is given each command of the compilers; default: ccache")
find_program(RODEIRA_CCACHE ccache)
if(RODEIRA_CCACHE AND NOT RODEIRA_LAUNCHER)
  # Paths below the sources count relative to the build folder, so that objects of one clone serve another. The
  # sloppiness is what ccache needs for precompiled headers.
  set(RODEIRA_LAUNCHER /usr/bin/env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros ${RODEIRA_CCACHE})
endif()
if(RODEIRA_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${RODEIRA_LAUNCHER})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${RODEIRA_LAUNCHER})
endif()
find_program(RODEIRA_MOLD mold)
if(RODEIRA_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
add_link_options(-Wl,--as-needed)  # a program names only the shared libraries that it uses, whatever the compiler

# The same bytes in every folder: no path of the machine in an object file. The same flags in libraries and programs, so
# that one precompiled header serves both.
add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}/= -ffile-prefix-map=${CMAKE_BINARY_DIR}/=build/ -fPIC)

# The same bits on every machine (law L7): no contraction, no value-changing optimisation, no -march.
add_compile_options(-ffp-contract=off -fno-fast-math)
if(RODEIRA_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "RODEIRA_FUZZ needs clang: configure with CC=clang CXX=clang++")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=address,undefined)
elseif(RODEIRA_SANITIZE STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=thread)
elseif(RODEIRA_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=address,undefined)
endif()
set(RODEIRA_WARNINGS -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wsuggest-override
                     -Wdouble-promotion -Wimplicit-fallthrough -Wunused -Werror)
if(RODEIRA_FUZZ)
  set(RODEIRA_WARNINGS "")  # those are kept for GCC, which builds what is shipped
endif()
if(RODEIRA_SANITIZE)
  # GCC 12 sees writes into nothing in fmt's headers, and reads of nothing in its own <regex>, where it instruments
  # them.
  list(APPEND RODEIRA_WARNINGS -Wno-stringop-overflow -Wno-maybe-uninitialized)
endif()

include(RodeiraInstall)
include(RodeiraLayers)
include(RodeiraSpeed)

# The groups whose numbers change no type unseen. tools/clang compiles them by clang (target rodeira_strict).
set(RODEIRA_STRICT_WARNINGS -Wconversion -Wsign-conversion)

# rodeira_library(base SOURCES a.cpp … PUBLIC fmt::fmt … PRIVATE …): the library of the current folder.
function(rodeira_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  rodeira_record_links(rodeira::${name} ${ARG_PUBLIC} ${ARG_PRIVATE})
  add_library(rodeira_${name} STATIC ${ARG_SOURCES})
  add_library(rodeira::${name} ALIAS rodeira_${name})
  rodeira_compile_fast(rodeira_${name})
  target_include_directories(rodeira_${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:include/rodeira>)
  target_compile_options(rodeira_${name} PRIVATE ${RODEIRA_WARNINGS})
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(folder MATCHES "^common/(core|world|data|runtime)/")
    set_property(GLOBAL APPEND PROPERTY RODEIRA_STRICT rodeira_${name})
    if(RODEIRA_WARNINGS)
      target_compile_options(rodeira_${name} PRIVATE ${RODEIRA_STRICT_WARNINGS})
    endif()
  endif()
  target_link_libraries(rodeira_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  rodeira_install_library(${name})
endfunction()

# rodeira_plugin(rodeira-geodata SOURCES … LINK …): a shared object NAME.so beside the programs, which they load when
# they need it. The programs and tests that link the library which loads it are built after it.
function(rodeira_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  rodeira_record_links(${name} ${ARG_LINK})
  add_library(${name} MODULE ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
  rodeira_compile_fast(${name})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${name} PRIVATE ${RODEIRA_WARNINGS})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  rodeira_install_plugin(${name})
endfunction()

# A program that reads worlds loads rodeira-geodata.so.
function(rodeira_needs_geodata program)
  rodeira_linked_by(${program} linked)
  if("rodeira_terrain" IN_LIST linked OR "rodeira::terrain" IN_LIST linked)
    add_dependencies(${program} rodeira-geodata)
  endif()
endfunction()

# rodeira_program(rodeira-clock SOURCES main.cpp LINK …)
function(rodeira_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  rodeira_precompile(${name} rodeira_pch)
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${name} PRIVATE ${RODEIRA_WARNINGS})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  rodeira_needs_geodata(${name})
  rodeira_install_program(${name})
endfunction()

# Tests run beside each other (tests/run) by what they take of the machine, in quarters of a processor (PROCESSORS): one
# that computes takes four, one that starts processes and waits for them three, one that only waits one. What is typed
# and answered takes five: of two processors, none that computes runs beside it.
set(RODEIRA_COMPUTES 4)
set(RODEIRA_STARTS_PROCESSES 3)
set(RODEIRA_WAITS 1)
set(RODEIRA_BESIDE_WAITING 5)
execute_process(COMMAND unshare --mount --net mount -t tmpfs tmpfs /dev/shm
  RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(status EQUAL 0)
  set(RODEIRA_ALONE ENVIRONMENT RODEIRA_OWN_MACHINE=1)
else()
  set(RODEIRA_ALONE RUN_SERIAL TRUE)
endif()

# rodeira_test(base SOURCES … LINK …): one GoogleTest program a module, every case known to ctest.
# PROPERTIES are passed to the discovered tests (TIMEOUT, PROCESSORS, LABELS …). ALONE lists the tests, as
# --gtest_filter does, that want a machine without other runs: network and /dev/shm of their own where they can be made
# (tests/system/own_machine.cpp is among SOURCES), otherwise no other test beside them. SERIAL lists those of them that
# have no other test beside them anyhow: they measure seconds closely. WAITING lists tests apart from these that stand
# nearly all the time. The others of such a program mostly wait, and begin first (COST), so that shorter tests fill the
# processors meanwhile.
function(rodeira_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PROPERTIES;ALONE;SERIAL;WAITING" ${ARGN})
  add_executable(${name}_test ${ARG_SOURCES})
  rodeira_precompile(${name}_test rodeira_pch_test)
  target_include_directories(${name}_test PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${name}_test PRIVATE ${RODEIRA_WARNINGS})
  target_link_libraries(${name}_test PRIVATE ${ARG_LINK} rodeira_tests_tree fmt::fmt Eigen3::Eigen GTest::gmock
    GTest::gtest_main)
  rodeira_needs_geodata(${name}_test)
  if(NOT "PROCESSORS" IN_LIST ARG_PROPERTIES AND NOT "RUN_SERIAL" IN_LIST ARG_PROPERTIES)
    list(APPEND ARG_PROPERTIES PROCESSORS ${RODEIRA_COMPUTES})
  endif()
  # A cache of the build folder's own, which its tests share as the processes of a run do.
  list(APPEND ARG_PROPERTIES ENVIRONMENT_MODIFICATION RODEIRA_CACHE=set:${CMAKE_BINARY_DIR}/cache)
  # A program with a main function of its own pins the mathematics library (base::PinMathLibrary): with this variable
  # from the beginning, it need not start itself again.
  if("${ARG_SOURCES}" MATCHES "(^|[;/])main\\.cpp(;|$)" AND NOT "ENVIRONMENT" IN_LIST ARG_PROPERTIES)
    list(APPEND ARG_PROPERTIES ENVIRONMENT GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2)
  endif()
  set(others)
  if(ARG_ALONE)
    list(JOIN ARG_ALONE ":" alone)
    list(JOIN ARG_SERIAL ":" serial)
    list(JOIN ARG_WAITING ":" waiting)
    gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
      TEST_FILTER "${alone}-${serial}:${waiting}" TEST_LIST ${name}_alone
      PROPERTIES TIMEOUT 300 ${ARG_PROPERTIES} ${RODEIRA_ALONE})
    set(others TEST_FILTER "-${alone}:${serial}:${waiting}")
    if(ARG_SERIAL)
      gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 TEST_FILTER "${serial}"
        TEST_LIST ${name}_serial PROPERTIES TIMEOUT 300 ${ARG_PROPERTIES} ${RODEIRA_ALONE} RUN_SERIAL TRUE)
    endif()
    list(APPEND ARG_PROPERTIES COST 60)
    if(ARG_WAITING)
      gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 TEST_FILTER "${waiting}"
        TEST_LIST ${name}_waiting PROPERTIES TIMEOUT 300 ${ARG_PROPERTIES} ${RODEIRA_ALONE}
        PROCESSORS ${RODEIRA_WAITS})
    endif()
  endif()
  gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 ${others}
    PROPERTIES TIMEOUT 300 ${ARG_PROPERTIES})
endfunction()

# rodeira_script_test(docs.check COMMAND …): a test that is no GoogleTest program.
function(rodeira_script_test name)
  add_test(NAME ${name} ${ARGN})
  set_tests_properties(${name} PROPERTIES PROCESSORS ${RODEIRA_COMPUTES})
endfunction()

# rodeira_bench(suelo SOURCES … LINK …): a Google Benchmark program, not a test.
function(rodeira_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name}_bench ${ARG_SOURCES})
  rodeira_precompile(${name}_bench rodeira_pch)
  target_include_directories(${name}_bench PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${name}_bench PRIVATE ${RODEIRA_WARNINGS})
  target_link_libraries(${name}_bench PRIVATE ${ARG_LINK} rodeira_tests_tree)
  rodeira_needs_geodata(${name}_bench)
endfunction()

# rodeira_modules(base config …): enters the folders of a group's modules. A folder that is listed and absent is an
# error.
function(rodeira_modules)
  foreach(module IN LISTS ARGN)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${module}/CMakeLists.txt)
      message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/CMakeLists.txt names ${module}, "
        "but there is no ${module}/CMakeLists.txt")
    endif()
    add_subdirectory(${module})
  endforeach()
endfunction()
