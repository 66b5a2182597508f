# SPDX-License-Identifier: Apache-2.0
# What is installed, and where. Components: headless (front door, nodes, worlds, vehicles, launch files), graphics
# (view, editor, start window), development (libraries and headers for nodes of one's own), documentation,
# python (recordings in Python).
# cmake/RodeiraPackage.cmake makes Debian packages of them.

include(GNUInstallDirs)
# base::FindProgram and base::SharedDataFolder look here: below the prefix, whatever the distribution prefers.
set(RODEIRA_PROGRAM_FOLDER libexec/rodeira)
set(RODEIRA_DATA_FOLDER share/rodeira)

# The group of a library's folder that is installed for nodes and vehicles of one's own.
function(rodeira_is_in_kit folder out)
  set(${out} OFF PARENT_SCOPE)
  if(folder MATCHES "^(common/(core|world|data|runtime|vehicle)(/|$)|idl$)" AND NOT folder MATCHES "sdl_devices$")
    set(${out} ON PARENT_SCOPE)
  endif()
endfunction()

function(rodeira_install_library name)
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  rodeira_is_in_kit(${folder} in_kit)
  if(NOT in_kit)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY RODEIRA_INSTALLED rodeira_${name})
  set_target_properties(rodeira_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS rodeira_${name} EXPORT RodeiraTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development EXCLUDE_FROM_ALL)
endfunction()

# rodeira-empty only measures the lockstep; it stays in the build folder.
function(rodeira_install_program name)
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT folder MATCHES "^(nodes|launch)/" OR name STREQUAL "rodeira-empty")
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY RODEIRA_INSTALLED ${name})
  set(component headless)
  if(name MATCHES "^rodeira-(view|graphics|nodes-graphics)$")
    set(component graphics)
  endif()
  if(name STREQUAL "rodeira")
    install(TARGETS ${name} RUNTIME DESTINATION bin COMPONENT ${component})
  else()
    install(TARGETS ${name} RUNTIME DESTINATION ${RODEIRA_PROGRAM_FOLDER} COMPONENT ${component})
  endif()
endfunction()

# Beside the programs of libexec, where base::FindProgram finds it.
function(rodeira_install_plugin name)
  set_property(GLOBAL APPEND PROPERTY RODEIRA_INSTALLED ${name})
  install(TARGETS ${name} LIBRARY DESTINATION ${RODEIRA_PROGRAM_FOLDER} COMPONENT headless)
endfunction()

function(rodeira_install_files)
  file(GLOB launch_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/launch/*.yaml)
  install(FILES ${launch_files} DESTINATION ${RODEIRA_DATA_FOLDER}/launch COMPONENT headless)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/configs DESTINATION ${RODEIRA_DATA_FOLDER} COMPONENT headless)
  rodeira_install_shell_files()
  if(RODEIRA_VIEW)
    set(packaging ${CMAKE_SOURCE_DIR}/packaging)
    install(FILES ${packaging}/rodeira.desktop ${packaging}/rodeira-replay.desktop ${packaging}/rodeira-edit.desktop
            DESTINATION share/applications COMPONENT graphics)
    install(FILES ${packaging}/rodeira.svg DESTINATION share/icons/hicolor/scalable/apps COMPONENT graphics)
    install(FILES ${packaging}/rodeira.xml DESTINATION share/mime/packages COMPONENT graphics)
  endif()
  install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CONTRIBUTING.md ${CMAKE_SOURCE_DIR}/SECURITY.md
          ${CMAKE_SOURCE_DIR}/CITATION.cff DESTINATION share/doc/rodeira-doc COMPONENT documentation)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION share/doc/rodeira-doc COMPONENT documentation)
  # Where Debian's Python looks, whatever the version.
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/rodeira DESTINATION lib/python3/dist-packages COMPONENT python
          FILES_MATCHING PATTERN *.py PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  rodeira_install_kit()
  # Everything that is installed, and nothing else.
  get_property(installed GLOBAL PROPERTY RODEIRA_INSTALLED)
  add_custom_target(rodeira_installed DEPENDS ${installed} rodeira_shell_files)
endfunction()

# The manual page and the shells' completion, printed by the program itself.
function(rodeira_install_shell_files)
  set(folder ${CMAKE_BINARY_DIR}/shell)
  add_custom_command(OUTPUT ${folder}/rodeira.1.gz ${folder}/rodeira ${folder}/_rodeira
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND rodeira manual > ${folder}/rodeira.1
    COMMAND gzip -9nf ${folder}/rodeira.1
    COMMAND rodeira completion bash > ${folder}/rodeira
    COMMAND rodeira completion zsh > ${folder}/_rodeira
    DEPENDS rodeira COMMENT "manual page and completion" VERBATIM)
  add_custom_target(rodeira_shell_files ALL DEPENDS ${folder}/rodeira.1.gz)
  install(FILES ${folder}/rodeira.1.gz DESTINATION share/man/man1 COMPONENT headless)
  install(FILES ${folder}/rodeira DESTINATION share/bash-completion/completions COMPONENT headless)
  install(FILES ${folder}/_rodeira DESTINATION share/zsh/vendor-completions COMPONENT headless)
endfunction()

# Libraries, headers and CMake's description of them, for `find_package(Rodeira)`.
function(rodeira_install_kit)
  set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Rodeira)
  set(RODEIRA_IDL_FOLDER include/rodeira/idl)
  include(CMakePackageConfigHelpers)
  configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/RodeiraConfig.cmake.in
    ${CMAKE_BINARY_DIR}/RodeiraConfig.cmake INSTALL_DESTINATION ${cmake_folder}
    PATH_VARS RODEIRA_IDL_FOLDER RODEIRA_DATA_FOLDER)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/RodeiraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/RodeiraConfig.cmake ${CMAKE_BINARY_DIR}/RodeiraConfigVersion.cmake
          ${CMAKE_SOURCE_DIR}/cmake/RodeiraKit.cmake ${CMAKE_SOURCE_DIR}/cmake/quiet.cmake
          ${CMAKE_SOURCE_DIR}/cmake/kit_headers.txt
          DESTINATION ${cmake_folder} COMPONENT development EXCLUDE_FROM_ALL)
  install(EXPORT RodeiraTargets NAMESPACE rodeira:: DESTINATION ${cmake_folder} COMPONENT development EXCLUDE_FROM_ALL)
  foreach(folder common/core common/world common/data common/runtime common/vehicle idl)
    install(DIRECTORY ${CMAKE_SOURCE_DIR}/${folder}/ DESTINATION include/rodeira/${folder} COMPONENT development
            EXCLUDE_FROM_ALL FILES_MATCHING PATTERN *.hpp PATTERN *.idl PATTERN sdl_devices EXCLUDE
            PATTERN geodata EXCLUDE)
  endforeach()
  # Scripts stay executable.
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples DESTINATION ${RODEIRA_DATA_FOLDER} COMPONENT development
          EXCLUDE_FROM_ALL USE_SOURCE_PERMISSIONS)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/idl/generated/ DESTINATION include/rodeira/generated COMPONENT development
          EXCLUDE_FROM_ALL FILES_MATCHING PATTERN *.h)
endfunction()
