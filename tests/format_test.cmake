# Every source is as clang-format 14 leaves it.
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE files ${SOURCE}/extract/*.[hc]* ${SOURCE}/calibrate/*.[hc]* ${SOURCE}/shaping/*.[hc]*
     ${SOURCE}/train/*.[hc]* ${SOURCE}/videos/*.[hc]* ${SOURCE}/tests/*.[hc]* ${SOURCE}/main.cpp)
list(FILTER files INCLUDE REGEX "\\.(h|cpp)$")
execute_process(COMMAND ${CLANG_FORMAT} --dry-run --Werror ${files} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "not formatted: run clang-format -i on the files above")
endif()
