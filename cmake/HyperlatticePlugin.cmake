# Functions that build plugins, inside this project and outside: find_package(Hyperlattice) includes
# this file.
#
#   hyperlattice_add_plugin(loads.blast blast.cpp)
#     builds the library `loads.blast.so`. The program finds it by the name of the type. In this
#     project, PACKAGE mpi puts it into the Debian package hyperlattice-mpi.
#
#   hyperlattice_add_material(materials.elastic elastic.cpp LAW elastic.hpp Elastic)
#     also builds the kernels of the law, once for each instruction set. The program chooses
#     one of them at run time. With several laws, LAW law.hpp One Other, the material chooses
#     between kernels_for_processor<One>(choice) and the like.

# Sets the flags of kernels: `variants`, flags_<variant>, `kernel_flags`.
macro(hyperlattice_kernel_flags)
  set(variants baseline)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND variants avx2 avx512)
  endif()
  # -Wno-psabi: the calling convention of vectors does not matter, as they stay inside one file.
  set(flags_baseline -Wno-psabi)
  set(flags_avx2 -march=x86-64-v3 -Wno-psabi)
  set(flags_avx512 -march=x86-64-v4 -mprefer-vector-width=512)
  set(kernel_flags -O3 -fno-math-errno -fno-trapping-math -ffp-contract=fast -fno-signed-zeros)
endmacro()

function(hyperlattice_add_plugin type)
  cmake_parse_arguments(PLUGIN "" "PACKAGE" "" ${ARGN})
  if(NOT PLUGIN_PACKAGE)
    set(PLUGIN_PACKAGE plugins)
  endif()
  add_library(${type} MODULE ${PLUGIN_UNPARSED_ARGUMENTS})
  set_target_properties(${type} PROPERTIES PREFIX "" OUTPUT_NAME ${type} CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_features(${type} PRIVATE cxx_std_20)
  target_link_libraries(${type} PRIVATE Hyperlattice::kernels)
  if(TARGET hyperlattice_flags) # plugins of this project
    target_link_libraries(${type} PRIVATE hyperlattice_flags)
    set_target_properties(${type} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/hyperlattice)
    install(TARGETS ${type} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/hyperlattice COMPONENT ${PLUGIN_PACKAGE})
  endif()
endfunction()

function(hyperlattice_add_material type)
  cmake_parse_arguments(ARG "" "" "LAW" ${ARGN})
  list(POP_FRONT ARG_LAW header)
  list(LENGTH ARG_LAW laws)
  set(define HYPERLATTICE_KERNELS)
  if(laws GREATER 1)
    set(define HYPERLATTICE_KERNELS_OF)
  endif()
  hyperlattice_add_plugin(${type} ${ARG_UNPARSED_ARGUMENTS})
  target_include_directories(${type} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  hyperlattice_kernel_flags()
  if(HYPERLATTICE_COVERAGE) # lines of optimised loops lose their counts
    list(TRANSFORM kernel_flags REPLACE "-O3" "-O1")
  endif()
  # Kernels would take many minutes to compile with sanitizers. Sanitizers still check the callers
  # of kernels.
  if(HYPERLATTICE_SANITIZE)
    foreach(variant ${variants})
      list(APPEND flags_${variant} -fno-sanitize=all)
    endforeach()
  endif()
  foreach(law ${ARG_LAW})
    string(REPLACE "::" "_" law_name ${law})
    foreach(variant ${variants})
      set(file ${CMAKE_CURRENT_BINARY_DIR}/${type}.${law_name}.${variant}.cpp)
      file(CONFIGURE OUTPUT ${file} @ONLY CONTENT
"// Generated: the kernels of @law@ for the instruction set '@variant@'.
#define HYPERLATTICE_INSTRUCTIONS @variant@
#include <hyperlattice/kernels/law_kernels.hpp>
#include \"@header@\"
@define@(@law@)
")
      target_sources(${type} PRIVATE ${file})
      set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS
        "${flags_${variant}};${kernel_flags}")
    endforeach()
  endforeach()
  if("avx2" IN_LIST variants)
    target_compile_definitions(${type} PRIVATE HYPERLATTICE_X86_KERNELS)
  endif()
endfunction()
