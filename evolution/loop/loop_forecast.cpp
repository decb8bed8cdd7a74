#include "evolution/loop/loop_forecast.h"

#include <algorithm>
#include <filesystem>

#include "io/shown/shown_quantity.h"
#include "io/study/installed_folders.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/study_law.h"
#include "meshes/robot/calibration_cases.h"
#include "meshes/robot/known_parameters.h"
#include "voxel/model/expected_errors.h"
#include "voxel/model/surrogate_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

std::string of_these_cells(const meshes::Robot& robot) {
  return "cells of " + io::millimetres(robot.design.cell_edge_m, 4) + " with walls of " +
         io::millimetres(robot.wall_thickness_m, 4) + " in " + robot.record.name +
         (robot.law_name == materials::recommended_law_name ? ""
                                                            : " by the law " + std::string(materials::name_of(robot.law.law)));
}

std::string source_text(const meshes::Robot& robot, const fs::path& parameters) {
  switch (parameter_source(robot)) {
    case meshes::ParameterSource::given:
      return "surrogate: voxels with the parameters of " + parameters.string();
    case meshes::ParameterSource::known:
      return "surrogate: voxels with the parameters that come with menger for " + of_these_cells(robot) + " (" +
             parameters.filename().string() + "); --fit fits them anew";
    case meshes::ParameterSource::fitted:
      return "surrogate: " +
             std::string(robot.fits_anew ? "parameters are fitted anew for " : "menger comes with no parameters for ") +
             of_these_cells(robot) + (robot.fits_anew ? "" : ": they are fitted") +
             ", which takes some five minutes of an idle machine; --until limit ends before";
  }
  return "";
}

/// Cells with less air than this between their walls, over their thickness, need pressures that no one means.
constexpr double least_span_of_walls = 0.5;

std::string thick_wall_note(const meshes::Robot& robot) {
  if (robot.span_m() >= least_span_of_walls * robot.wall_thickness_m) return "";
  std::string text = "note: walls of " + io::millimetres(robot.wall_thickness_m) + " leave " + io::millimetres(robot.span_m()) +
                     " of air between them, which is hardly a chamber";
  if (!robot.pressure_Pa)
    text += "; the default pressure of " + io::kilopascals(drive_pressure_Pa(robot)[1]) + " follows from that";
  return text;
}

std::string other_law_note(const meshes::Robot& robot) {
  if (robot.pressure_Pa || robot.law_name == materials::recommended_law_name) return "";
  return "note: drive.pressure_Pa is not given, so that " + io::kilopascals(drive_pressure_Pa(robot)[1]) +
         " follows from this law; give it to compare laws at one pressure";
}

constexpr const char* measured_later =
    "; the stage validate measures it on this very body. Distances that the surrogate walks cannot be trusted";

/// Up to this frequency pneumatic robots of this size are driven.
constexpr double usual_drives_Hz = 20.0;

/// What the load cases of a fit have not, and a robot has.
std::vector<std::string> gaps_of_fit(const meshes::Robot& robot) {
  std::vector<std::string> gaps;
  if (meshes::chamber_count(robot) > 1) gaps.emplace_back("it has several chambers, and the bodies of the fit have one each");
  const meshes::Polycube& body = robot.design.body;
  const int longest = std::max({body.nx(), body.ny(), body.nz()});
  if (const int fitted = meshes::longest_fitted_body_cells(); longest > fitted)
    gaps.push_back("it is " + std::to_string(longest) + " cells long, and the longest of the fit " + std::to_string(fitted));
  return gaps;
}

std::string fast_drive_note(const meshes::Robot& robot) {
  if (robot.drive == meshes::RobotDrive::hold || robot.frequency_Hz <= usual_drives_Hz) return "";
  return "note: drive.frequency_Hz = " + io::shown(robot.frequency_Hz) +
         " is computed as if the air followed at once; no valve and tube is in the way";
}

}  // namespace

std::vector<std::string> loop_forecast(const meshes::Robot& robot, const meshes::RobotPlaces& places, bool is_found) {
  const bool has_known_body = robot.has_body() && (is_found || !robot.evolves);
  const fs::path file = parameters_of(robot, places);
  std::vector<std::string> lines{law_summary_of(robot), source_text(robot, file)};
  for (const std::string& note : robot.notes) lines.push_back("note: " + note);
  for (const std::string& note : {other_law_note(robot), thick_wall_note(robot), fast_drive_note(robot)}) {
    if (!note.empty()) lines.push_back(note);
  }
  if (!io::is_file(file)) {
    if (parameter_source(robot) == meshes::ParameterSource::given) {
      throw io::InputError(robot.file.string() + ": surrogate.parameters = \"" + robot.parameters->string() +
                           "\": there is no such file; " + io::joined(io::data_names(io::parameter_data), ", ") +
                           " come with menger");
    }
    if (has_known_body) {
      for (const std::string& gap : gaps_of_fit(robot)) lines.push_back("warning: the fit will not cover this body: " + gap);
    }
    lines.push_back("expected error: not known before the fit" + std::string(measured_later));
    return lines;
  }
  voxel::CalibratedBody body;
  if (parameter_source(robot) == meshes::ParameterSource::fitted) {
    // A fit that failed leaves parameters that nothing may use; its stage says so.
    try {
      body.parameters = voxel::read_surrogate(file);
    } catch (const io::InputError&) {
      return lines;
    }
  } else {
    body.parameters = voxel::read_surrogate(file);
  }
  if (const std::vector<std::string> others = meshes::other_subject_of(file, robot); !others.empty()) {
    lines.push_back("warning: " + file.filename().string() +
                    " was fitted for something else (holds_for): " + io::joined(others, ", "));
    lines.push_back("expected error: not known for this silicone and these cells" + std::string(measured_later));
    return lines;
  }
  body.pressure_Pa = drive_pressure_Pa(robot);
  body.chambers = robot.chambers;
  const voxel::KnownErrors known = voxel::known_errors(body.parameters, file);
  const std::vector<std::string> expected =
      has_known_body ? expected_error_text(known, body, robot.design.body) : expected_error_text(known, false);
  lines.insert(lines.end(), expected.begin(), expected.end());
  return lines;
}

}  // namespace menger::evolution
