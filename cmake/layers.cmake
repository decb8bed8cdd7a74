# One target per room: menger_room(voxel/engine SOURCES a.cpp LINK menger::voxel_kernels) makes menger_voxel_engine with the alias
# menger::voxel_engine. What has to stay apart in a room because of a library is a PART: menger_room(materials/fit PART chart ...)
# makes menger::materials_fit_chart.
function(menger_room room)
  cmake_parse_arguments(ROOM "" "PART" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  string(REPLACE "/" "_" name ${room})
  if(ROOM_PART)
    string(APPEND name "_${ROOM_PART}")
  endif()
  menger_library(${name} SOURCES ${ROOM_SOURCES} LINK ${ROOM_LINK} PRIVATE_LINK ${ROOM_PRIVATE_LINK})
endfunction()

# A library with our include paths and warnings and an alias: menger_library(extremes SOURCES a.cpp LINK menger::io_text).
function(menger_library name)
  cmake_parse_arguments(LIBRARY "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  if(NOT LIBRARY_SOURCES)  # headers alone
    add_library(menger_${name} INTERFACE)
    add_library(menger::${name} ALIAS menger_${name})
    target_include_directories(menger_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(menger_${name} INTERFACE ${LIBRARY_LINK})
    return()
  endif()
  add_library(menger_${name} STATIC ${LIBRARY_SOURCES})
  add_library(menger::${name} ALIAS menger_${name})
  target_include_directories(menger_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(menger_${name} PUBLIC ${LIBRARY_LINK} PRIVATE ${LIBRARY_PRIVATE_LINK} menger_warnings)
endfunction()

# One program: menger_program(menger-simulate SOURCES apps/menger-simulate.cpp LINK menger::voxel_simulate).
function(menger_program name)
  cmake_parse_arguments(PROGRAM "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${PROGRAM_SOURCES})
  target_link_libraries(${name} PRIVATE ${PROGRAM_LINK} menger_warnings)
endfunction()

# Kernels of a room for several instruction sets in one binary, of which one is chosen at run time: NAME_avx2.cpp and NAME_avx512.cpp,
# with SSE2 also NAME_sse2.cpp, with FMA compiled for fused multiplication and addition. No other file is compiled for more than the baseline.
function(menger_kernels target)
  cmake_parse_arguments(KERNELS "SSE2;FMA" "" "NAMES" ${ARGN})
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    return()
  endif()
  set(fma $<$<BOOL:${KERNELS_FMA}>:-mfma>)
  foreach(name IN LISTS KERNELS_NAMES)
    if(KERNELS_SSE2)
      target_sources(${target} PRIVATE ${name}_sse2.cpp)
    endif()
    target_sources(${target} PRIVATE ${name}_avx2.cpp ${name}_avx512.cpp)
    set_source_files_properties(${name}_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2;${fma}")
    # GCC 12 takes the deliberately undefined pass-through operand of its own AVX-512 intrinsics for an uninitialised variable.
    set_source_files_properties(${name}_avx512.cpp PROPERTIES COMPILE_OPTIONS
      "-mavx512f;-mavx512dq;${fma};-mprefer-vector-width=512;-Wno-uninitialized;-Wno-maybe-uninitialized")
  endforeach()
  target_compile_definitions(${target} PRIVATE MENGER_X86_KERNELS)
endfunction()

# Links deal.II: its debug library, with assertions, for Debug builds. Its own way, deal_ii_setup_target, would take our language level
# and optimisation back.
function(menger_link_deal_ii target)
  target_include_directories(${target} SYSTEM PRIVATE ${DEAL_II_INCLUDE_DIRS})
  if(CMAKE_BUILD_TYPE STREQUAL Debug)
    target_compile_definitions(${target} PRIVATE DEBUG)
    target_link_libraries(${target} PRIVATE ${DEAL_II_TARGET_DEBUG})
  else()
    target_link_libraries(${target} PRIVATE ${DEAL_II_TARGET_RELEASE})
  endif()
endfunction()
