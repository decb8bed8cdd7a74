# Packages of Debian that menger stands on; which room links which, the rooms say.
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(SQLiteCpp REQUIRED)
find_package(TBB REQUIRED)
find_package(Threads REQUIRED)
# Headers only; the target of Debian's package would also link xtl, which we do not use.
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp REQUIRED)

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Ceres REQUIRED)
find_package(glog REQUIRED)  # in which Ceres writes its log
find_package(Boost 1.74 REQUIRED)  # headers of Boost.Math
find_package(SUNDIALS 6.4 REQUIRED COMPONENTS arkode ida kinsol)

find_package(VTK 9.1 REQUIRED COMPONENTS ChartsCore CommonColor CommonCore CommonDataModel FiltersCore FiltersGeneral FiltersGeometry FiltersSources
                                         IOImage IOXML IOXMLParser ImagingCore RenderingAnnotation RenderingContext2D RenderingContextOpenGL2
                                         RenderingCore RenderingFreeType RenderingOpenGL2)
find_package(X11 REQUIRED)
find_package(OpenGL REQUIRED)

# The package of Gmsh has no CMake configuration.
find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)

find_package(deal.II 9.4 REQUIRED)
include(${DEAL_II_TARGET_CONFIG})
find_package(PkgConfig REQUIRED)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
pkg_check_modules(SLEPC REQUIRED IMPORTED_TARGET SLEPc)
# Their macros of hardening would keep what links them from using precompiled headers.
foreach(library PETSC SLEPC)
  get_target_property(options PkgConfig::${library} INTERFACE_COMPILE_OPTIONS)
  list(FILTER options EXCLUDE REGEX "^-D_FORTIFY_SOURCE|^-Wdate-time")
  set_target_properties(PkgConfig::${library} PROPERTIES INTERFACE_COMPILE_OPTIONS "${options}")
endforeach()
find_package(MPI REQUIRED COMPONENTS C CXX)
