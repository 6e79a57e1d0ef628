# The window itself: on Qt's offscreen platform, without a display, and, where the programs for it exist, clicked by
# xdotool under Xvfb. -DSTRIDE=program -DVIDEO=clip -DFOLDER=scratch -DCASE=offscreen|no_display|xdotool
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
file(COPY ${VIDEO} DESTINATION ${FOLDER})
get_filename_component(name ${VIDEO} NAME)
get_filename_component(stem ${VIDEO} NAME_WE)
set(clip ${FOLDER}/${name})
set(keypoints ${FOLDER}/${stem}.keypoints.json)

if(CASE STREQUAL "no_display")
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=DISPLAY --unset=WAYLAND_DISPLAY --unset=QT_QPA_PLATFORM
                  ${STRIDE} annotate ${clip} RESULT_VARIABLE code ERROR_VARIABLE error)
  if(NOT code EQUAL 1 OR NOT error MATCHES "error: no display: neither DISPLAY nor WAYLAND_DISPLAY is set")
    message(FATAL_ERROR "exit ${code}, said: ${error}")
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=WAYLAND_DISPLAY --unset=QT_QPA_PLATFORM DISPLAY=:4711
                  ${STRIDE} annotate ${clip} RESULT_VARIABLE code ERROR_VARIABLE error)
  if(NOT code EQUAL 1 OR NOT error MATCHES "error: no display: ':4711' cannot be reached")
    message(FATAL_ERROR "exit ${code}, said: ${error}")
  endif()
elseif(CASE STREQUAL "offscreen")
  # Nobody can press q there: the window must be up and alive until it is told to end.
  execute_process(COMMAND ${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=offscreen timeout 4 ${STRIDE} annotate ${clip}
                  RESULT_VARIABLE code ERROR_VARIABLE error)
  if(NOT code EQUAL 124)
    message(FATAL_ERROR "the window did not stay: exit ${code}, said: ${error}")
  endif()
  # The movement is kept with the clicks, and an unknown one is refused.
  execute_process(COMMAND ${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=offscreen timeout 4 ${STRIDE} annotate ${clip} --movement jump
                  RESULT_VARIABLE code ERROR_VARIABLE error)
  if(NOT code EQUAL 124)
    message(FATAL_ERROR "the window did not stay: exit ${code}, said: ${error}")
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=offscreen ${STRIDE} annotate ${clip} --movement crawl
                  RESULT_VARIABLE code ERROR_VARIABLE error)
  if(NOT code EQUAL 1 OR NOT error MATCHES "--movement = 'crawl': must be one of run")
    message(FATAL_ERROR "exit ${code}, said: ${error}")
  endif()
  # A window that is ended leaves its edits in the journal; the next one takes them over.
  file(GLOB kept ${FOLDER}/${stem}.keypoints.json*)
  set(said "")
  foreach(file ${kept})
    file(READ ${file} text)
    string(APPEND said "${text}")
  endforeach()
  if(NOT said MATCHES "\"movement\": *\"jump\"")
    message(FATAL_ERROR "no movement in ${kept}: ${said}")
  endif()
else()
  execute_process(COMMAND sh ${CMAKE_CURRENT_LIST_DIR}/annotate_by_xdotool.sh ${STRIDE} ${clip} RESULT_VARIABLE code
                  OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(code EQUAL 77)
    message("skipped: ${said}")
    return()
  endif()
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "exit ${code}: ${said}")
  endif()
  file(READ ${keypoints} made)
  foreach(expected "\"direction\": \"right\"" "\"near_leg\": \"right\"" "\"pelvis\"" "\"knee_r\"" "\"estimated\"" "\"absent\"" "\"length_m\": 2.5"
          "\"frame\": 95" "\"frame\": ([1-8]|9[0-4]|9,)")
    if(NOT made MATCHES ${expected})
      message(FATAL_ERROR "${expected} is not in ${made}")
    endif()
  endforeach()
endif()
