# Scenes, their runs and their output. The search links voxel_scene only: VTK stays out of it.
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel FiltersSources IOXML IOXMLParser RenderingCore RenderingFreeType)

menger_layer(voxel_scene
  SOURCES body_pieces.cpp calibrated_body_file.cpp physics_file.cpp scene.cpp scene_file.cpp trajectory.cpp
  LINK menger::voxel menger::materials menger::polycube menger::io)

menger_layer(voxel_vtk
  SOURCES collection.cpp cube.cpp picture_parts.cpp picture_view.cpp preview.cpp trajectory_plot.cpp vtk_output.cpp
  LINK menger::voxel_scene menger::picture menger::vtk_file
  PRIVATE_LINK ${VTK_LIBRARIES})

menger_layer(voxel_run SOURCES result_text.cpp simulation_run.cpp sliced_run.cpp step_check.cpp LINK menger::voxel_scene menger::voxel_vtk)

menger_program(menger-simulate SOURCES apps/menger-simulate.cpp LINK menger::voxel_run CLI11::CLI11)
