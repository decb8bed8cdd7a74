# What `cmake --install` puts where, and the Debian package that `./run package` makes of it.
include(GNUInstallDirs)

# Programs find their data in share/menger beside the folder that they lie in, wherever that is (io/study/installed_folders.h): in
# a build through links into the sources.
cmake_path(GET CMAKE_INSTALL_BINDIR PARENT_PATH MENGER_DATADIR)
cmake_path(APPEND MENGER_DATADIR share menger)
set(MENGER_DATA_FOLDERS materials/data voxel/parameters)
set(MENGER_DATA_NAMES materials parameters)
foreach(source name IN ZIP_LISTS MENGER_DATA_FOLDERS MENGER_DATA_NAMES)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/menger)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${source} ${CMAKE_BINARY_DIR}/share/menger/${name} SYMBOLIC)
  install(DIRECTORY ${source}/ DESTINATION ${MENGER_DATADIR}/${name} FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv")
endforeach()

install(PROGRAMS io/vtk/open_in_paraview.py DESTINATION ${MENGER_DATADIR})
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
# All texts with their pictures, where the target texts was built.
find_program(MENGER_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(MENGER_PYTHON)
  add_custom_target(texts COMMAND ${MENGER_PYTHON} -B ${PROJECT_SOURCE_DIR}/cmake/docs/make_docs.py --texts ${CMAKE_BINARY_DIR}/share/doc/menger VERBATIM)
endif()
install(DIRECTORY ${CMAKE_BINARY_DIR}/share/doc/menger/ DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
# Studies to begin with, beside each other as in the sources, since they name one another.
foreach(folder fem/studies meshes/designs voxel/curves voxel/parameters voxel/scenes voxel/studies paper/demo)
  get_filename_component(parent ${folder} DIRECTORY)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples/${parent})
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES cmake/completion/menger.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME menger)

# The man page of a program says what its --help says. help2man writes it when the programs are built, where it is there.
find_program(MENGER_HELP2MAN help2man)
if(NOT MENGER_HELP2MAN)
  message(STATUS "help2man is missing: there will be no man pages")
endif()

# Installs a program, its man page and its completion: menger_install_program(menger-simulate).
function(menger_install_program name)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(NOT name STREQUAL menger)
    set(completion ${CMAKE_BINARY_DIR}/share/bash-completion/completions/${name})
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/bash-completion/completions)
    file(CREATE_LINK menger ${completion} SYMBOLIC)
    install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  endif()
  if(NOT MENGER_HELP2MAN)
    return()
  endif()
  set(page ${CMAKE_BINARY_DIR}/share/man/man1/${name}.1)
  add_custom_command(
    OUTPUT ${page}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${name}> -DPAGE=${page} -DHELP2MAN=${MENGER_HELP2MAN}
            -DEXAMPLES=${CMAKE_INSTALL_DOCDIR}/examples -P ${PROJECT_SOURCE_DIR}/cmake/man_page.cmake
    DEPENDS ${name} ${PROJECT_SOURCE_DIR}/cmake/man_page.cmake
    VERBATIM)
  add_custom_target(man-${name} DEPENDS ${page})
  if(NOT TARGET man)
    add_custom_target(man)
  endif()
  add_dependencies(man man-${name})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
endfunction()

# Only what was built by name is there to be packed: the programs, and no test.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME menger)
set(CPACK_PACKAGE_CONTACT "The menger authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "evolve, simulate and evaluate pneumatic soft robots")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Pneumatic soft robots are evolved in voxel simulators, because these are fast.
A body of silicone may move differently. menger computes both, with
hyperelastic finite elements of the hollow body under pressure and with a
surrogate of masses and beams, and tells how far they disagree.")
# The libraries follow from the programs. Xvfb draws pictures where there is no screen; Open MPI starts processes even where there is one.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libopenblas0-serial, openmpi-bin, xvfb, xauth, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libjs-three, ffmpeg, bash-completion")
include(CPack)
