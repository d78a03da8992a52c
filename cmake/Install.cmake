# The installed tree: program, runtime, plugins, the headers for authors of plugins, and a project
# to start from. Users may move the tree as a whole.
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Hyperlattice)
set(share ${CMAKE_INSTALL_DATADIR}/hyperlattice)

install(TARGETS hyperlattice LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY core/sdk/include/hyperlattice core/kernels/include/hyperlattice DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS hyperlattice_sdk hyperlattice_kernels EXPORT HyperlatticeTargets)
install(EXPORT HyperlatticeTargets NAMESPACE Hyperlattice:: DESTINATION ${package})

configure_package_config_file(cmake/HyperlatticeConfig.cmake.in ${PROJECT_BINARY_DIR}/HyperlatticeConfig.cmake INSTALL_DESTINATION ${package}
                              PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/HyperlatticeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/HyperlatticeConfig.cmake ${PROJECT_BINARY_DIR}/HyperlatticeConfigVersion.cmake
              cmake/HyperlatticePlugin.cmake DESTINATION ${package})

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hyperlattice RENAME copyright)
# The pages of docs link to these files.
install(FILES README.md CONTRIBUTING.md CHANGELOG.md CITATION.cff DESTINATION ${share})
foreach(folder docs scenes)
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${folder}/ DESTINATION ${share}/${folder} FILES_MATCHING PATTERN "*.md" PATTERN "*.csv" PATTERN "*.json" PATTERN "*.png" PATTERN "*.svg"
            PATTERN "*.py" PATTERN "*.ipynb" PATTERN site EXCLUDE)
  endif()
endforeach()

# The program compiles plugins that are one source file with the settings of hyperlattice_add_plugin
# and hyperlattice_add_material. It reads them from the file compile_flags beside the plugins.
hyperlattice_kernel_flags()
list(JOIN kernel_flags " " words)
set(compile_flags "plugin -std=c++20 -O2 -DNDEBUG -fPIC -fvisibility=hidden -fvisibility-inlines-hidden -fdiagnostics-color=never\nkernels ${words}\n")
foreach(variant ${variants})
  list(JOIN flags_${variant} " " words)
  string(APPEND compile_flags "instructions ${variant} ${words}\n")
endforeach()
file(RELATIVE_PATH headers "/${CMAKE_INSTALL_LIBDIR}/hyperlattice" "/${CMAKE_INSTALL_INCLUDEDIR}")
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/lib/hyperlattice/compile_flags
     CONTENT "include ${PROJECT_SOURCE_DIR}/core/sdk/include\ninclude ${PROJECT_SOURCE_DIR}/core/kernels/include\n${compile_flags}" @ONLY)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/installed/compile_flags CONTENT "include ${headers}\n${compile_flags}" @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/installed/compile_flags DESTINATION ${CMAKE_INSTALL_LIBDIR}/hyperlattice)
