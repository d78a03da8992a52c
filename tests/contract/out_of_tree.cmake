# The first plugin of a user. The script installs this build and moves the installed tree. There the
# program writes a project for each family that it supports, and the script builds and tests these
# projects. BUILD and SOURCE are the folders of this project, COMPILER is its C++ compiler.
set(temporary $ENV{TMPDIR})
if(NOT temporary)
  set(temporary /tmp)
endif()
string(RANDOM LENGTH 10 unique)
set(folder ${temporary}/hyperlattice_out_of_tree_${unique})
unset(ENV{HYPERLATTICE_PLUGIN_PATH})

function(must_work)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT result EQUAL 0)
    file(REMOVE_RECURSE ${folder})
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

must_work(${CMAKE_COMMAND} --install ${BUILD} --prefix ${folder}/installed --strip)
file(RENAME ${folder}/installed ${folder}/moved)

must_work(${folder}/moved/bin/hyperlattice plugins --why)
if(output MATCHES "${BUILD}" OR output MATCHES "refused" OR NOT output MATCHES "${folder}/moved/[^\n]*hyperlattice/lattices.cubic.so")
  message(FATAL_ERROR "the installed program must find its own plugins and no others")
endif()

execute_process(COMMAND ${folder}/moved/bin/hyperlattice plugins --new loads.force --out ${folder}/taken RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 2 OR NOT output MATCHES "a name that no component has yet" OR EXISTS ${folder}/taken)
  message(FATAL_ERROR "a built-in component's name must be refused: ${output}")
endif()

foreach(type failures.tearing surfaces.leaning materials.wearing_out lattices.dense loads.nudge writers.places)
  set(project ${folder}/${type})
  string(TIMESTAMP start "%s")
  must_work(${folder}/moved/bin/hyperlattice plugins --new ${type} --out ${project})
  set(build "${project}/built anywhere")  # another folder than in scene.json, with a space
  must_work(${CMAKE_COMMAND} -S ${project} -B ${build} -D CMAKE_PREFIX_PATH=${folder}/moved -D CMAKE_CXX_COMPILER=${COMPILER}
            -D CMAKE_CXX_FLAGS=-Wall\ -Wextra\ -Wpedantic\ -Wconversion\ -Werror)
  must_work(${CMAKE_COMMAND} --build ${build} --parallel)
  must_work(${CMAKE_CTEST_COMMAND} --test-dir ${build} --output-on-failure --no-tests=error)
  string(TIMESTAMP end "%s")
  math(EXPR seconds "${end} - ${start}")
  message("${type}: ${seconds} s from --new to its passed tests")
endforeach()

# A plugin that is one source file, compiled by the moved program with the moved headers.
set(ENV{XDG_CACHE_HOME} ${folder}/cache)
set(ENV{CXX} ${COMPILER})
must_work(${folder}/moved/bin/hyperlattice plugins --new failures.alone --out ${folder}/alone.cpp)
must_work(${folder}/moved/bin/hyperlattice plugins --test failures.alone --plugin-path ${folder}/alone.cpp)
file(REMOVE_RECURSE ${folder})
