# One library per layer: menger_layer(voxel SOURCES a.cpp LINK menger::meshes) makes menger_voxel with the alias menger::voxel.
function(menger_layer name)
  cmake_parse_arguments(LAYER "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(menger_${name} STATIC ${LAYER_SOURCES})
  add_library(menger::${name} ALIAS menger_${name})
  target_include_directories(menger_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(menger_${name} PUBLIC ${LAYER_LINK} PRIVATE ${LAYER_PRIVATE_LINK} menger_warnings)
endfunction()

# One program: menger_program(menger-simulate SOURCES apps/menger-simulate.cpp LINK menger::voxel).
function(menger_program name)
  cmake_parse_arguments(PROGRAM "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${PROGRAM_SOURCES})
  target_link_libraries(${name} PRIVATE ${PROGRAM_LINK} menger_warnings)
endfunction()
