# SPDX-License-Identifier: Apache-2.0
# Debian packages of the components (`cpack` in the build folder, or tools/package):
#
#   rodeira-headless  front door, nodes without a picture, worlds, vehicles, launch files: what every PC needs
#   rodeira           view, editor, start window
#   rodeira-dev       libraries and headers for nodes and vehicles of one's own
#   rodeira-doc       documents
#   python3-rodeira   recordings, measures and worlds in Python
#
# rodeira and rodeira-dev depend on rodeira-headless of the same version.

set(RODEIRA_MAINTAINER "Rodeira developers <developers@rodeira.invalid>" CACHE STRING "Maintainer of the packages")

function(rodeira_read_packages out)
  set(names "")
  foreach(list IN LISTS ARGN)
    file(STRINGS ${CMAKE_SOURCE_DIR}/tools/packages/${list}.txt lines REGEX "^[a-z]")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "[ \t#].*" "" name "${line}")
      list(APPEND names ${name})
    endforeach()
  endforeach()
  list(JOIN names ", " joined)
  set(${out} "${joined}" PARENT_SCOPE)
endfunction()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rodeira)
set(CPACK_PACKAGE_VENDOR "Rodeira")
set(CPACK_PACKAGE_CONTACT "${RODEIRA_MAINTAINER}")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL headless development documentation python)
if(RODEIRA_VIEW)
  list(APPEND CPACK_COMPONENTS_ALL graphics)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/finish_package.cmake)

set(same "(= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_HEADLESS_PACKAGE_NAME rodeira-headless)
set(CPACK_DEBIAN_HEADLESS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_HEADLESS_PACKAGE_SUGGESTS "rodeira, rodeira-doc, sumo, sumo-tools")  # `rodeira world import`
set(CPACK_DEBIAN_HEADLESS_DESCRIPTION "distributed driving simulator, without pictures
Rodeira simulates a vehicle on its road among traffic, for research
laboratories: separate processes exchange typed DDS topics in deterministic
lockstep, and a recorded run is computed again to the bit.

This package has the front door (rodeira), clock, road server, vehicle,
traffic, input, scenario and recorder, and worlds, vehicles and launch files:
what a PC without a screen needs.")

rodeira_read_packages(run_packages run)
set(CPACK_DEBIAN_GRAPHICS_PACKAGE_NAME rodeira)
set(CPACK_DEBIAN_GRAPHICS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_GRAPHICS_PACKAGE_DEPENDS "rodeira-headless ${same}, ${run_packages}")
set(CPACK_DEBIAN_GRAPHICS_PACKAGE_SUGGESTS "rodeira-doc")
set(CPACK_DEBIAN_GRAPHICS_DESCRIPTION "distributed driving simulator
Rodeira simulates a vehicle on its road among traffic, for research
laboratories: separate processes exchange typed DDS topics in deterministic
lockstep, and a recorded run is computed again to the bit.

This package has the view, the editor of traffic maps and the start window,
and reads steering wheels and game pads.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME rodeira-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "rodeira-headless ${same}, fastddsgen, libcli11-dev, libeigen3-dev, \
libfastcdr-dev, libfastrtps-dev, libfmt-dev, libgeos-dev, liblz4-dev, libminizip-dev, libode-dev, \
libpugixml-dev, libxxhash-dev, libyaml-cpp-dev, libzstd-dev, pkg-config, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "build-essential, cmake")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "distributed driving simulator, libraries for nodes of one's own
Static libraries, headers and a CMake package (find_package(Rodeira)) to
write nodes and vehicle models that take part in a run of Rodeira.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME rodeira-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_DESCRIPTION "distributed driving simulator, documents
Tutorials, references and explanations of Rodeira as Markdown with pictures.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rodeira)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(TARGET rodeira_python_extension)
  # The extension module is of one processor and one version of Python.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  get_target_property(minor rodeira_python_extension RODEIRA_PYTHON_MINOR)
  math(EXPR next_minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy")
else()
  set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "libdeflate0, python3-pandas, python3-zstandard")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-lz4, python3-matplotlib, rodeira-headless")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${CMAKE_SOURCE_DIR}/packaging/python3/postinst;\
${CMAKE_SOURCE_DIR}/packaging/python3/prerm")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "distributed driving simulator, recordings in Python
Reads recordings of Rodeira, and other MCAP files with OMG IDL schemas, as
NumPy arrays and pandas frames: topics, times, columns with their units,
events, marks, metadata and embedded files. Computes measures of recordings
and of other tables, and finds places in the lanes of a world.")

include(CPack)
