# One library per module. An include names a file from the repository's root: "bsdf/model.h".
set(CUTICLE_INCLUDE_DIR ${PROJECT_SOURCE_DIR})
set_property(GLOBAL PROPERTY CUTICLE_TARGETS "")

# Parses the standard library and fmt once for all libraries and instantiates their templates there. GCC gains nothing by
# it, and would no longer notice a file that lacks an include.
option(CUTICLE_PRECOMPILED "Parse common headers once" OFF)
set(CUTICLE_COMMON_DEFINITIONS $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
if(CUTICLE_PRECOMPILED)
  add_library(cuticle_common_headers OBJECT ${PROJECT_SOURCE_DIR}/cmake/empty.cpp)
  target_compile_features(cuticle_common_headers PRIVATE cxx_std_20)
  target_compile_definitions(cuticle_common_headers PRIVATE ${CUTICLE_COMMON_DEFINITIONS})
  target_link_libraries(cuticle_common_headers PRIVATE cuticle_warnings)
  target_precompile_headers(cuticle_common_headers PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <map>
    <memory> <numbers> <optional> <span> <string> <string_view> <vector> <fmt/format.h> <fmt/ranges.h>)
endif()

# Twelve sources of a target compile as one, in two fifths of the time: most of it is the parsing of headers and the
# instantiation of the same templates. The price is a longer step after a small change, and that a file which lacks an
# include goes unnoticed, so `dev` compiles each alone, and CUTICLE_ALONE the libraries that one works on.
option(CUTICLE_UNITY "Compile the sources of a library in groups" OFF)
set(CUTICLE_ALONE "" CACHE STRING "Libraries whose sources compile each alone even so: cuticle_strands;cuticle_shadows")
function(cuticle_group_sources TARGET)
  if(CUTICLE_UNITY AND NOT "${TARGET}" IN_LIST CUTICLE_ALONE)
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endfunction()

# cuticle_library(NAME SOURCES ... DEPENDS cuticle targets (public) ... PRIVATE external or hidden targets ...)
# makes the target cuticle_NAME with the alias cuticle::NAME. OWN_FLAGS: its compiler flags differ, so that it cannot share what the others have parsed.
function(cuticle_library NAME)
  cmake_parse_arguments(ARG "NO_INSTALL;OWN_FLAGS" "" "SOURCES;DEPENDS;PRIVATE" ${ARGN})
  if(NOT ARG_SOURCES)
    set(ARG_SOURCES ${PROJECT_SOURCE_DIR}/cmake/empty.cpp)
  endif()
  add_library(cuticle_${NAME} STATIC ${ARG_SOURCES})
  add_library(cuticle::${NAME} ALIAS cuticle_${NAME})
  set_target_properties(cuticle_${NAME} PROPERTIES EXPORT_NAME ${NAME})
  cuticle_group_sources(cuticle_${NAME})
  target_compile_features(cuticle_${NAME} PUBLIC cxx_std_20)
  target_include_directories(cuticle_${NAME} PUBLIC
    $<BUILD_INTERFACE:${CUTICLE_INCLUDE_DIR}> $<INSTALL_INTERFACE:include> $<INSTALL_INTERFACE:include/cuticle>)
  target_include_directories(cuticle_${NAME} PRIVATE ${CMAKE_BINARY_DIR}/shaders ${CMAKE_BINARY_DIR}/generated)
  target_link_libraries(cuticle_${NAME} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:cuticle_warnings>)
  if(CUTICLE_PRECOMPILED AND NOT ARG_OWN_FLAGS)
    target_compile_definitions(cuticle_${NAME} PRIVATE ${CUTICLE_COMMON_DEFINITIONS})
    target_precompile_headers(cuticle_${NAME} REUSE_FROM cuticle_common_headers)
  endif()
  if(NOT ARG_NO_INSTALL)
    set_property(GLOBAL APPEND PROPERTY CUTICLE_TARGETS cuticle_${NAME})
  endif()
endfunction()
