# SPDX-License-Identifier: Apache-2.0
# rodeira_add_node(NAME [LIBRARY] SOURCES a.cpp … [IDL gaze.idl …]): a program that takes part in a run as a node of
# kind `external`. With LIBRARY also the shared object NAME.so, for runs in one process, verification and branches.
# For each IDL file fastddsgen makes the types (`#include "gaze.h"`), and the text goes into the program: the clock
# refuses the node if the manifest names another type. An included IDL file is named, too. Paths are relative to the
# current folder. RODEIRA_IDL is the folder of Rodeira's IDL.
function(rodeira_add_node name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "LIBRARY" "" "SOURCES;IDL")
  if(NOT ARG_SOURCES OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rodeira_add_node(NAME [LIBRARY] SOURCES … [IDL …]) was expected for ${name}")
  endif()
  find_program(FASTDDSGEN fastddsgen REQUIRED)
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE rodeira::dds)
  set(targets ${name})
  if(ARG_LIBRARY)
    add_library(${name}_library MODULE ${ARG_SOURCES})
    target_link_libraries(${name}_library PRIVATE rodeira::launch)
    target_compile_definitions(${name}_library PRIVATE RODEIRA_NODE_LIBRARY)
    get_target_property(folder ${name} RUNTIME_OUTPUT_DIRECTORY)
    if(NOT folder)
      set(folder ${CMAKE_CURRENT_BINARY_DIR})
    endif()
    set_target_properties(${name}_library PROPERTIES PREFIX "" OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${folder})
    list(APPEND targets ${name}_library)
  endif()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/${name}_idl)
  # A folder of its own for preprocessed texts: fastddsgen writes them to /tmp by name, where another one may truncate
  # them.
  file(MAKE_DIRECTORY ${generated}/preprocessed)
  set(RODEIRA_COMPILED "")
  set(paths "")
  set(sources "")
  set(headers "")
  foreach(idl IN LISTS ARG_IDL)
    get_filename_component(path ${idl} ABSOLUTE)
    get_filename_component(stem ${idl} NAME_WE)
    list(APPEND paths ${path})
    list(APPEND sources ${generated}/${stem}.cxx)
    list(APPEND headers ${generated}/${stem}.h)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    file(READ ${path} text)
    string(APPEND RODEIRA_COMPILED
           "const rodeira::idl::CompiledIdl k_${stem}(\"${idl}\", R\"idl(${text})idl\");\n")
  endforeach()
  foreach(target IN LISTS targets)
    target_compile_features(${target} PRIVATE cxx_std_20)
    target_compile_options(${target} PRIVATE -ffp-contract=off)  # the same bits on every machine
  endforeach()
  if(NOT ARG_IDL)
    return()
  endif()
  # One command for all files: they may include one another, and fastddsgen writes included types, too.
  add_custom_command(OUTPUT ${sources} ${headers}
    COMMAND ${CMAKE_COMMAND} -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/quiet.cmake --
            ${FASTDDSGEN} -cs -replace -t ${generated}/preprocessed -I ${CMAKE_CURRENT_SOURCE_DIR} -I ${RODEIRA_IDL}
            -d ${generated} ${paths}
    DEPENDS ${paths} COMMENT "fastddsgen for ${name}" VERBATIM)
  set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS "-w")
  file(CONFIGURE OUTPUT ${generated}/compiled_idl.cpp @ONLY CONTENT [[// Made by rodeira_add_node.
#include "idl/idl_source.hpp"

namespace {
@RODEIRA_COMPILED@}  // namespace
]])
  add_custom_target(${name}_idl DEPENDS ${sources} ${headers})
  foreach(target IN LISTS targets)
    add_dependencies(${target} ${name}_idl)
    target_sources(${target} PRIVATE ${sources} ${generated}/compiled_idl.cpp)
    target_include_directories(${target} SYSTEM PRIVATE ${generated})
  endforeach()
endfunction()

# rodeira_add_vehicle(NAME SOURCES a.cpp …): the shared object NAME.so with a vehicle model, which a vehicle file names
# (`model: library`, `library: NAME.so`).
function(rodeira_add_vehicle name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES")
  if(NOT ARG_SOURCES OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rodeira_add_vehicle(NAME SOURCES …) was expected for ${name}")
  endif()
  add_library(${name} MODULE ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE rodeira::dynamics)
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_compile_options(${name} PRIVATE -ffp-contract=off)  # the same bits on every machine
  set_target_properties(${name} PROPERTIES PREFIX "")
  if(NOT CMAKE_LIBRARY_OUTPUT_DIRECTORY)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
endfunction()
