# Functions that build a room of the runtime, and a tool on top of the rooms.
#
#   hyperlattice_room(plan SOURCES plan.cpp ... ROOMS statics LIBRARIES Eigen3::Eigen)
#     builds the library hyperlattice_plan of core/plan. The library links the given rooms and,
#     through them, the rooms that they link. With tests, each room is also linked completely
#     with these rooms alone, so that a call into a later room is an error.

add_library(hyperlattice_room_flags INTERFACE)
target_compile_definitions(hyperlattice_room_flags INTERFACE BOOST_DLL_USE_STD_FS HYPERLATTICE_VERSION="${PROJECT_VERSION}")
target_link_libraries(hyperlattice_room_flags INTERFACE hyperlattice_flags OpenMP::OpenMP_CXX)

function(hyperlattice_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  list(TRANSFORM ROOM_ROOMS PREPEND hyperlattice_)
  set(room hyperlattice_${name})
  add_library(${room} STATIC ${ROOM_SOURCES})
  set_target_properties(${room} PROPERTIES CXX_VISIBILITY_PRESET default VISIBILITY_INLINES_HIDDEN OFF)
  target_include_directories(${room} PUBLIC ${PROJECT_SOURCE_DIR}/core)
  target_link_libraries(${room} PUBLIC hyperlattice_kernels nlohmann_json::nlohmann_json spdlog::spdlog ${ROOM_ROOMS}
                        PRIVATE ${ROOM_LIBRARIES} hyperlattice_room_flags)
  if(name STREQUAL base) # all rooms precompile the same headers
    target_precompile_headers(${room} PRIVATE <algorithm> <cmath> <filesystem> <map> <string> <vector> <spdlog/fmt/fmt.h> <nlohmann/json.hpp>)
  else()
    target_precompile_headers(${room} REUSE_FROM hyperlattice_base)
  endif()
  if(HYPERLATTICE_TESTS AND NOT HYPERLATTICE_SANITIZE)
    add_library(${room}_alone MODULE $<TARGET_OBJECTS:${room}>)
    target_link_libraries(${room}_alone PRIVATE nlohmann_json::nlohmann_json spdlog::spdlog ${ROOM_ROOMS} ${ROOM_LIBRARIES} hyperlattice_room_flags)
    target_link_options(${room}_alone PRIVATE -Wl,-z,defs)
    set_target_properties(${room}_alone PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
endfunction()

#   hyperlattice_tool(study SOURCES study_file.cpp ... TOOLS report LIBRARIES Eigen3::Eigen)
#     builds the library hyperlattice_study of apps/study.
function(hyperlattice_tool name)
  cmake_parse_arguments(TOOL "" "" "SOURCES;TOOLS;LIBRARIES" ${ARGN})
  list(TRANSFORM TOOL_TOOLS PREPEND hyperlattice_)
  set(tool hyperlattice_${name})
  add_library(${tool} STATIC ${TOOL_SOURCES})
  # The precompiled headers need the same visibility.
  set_target_properties(${tool} PROPERTIES CXX_VISIBILITY_PRESET default VISIBILITY_INLINES_HIDDEN OFF)
  target_include_directories(${tool} PUBLIC ${PROJECT_SOURCE_DIR}/apps)
  target_link_libraries(${tool} PUBLIC hyperlattice ${TOOL_TOOLS} PRIVATE ${TOOL_LIBRARIES} hyperlattice_room_flags)
  target_precompile_headers(${tool} REUSE_FROM hyperlattice_base)
endfunction()
