# SPDX-License-Identifier: Apache-2.0
# Run by CPack on the staged files, before the packages are written: licences, a changelog, and one time of change for
# every file, so that two builds of one revision give the same bytes.

set(licences "/usr/share/doc")
# Libraries whose code is in the programs (headers, or static): package of Debian that carries their licence. Those of
# rodeira-headless hold for the packages that depend on it, too.
set(embedded_headless libcli11-dev libeigen3-dev libboost1.74-dev libfmt-dev)
set(embedded_graphics libimgui-dev)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(documents ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share/doc/${package})
  if(NOT IS_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/${component})
    continue()
  endif()
  file(MAKE_DIRECTORY ${documents})
  file(WRITE ${documents}/copyright "Rodeira: a distributed driving simulator
Copyright 2026 the authors of Rodeira
License: Apache-2.0

On Debian systems, the text of the Apache License, Version 2.0, is found in
/usr/share/common-licenses/Apache-2.0.
")
  file(APPEND ${documents}/copyright "
The programs contain code of other libraries. Their licences are found in
/usr/share/doc/rodeira-headless/third_party and
/usr/share/doc/rodeira/third_party.
")
  foreach(library IN LISTS embedded_${component})
    if(NOT EXISTS ${licences}/${library}/copyright)
      message(FATAL_ERROR "${licences}/${library}/copyright: no such file; the package must carry this licence")
    endif()
    configure_file(${licences}/${library}/copyright ${documents}/third_party/${library} COPYONLY)
    file(SIZE ${documents}/third_party/${library} bytes)
    if(bytes GREATER 100000)
      execute_process(COMMAND gzip -9nf ${documents}/third_party/${library} COMMAND_ERROR_IS_FATAL ANY)
    endif()
  endforeach()
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH where it is set
  file(WRITE ${documents}/changelog "rodeira (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Release ${CPACK_PACKAGE_VERSION}; docs/changelog.md (package rodeira-doc) lists the changes.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  execute_process(COMMAND gzip -9nf ${documents}/changelog COMMAND_ERROR_IS_FATAL ANY)
endforeach()

execute_process(COMMAND find ${CPACK_TEMPORARY_DIRECTORY} -type d -exec chmod 755 {} + COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND find ${CPACK_TEMPORARY_DIRECTORY} -type f -not -perm /111 -exec chmod 644 {} +
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND find ${CPACK_TEMPORARY_DIRECTORY} -type f -perm /111 -exec chmod 755 {} +
                COMMAND_ERROR_IS_FATAL ANY)
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND find ${CPACK_TEMPORARY_DIRECTORY} -exec touch -h -d @$ENV{SOURCE_DATE_EPOCH} {} +
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
