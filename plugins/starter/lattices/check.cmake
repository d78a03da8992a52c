# Runs SCENE: a block of 10 x 10 x 10 particles has 3 * 10 * 10 * 9 springs along edges, 6 * 10 * 9 * 9 along the diagonals of faces and 4 * 9 * 9 * 9 along
# those of cells.
execute_process(COMMAND ${PROGRAM} run ${SCENE} --set "/plugins=[\"${PLUGINS}\"]" --quiet --out ${OUT} COMMAND_ERROR_IS_FATAL ANY)
file(READ ${OUT}/summary.json summary)
foreach(expected particles,1000 springs,10476)
  string(REPLACE "," ";" expected ${expected})
  list(GET expected 0 name)
  list(GET expected 1 value)
  string(JSON got GET "${summary}" ${name})
  if(NOT got EQUAL ${value})
    message(FATAL_ERROR "${got} ${name}, expected ${value}")
  endif()
endforeach()
