# Language level, warnings and output folders, the same for every target of ours.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

option(MENGER_WERROR "Treat warnings as errors" OFF)

add_library(menger_warnings INTERFACE)
# A local variable of a test may have the name of a constant of another test that is compiled together with it.
set(shadow "-Wshadow$<$<BOOL:$<TARGET_PROPERTY:MENGER_HIDES_OTHER_TESTS>>:=local>")
set(warnings -Wall -Wextra -Wpedantic ${shadow} -Wconversion -Wsign-conversion
             -Wnon-virtual-dtor -Woverloaded-virtual $<$<BOOL:${MENGER_WERROR}>:-Werror>)
target_compile_options(menger_warnings INTERFACE "$<$<COMPILE_LANGUAGE:C,CXX>:${warnings}>")

# GCC 12 sees overlapping copies in "literal" + std::to_string(x) where there are none.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict>)

# Results must not depend on how a compiler fuses multiplications and additions.
add_compile_options($<$<COMPILE_LANGUAGE:C,CXX>:-ffp-contract=off>)

# Eigen takes another allocator where a sanitizer is on, which must not meet the one inside of Debian's Ceres; glibc aligns for both.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# The default linker of Debian 12 takes 15 s for each program with deal.II, gold of the same package 1 s.
include(CheckLinkerFlag)
option(MENGER_GOLD "Link with gold where it is there" ON)
if(MENGER_GOLD)
  check_linker_flag(CXX -fuse-ld=gold MENGER_HAS_GOLD)
  if(MENGER_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()
