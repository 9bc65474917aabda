# Units of batch code: a source compiled once for each instruction set of core/instruction_set.h, in that order, the best that the
# processor has taken at run time.
set(CUTICLE_BATCH_SETS baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT CUTICLE_SANITIZE)  # the same source: instrumented once
  list(APPEND CUTICLE_BATCH_SETS avx2 avx512)
endif()
# g++ otherwise keeps a long block in the order of the source and waits for each result: a fifth to a quarter of the time.
set(CUTICLE_BATCH_SCHEDULE "$<$<CXX_COMPILER_ID:GNU>:-fschedule-insns;-fsched-pressure>")
set(CUTICLE_BATCH_OPTIONS_avx2 -march=x86-64-v3)
set(CUTICLE_BATCH_OPTIONS_avx512 -march=x86-64-v4 -mprefer-vector-width=512)

# cuticle_batch_unit(MODULE UNIT SOURCE SET): one such object in the library of MODULE, compiled with CUTICLE_BATCH and the flags without
# which the compiler makes no vectors. Its file is appended to the property CUTICLE_BATCH_UNITS_MODULE, which cuticle_check_batch_units reads.
function(cuticle_batch_unit MODULE UNIT SOURCE SET)
  add_library(${UNIT} OBJECT ${SOURCE})
  target_include_directories(${UNIT} PRIVATE ${CUTICLE_INCLUDE_DIR})
  target_compile_definitions(${UNIT} PRIVATE CUTICLE_BATCH CUTICLE_BATCH_SET=${SET})
  target_compile_options(${UNIT} PRIVATE -O3 -fopenmp-simd -fno-math-errno -fno-trapping-math -ffp-contract=fast
    "${CUTICLE_BATCH_SCHEDULE}" ${CUTICLE_BATCH_OPTIONS_${SET}} ${CUTICLE_WARNINGS})
  target_sources(cuticle_${MODULE} PRIVATE $<TARGET_OBJECTS:${UNIT}>)
  set_property(GLOBAL APPEND PROPERTY CUTICLE_BATCH_UNITS_${MODULE} $<TARGET_OBJECTS:${UNIT}>)
endfunction()

# A test that the units of MODULE leave no code that the linker could take for that of another instruction set.
function(cuticle_check_batch_units MODULE)
  if(CUTICLE_TESTS AND CMAKE_NM AND NOT CUTICLE_SANITIZE AND NOT CUTICLE_COVERAGE)
    get_property(units GLOBAL PROPERTY CUTICLE_BATCH_UNITS_${MODULE})
    add_test(NAME batch_units_${MODULE} COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} "-DOBJECTS=$<JOIN:${units},|>" -P
      ${PROJECT_SOURCE_DIR}/cmake/check_batch_units.cmake)
  endif()
endfunction()
