# SPDX-License-Identifier: Apache-2.0
# Writes OUT from IN with the commit that is built, and touches OUT only where that has changed. A tree without git:
# "unknown".
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE RODEIRA_COMMIT
                OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE problem ERROR_QUIET)
if(problem)
  set(RODEIRA_COMMIT "unknown")
else()
  execute_process(COMMAND git -C ${SOURCE} diff --quiet HEAD RESULT_VARIABLE changed ERROR_QUIET)
  if(changed)
    string(APPEND RODEIRA_COMMIT "+changes")
  endif()
endif()
configure_file(${IN} ${OUT} @ONLY)
