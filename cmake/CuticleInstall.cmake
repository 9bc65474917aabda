# Installs libraries, headers (beside their module names) and the package, and writes the link graph that a test reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(cuticle_targets GLOBAL PROPERTY CUTICLE_TARGETS)
install(TARGETS ${cuticle_targets} EXPORT cuticleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS cuticle_pictures LIBRARY DESTINATION lib)
if(TARGET cuticle_views)
  install(TARGETS cuticle_views LIBRARY DESTINATION lib)
endif()
install(TARGETS cuticle RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT cuticleTargets NAMESPACE cuticle:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cuticle)
foreach(module core strands gpu bsdf lut shadows sim render scene plan study)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${module} DESTINATION include/cuticle
    FILES_MATCHING PATTERN "*.h" PATTERN "*.glslh" PATTERN detail EXCLUDE PATTERN tests EXCLUDE PATTERN "test_*.h" EXCLUDE)
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/cuticleConfig.cmake.in
  ${CMAKE_BINARY_DIR}/cuticleConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cuticle)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/cuticleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/cuticleConfig.cmake ${CMAKE_BINARY_DIR}/cuticleConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cuticle)

set(graph "")
foreach(target ${cuticle_targets} cuticle)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  string(APPEND graph "${target}: ${libraries}\n")
endforeach()
foreach(part viz viz_vtk play)
  if(TARGET cuticle_${part})
    get_target_property(libraries cuticle_${part} LINK_LIBRARIES)
    string(APPEND graph "cuticle_${part}: ${libraries}\n")
  endif()
endforeach()
file(WRITE ${CMAKE_BINARY_DIR}/generated/link_graph.txt "${graph}")
