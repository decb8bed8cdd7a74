menger_test(unit_voxel_validation
  SOURCES validation_study_test.cpp validation_test.cpp volume_actuation_test.cpp
  LINK menger::validation)
menger_test(unit_voxel_validation_cause SOURCES validation_cause_test.cpp LINK menger::validation_cause LABELS slow)
menger_test(unit_voxel_validation_output
  SOURCES validation_scene_test.cpp
  LINK menger::validation_output VTK::CommonDataModel VTK::IOXML)
