# Comparing surrogates with response curves that no fit has seen.
menger_layer(validation
  SOURCES validation.cpp validation_study.cpp validation_summary.cpp validation_tables.cpp validity.cpp volume_actuation.cpp
  LINK menger::voxel_statics menger::io)

# What if a body had parameters of its own: a fit, and so apart.
menger_layer(validation_cause SOURCES validation_cause.cpp validation_cause_judgement.cpp LINK menger::validation menger::calibration)

find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel FiltersCore FiltersGeneral FiltersGeometry IOXML RenderingCore)
menger_layer(validation_output
  SOURCES body_boxes.cpp kept_fields.cpp rigid_part.cpp side_by_side_picture.cpp validation_charts.cpp validation_run.cpp validation_scene.cpp
  LINK menger::validation menger::validation_cause menger::picture menger::voxel_vtk menger::vtk_file Eigen3::Eigen
  PRIVATE_LINK ${VTK_LIBRARIES})

menger_program(menger-validate SOURCES apps/menger-validate.cpp LINK menger::validation_output CLI11::CLI11)
