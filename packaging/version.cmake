# Writes OUTPUT, a header with version and commit; touches it only where they have changed.
set(STRIDE_VERSION ${VERSION})
if(EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --exclude=* OUTPUT_VARIABLE commit
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    string(APPEND STRIDE_VERSION " (${commit})")
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/stride_version.h.in ${OUTPUT} @ONLY)
