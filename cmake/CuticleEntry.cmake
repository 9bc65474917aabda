# Registries. A model, a shadow method, a sim effect or a render pass is one folder with one call:
#   cuticle_entry(MODULE NAME SOURCES a.cpp [GPU_SOURCES a_gpu.cpp] [SHADERS a.comp] [LIBS targets] [GPU_LIBS targets])
# It belongs to the registry of the folder above it, so that a module can have several (lut: layouts, formats, targets).
# Its C++ gives `cuticle::MODULE::NAME::entry()`, and with GPU_SOURCES `cuticle::MODULE::NAME::gpu_entry()`.
# cuticle_discover(MODULE TYPE GPU_TYPE FUNCTION [FOLDER sub]) walks the folders and writes the tables that
# define `std::span<const TYPE* const> FUNCTION()` and `gpu_FUNCTION()`.
function(cuticle_entry MODULE NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;GPU_SOURCES;SHADERS;LIBS;GPU_LIBS" ${ARGN})
  get_filename_component(registry ${CMAKE_CURRENT_SOURCE_DIR} DIRECTORY)
  list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(TRANSFORM ARG_GPU_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(ARG_SOURCES)
    target_sources(cuticle_${MODULE} PRIVATE ${ARG_SOURCES})
    target_link_libraries(cuticle_${MODULE} PRIVATE ${ARG_LIBS})
    set_property(GLOBAL APPEND PROPERTY CUTICLE_ENTRIES_${registry} ${NAME})
  endif()
  if(ARG_GPU_SOURCES AND CUTICLE_GPU)
    target_sources(cuticle_${MODULE}_gpu PRIVATE ${ARG_GPU_SOURCES})
    target_link_libraries(cuticle_${MODULE}_gpu PRIVATE ${ARG_GPU_LIBS})
    foreach(shader ${ARG_SHADERS})
      cuticle_shader(cuticle_${MODULE}_gpu ${shader})
    endforeach()
    set_property(GLOBAL APPEND PROPERTY CUTICLE_GPU_ENTRIES_${registry} ${NAME})
  endif()
endfunction()

function(cuticle_write_table MODULE TYPE FUNCTION ENTRY HEADER NAMES OUT)
  set(declarations "")
  set(list "")
  foreach(name ${NAMES})
    string(APPEND declarations "namespace cuticle::${MODULE}::${name} { const ${TYPE}& ${ENTRY}(); }\n")
    string(APPEND list "    &${name}::${ENTRY}(),\n")
  endforeach()
  file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT "// Written by cmake/CuticleEntry.cmake from the folders of ${MODULE}.
#include ${HEADER}
${declarations}namespace cuticle::${MODULE} {
std::span<const ${TYPE}* const> ${FUNCTION}() {
  static const std::vector<const ${TYPE}*> table = {
${list}  };
  return table;
}
}
")
endfunction()

# cuticle_discover(MODULE TYPE <header> FUNCTION [GPU_TYPE <gpu header>] [FOLDER sub])
function(cuticle_discover MODULE)
  cmake_parse_arguments(ARG "" "TYPE;HEADER;FUNCTION;GPU_TYPE;GPU_HEADER;FOLDER" "" ${ARGN})
  get_filename_component(registry ${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER} ABSOLUTE)
  file(GLOB folders CONFIGURE_DEPENDS ${registry}/*/CMakeLists.txt)
  foreach(file ${folders})
    get_filename_component(folder ${file} DIRECTORY)
    add_subdirectory(${folder})
  endforeach()
  if(ARG_TYPE)
    get_property(names GLOBAL PROPERTY CUTICLE_ENTRIES_${registry})
    set(out ${CMAKE_BINARY_DIR}/generated/${MODULE}_${ARG_FUNCTION}_table.cpp)
    cuticle_write_table(${MODULE} ${ARG_TYPE} ${ARG_FUNCTION} entry ${ARG_HEADER} "${names}" ${out})
    target_sources(cuticle_${MODULE} PRIVATE ${out})
  endif()
  if(ARG_GPU_TYPE AND CUTICLE_GPU)
    get_property(names GLOBAL PROPERTY CUTICLE_GPU_ENTRIES_${registry})
    set(out ${CMAKE_BINARY_DIR}/generated/${MODULE}_gpu_${ARG_FUNCTION}_table.cpp)
    cuticle_write_table(${MODULE} ${ARG_GPU_TYPE} gpu_${ARG_FUNCTION} gpu_entry ${ARG_GPU_HEADER} "${names}" ${out})
    target_sources(cuticle_${MODULE}_gpu PRIVATE ${out})
  endif()
endfunction()
