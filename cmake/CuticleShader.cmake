# GLSL is compiled at build time and embedded; nothing is compiled at run time and no SPIR-V is stored.
# cuticle_shader(TARGET file.comp [NAME name] [DEFINES A=1 ...] [INCLUDES dir ...])
# makes <name.spv.h> with `const uint32_t name[]`, visible to TARGET; NAME defaults to the file name with '.' -> '_'.
function(cuticle_shader TARGET FILE)
  cmake_parse_arguments(ARG "" "NAME" "DEFINES;INCLUDES;DEPENDS" ${ARGN})
  get_filename_component(source ${FILE} ABSOLUTE)
  if(NOT ARG_NAME)
    get_filename_component(ARG_NAME ${FILE} NAME)
    string(REPLACE "." "_" ARG_NAME ${ARG_NAME})
  endif()
  set(header ${CMAKE_BINARY_DIR}/shaders/${ARG_NAME}.spv.h)
  set(flags -I${CUTICLE_INCLUDE_DIR})
  foreach(dir ${ARG_INCLUDES})
    list(APPEND flags -I${dir})
  endforeach()
  foreach(define ${ARG_DEFINES})
    list(APPEND flags -D${define})
  endforeach()
  add_custom_command(OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/shaders
    COMMAND ${GLSLANG_VALIDATOR} -V --quiet --target-env vulkan1.3 ${flags} --vn ${ARG_NAME}
            --depfile ${header}.d -o ${header} ${source}
    DEPENDS ${source} ${ARG_DEPENDS} DEPFILE ${header}.d VERBATIM
    COMMENT "Shader ${ARG_NAME}")
  # A target of its own, because the folder of an entry is not the folder of the module's target.
  add_custom_target(shader_${ARG_NAME} DEPENDS ${header})
  add_dependencies(${TARGET} shader_${ARG_NAME})
endfunction()
