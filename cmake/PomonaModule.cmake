# pomona_module(NAME SOURCES ... [DEPENDS folder...] [PACKAGES target...] [KERNELS])
#
# One object library per top-level folder. `#include "sgm/matcher.h"` resolves through
# <build>/layers/sgm/sgm -> <source>/sgm, a directory that only the dependants of pomona_sgm have on
# their include path: an include against the layer order does not compile.
#
# KERNELS compiles NAME/kernels/target_<isa>.cc once per instruction set, each with its own flags. A folder without one
# for an instruction set uses its scalar kernels there: the compiler's vectors of 16 bytes are all that NEON has.

set(POMONA_FLAGS_scalar "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(POMONA_ISAS scalar avx2 avx512 CACHE STRING "Instruction sets to build kernels for")
  set(POMONA_FLAGS_avx2 -mavx2 -mbmi -mbmi2 -mpopcnt -mlzcnt -mtune=haswell)
  set(POMONA_FLAGS_avx512 ${POMONA_FLAGS_avx2} -mavx512f -mavx512bw -mavx512dq -mavx512vl -mavx512vbmi
      -mavx512bitalg -mprefer-vector-width=512 -mtune=icelake-server
      -Wno-maybe-uninitialized)  # GCC 12 warns of its own _mm512_undefined_* (PR 105593)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  set(POMONA_ISAS scalar neon CACHE STRING "Instruction sets to build kernels for")
  set(POMONA_FLAGS_neon "")  # part of every AArch64
else()
  set(POMONA_ISAS scalar CACHE STRING "Instruction sets to build kernels for")
endif()

# Same bytes on every instruction set: no fused multiply-add behind our back, in any file.
add_compile_options(-Wall -Wextra -ffp-contract=off)
if(POMONA_WERROR)
  add_compile_options(-Werror)
endif()
if(POMONA_SANITIZE)
  add_compile_options(-fsanitize=${POMONA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${POMONA_SANITIZE})
endif()

if(POMONA_SANITIZE)
  set(POMONA_KERNEL_FLAGS -O1 -DPOMONA_FEW_KERNELS)
else()
  set(POMONA_KERNEL_FLAGS -O3)
endif()

# The part of pomona_module() that is for kernels, for targets that are no such folder.
function(pomona_add_kernels target)
  foreach(isa IN LISTS POMONA_ISAS)
    set(source kernels/target_${isa}.cc)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${source})
      continue()
    endif()
    target_sources(${target} PRIVATE ${source})
    set_source_files_properties(${source} PROPERTIES
      COMPILE_OPTIONS "${POMONA_FLAGS_${isa}};${POMONA_KERNEL_FLAGS};-fno-trapping-math;-fno-math-errno")
  endforeach()
endfunction()

# Tells the sources which instruction sets there are kernels for.
function(pomona_define_isas target)
  foreach(isa IN LISTS POMONA_ISAS)
    string(TOUPPER ${isa} upper)
    target_compile_definitions(${target} PRIVATE POMONA_WITH_${upper})
  endforeach()
endfunction()

function(pomona_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "KERNELS" "" "SOURCES;DEPENDS;PACKAGES")
  set(target pomona_${name})
  add_library(${target} OBJECT ${arg_SOURCES})
  set(layer ${PROJECT_BINARY_DIR}/layers/${name})
  file(MAKE_DIRECTORY ${layer})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${name} ${layer}/${name} SYMBOLIC)
  target_include_directories(${target} PUBLIC ${layer} ${PROJECT_SOURCE_DIR}/include)
  foreach(folder IN LISTS arg_DEPENDS)
    target_link_libraries(${target} PUBLIC pomona_${folder})
  endforeach()
  target_link_libraries(${target} PRIVATE ${arg_PACKAGES})
  if(arg_KERNELS)
    pomona_add_kernels(${target})
  endif()
  pomona_define_isas(${target})
endfunction()
