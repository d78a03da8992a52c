# The first plugin of a user: installs this build, moves the installed tree, copies the starter out of the source tree, and builds and tests
# it there. BUILD and SOURCE are this project's folders, COMPILER its C++ compiler.
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
file(COPY ${SOURCE}/plugins/starter/ DESTINATION ${folder}/my_law)

must_work(${folder}/moved/bin/hyperlattice plugins --why)
if(output MATCHES "${BUILD}" OR output MATCHES "refused" OR NOT output MATCHES "${folder}/moved/[^\n]*hyperlattice/lattices.cubic.so")
  message(FATAL_ERROR "the installed program must find its own plugins and no others")
endif()

must_work(${CMAKE_COMMAND} -S ${folder}/my_law -B ${folder}/my_law/build -D CMAKE_PREFIX_PATH=${folder}/moved -D CMAKE_CXX_COMPILER=${COMPILER}
          -D CMAKE_CXX_FLAGS=-Wall\ -Wextra\ -Wpedantic\ -Wconversion\ -Werror)
must_work(${CMAKE_COMMAND} --build ${folder}/my_law/build)
must_work(${CMAKE_CTEST_COMMAND} --test-dir ${folder}/my_law/build --output-on-failure --no-tests=error)
file(REMOVE_RECURSE ${folder})
