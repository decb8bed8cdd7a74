# deal.II, PETSc and SLEPc, for the targets of this folder only.
find_package(deal.II 9.4 REQUIRED)
include(${DEAL_II_TARGET_CONFIG})
find_package(PkgConfig REQUIRED)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET GLOBAL PETSc)
pkg_check_modules(SLEPC REQUIRED IMPORTED_TARGET GLOBAL SLEPc)
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)
find_package(MPI REQUIRED COMPONENTS C CXX)
# tests and programs of other folders link these through ours
set_target_properties(${DEAL_II_TARGET_DEBUG} ${DEAL_II_TARGET_RELEASE} PROPERTIES IMPORTED_GLOBAL TRUE)

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
