# An installation that has been moved works by the data beside the program: the model, the presets and the clips of
# the source tree are not used.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/first OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${FOLDER}/first ${FOLDER}/moved)
set(stride ${FOLDER}/moved/bin/stride)
set(share ${FOLDER}/moved/share)

function(run expected_result)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL expected_result)
    message(FATAL_ERROR "${ARGN}\nended with ${result}, not ${expected_result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect text)
  string(FIND "${output}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "was to say '${text}', but said:\n${output}")
  endif()
endfunction()

# A preset that only the moved installation has is found, so its data come first.
file(RENAME ${share}/stride/train/presets/demo.toml ${share}/stride/train/presets/moved.toml)
run(0 ${stride} train --preset moved --baseline --out run --decisions 400 --set run.threads=1 --set run.warm_up=200)
# With STRIDE_DATA there is no other place: everything that these commands need is installed.
set(ENV{STRIDE_DATA} ${share}/stride)
run(0 ${stride} convert ${share}/stride/videos/human.mp4 -o converted)
run(0 ${stride} train --preset stride --potential converted/human.potential.json --out shaped --decisions 400
    --set run.threads=1 --set run.warm_up=200)
run(0 ${stride} evaluate shaped)
run(0 ${stride} evaluate ${share}/stride/train/agents/stride --out evaluated --no-film)
run(0 ${stride} simulate --help)
run(1 ${stride} experiment none)
expect("must be one of")
set(ENV{STRIDE_DATA} ${FOLDER}/nothing)
run(1 ${stride} bench --seconds 0.1)
expect("gait9dof18musc.osim: is not in ${FOLDER}/nothing; set STRIDE_DATA")
unset(ENV{STRIDE_DATA})

run(0 ${stride} --version)
if(NOT output MATCHES "^[0-9]+\\.[0-9]+\\.[0-9]+")
  message(FATAL_ERROR "--version said ${output}")
endif()

# Manual pages and completions.
foreach(file man/man1/stride.1 man/man1/stride-train.1 bash-completion/completions/stride
             zsh/vendor-completions/_stride fish/vendor_completions.d/stride.fish)
  if(NOT EXISTS ${share}/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()
find_program(MAN man)
if(MAN)
  set(ENV{MANWIDTH} 100)
  run(0 ${MAN} --warnings -l ${share}/man/man1/stride-train.1)
  expect("--potential")
endif()
find_program(BASH bash)
if(BASH)
  file(WRITE ${FOLDER}/complete.sh "source ${share}/bash-completion/completions/stride
COMP_WORDS=(stride ev) COMP_CWORD=1\n_stride\necho \${COMPREPLY[@]}
COMP_WORDS=(stride train --pot) COMP_CWORD=2\n_stride\necho \${COMPREPLY[@]}\n")
  run(0 ${BASH} ${FOLDER}/complete.sh)
  expect("evaluate\n--potential")
endif()

# The Python module finds them as well.
if(PYTHON)
  set(ENV{PYTHONPATH} ${FOLDER}/moved/lib/python3/dist-packages)
  file(WRITE ${FOLDER}/data.py "import stride\nstride.StrideEnv().reset(seed=1)\nprint(stride.data_file('train/presets/moved.toml'))\n")
  run(0 ${PYTHON} ${FOLDER}/data.py)
  expect("${share}/stride/train/presets/moved.toml")
endif()
