# Fitting surrogates to response curves, apart from the surrogate because of the solver. No program that simulates or searches links it.
find_package(Ceres REQUIRED)
find_package(glog REQUIRED)  # in which Ceres writes its log
find_package(Eigen3 REQUIRED NO_MODULE)

menger_layer(calibration
  SOURCES calibration.cpp calibration_confidence.cpp calibration_curves.cpp calibration_damping.cpp calibration_data.cpp calibration_evaluation.cpp calibration_fit.cpp
          calibration_parameters.cpp calibration_quantities.cpp calibration_report.cpp calibration_search.cpp calibration_start.cpp calibration_study.cpp calibration_tables.cpp identifiability.cpp responder.cpp
  LINK menger::voxel menger::material_fit Eigen3::Eigen
  PRIVATE_LINK Ceres::ceres glog::glog TBB::tbb)

menger_layer(calibration_run SOURCES calibration_chart.cpp calibration_frequency.cpp calibration_run.cpp LINK menger::calibration menger::voxel_statics menger::picture
  PRIVATE_LINK nlohmann_json::nlohmann_json)

menger_program(menger-calibrate SOURCES apps/menger-calibrate.cpp LINK menger::calibration_run CLI11::CLI11)
