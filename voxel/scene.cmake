# Scenes, their runs and their output. The search links voxel_scene only: VTK stays out of it.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # programs and tests of other folders link these through voxel_vtk
find_package(VTK 9.1 REQUIRED COMPONENTS ChartsCore CommonColor CommonCore CommonDataModel FiltersSources IOImage IOXML IOXMLParser ImagingCore
                                         RenderingContext2D RenderingContextOpenGL2 RenderingCore RenderingFreeType RenderingOpenGL2)
find_package(X11 REQUIRED)
find_package(OpenGL REQUIRED)

menger_layer(voxel_scene
  SOURCES physics_file.cpp scene.cpp scene_file.cpp trajectory.cpp
  LINK menger::voxel menger::materials menger::polycube menger::io)

menger_layer(voxel_vtk
  SOURCES collection.cpp cube.cpp offscreen_display.cpp picture.cpp picture_parts.cpp picture_view.cpp preview.cpp trajectory_plot.cpp vtk_output.cpp
  LINK menger::voxel_scene
  PRIVATE_LINK ${VTK_LIBRARIES} X11::X11 OpenGL::GL)
vtk_module_autoinit(TARGETS menger_voxel_vtk MODULES ${VTK_LIBRARIES})

menger_layer(voxel_run SOURCES result_text.cpp simulation_run.cpp LINK menger::voxel_scene menger::voxel_vtk)

menger_program(menger-simulate SOURCES apps/menger-simulate.cpp LINK menger::voxel_run CLI11::CLI11)
