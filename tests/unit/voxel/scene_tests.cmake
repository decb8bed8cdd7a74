menger_test(unit_voxel_scene SOURCES bond_damping_test.cpp physics_file_test.cpp scene_file_test.cpp LINK menger::voxel_scene)
menger_test(unit_voxel_output SOURCES preview_test.cpp vtk_output_test.cpp LINK menger::voxel_vtk VTK::IOXML VTK::IOImage)
menger_test(unit_voxel_run SOURCES simulation_run_test.cpp step_check_test.cpp LINK menger::voxel_run)
menger_test(unit_voxel_calibrated_scene SOURCES calibrated_scene_test.cpp LINK menger::voxel_run)
