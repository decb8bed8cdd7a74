#include "meshes/robot/robot_studies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "materials/laws/study_law.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/design/modular_body.h"
#include "meshes/robot/calibration_cases.h"
#include "meshes/robot/known_parameters.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

/// Periods of the drive in the walks of a search: the first, in which the pressure grows, and the five that count.
constexpr double search_periods = 6.0;
/// Over the usual pressure: bodies balloon at two to four times as much.
constexpr double highest_of_limit = 10.0;
/// Numbers of a duration after the point, s.
constexpr double duration_digits_per_s = 1e4;

constexpr std::array all_studies{RobotStudy::mesh,           RobotStudy::inflate,   RobotStudy::limit,
                                 RobotStudy::load_cases,     RobotStudy::calibrate, RobotStudy::validate_load_cases,
                                 RobotStudy::validate,       RobotStudy::simulate,  RobotStudy::locomote,
                                 RobotStudy::locomote_finer, RobotStudy::evolve,    RobotStudy::reevaluate};

std::string_view word_of(ChamberLayout layout) { return layout == ChamberLayout::single ? "single" : "per-phase"; }

std::string_view finer(RobotFidelity fidelity) {
  return to_string(fidelity == RobotFidelity::draft ? RobotFidelity::standard : RobotFidelity::fine);
}

/// Returns a path as a study that lies in `folder` names it.
std::string path_from(const fs::path& folder, const fs::path& file) {
  return fs::absolute(file).lexically_normal().lexically_proximate(fs::absolute(folder).lexically_normal()).string();
}

/// Writes the texts of the studies of one robot.
class StudyTexts {
 public:
  StudyTexts(const Robot& robot, const RobotPlaces& places) : robot_(robot), places_(places) {}

  std::string mesh() {
    design(true);
    return text_.text();
  }

  std::string inflate() {
    thin_walls(to_string(robot_.fidelity));
    design(true);
    material();
    supports();
    text_.table("path");
    if (robot_.drive == RobotDrive::antiphase) {
      pressures_in_antiphase();
    } else {
      text_.add("pressure_Pa", std::span<const double>(pressures_in_phase()));
    }
    return text_.text();
  }

  std::string limit() {
    thin_walls(to_string(robot_.fidelity));
    design(true);
    material();
    supports();
    if (robot_.chambers == ChamberLayout::single) {
      // Far beyond the volume at which any silicone passes its limit point; steps of a few tenths of the volume at rest.
      text_.table("path").raw("volume_ratio", "[1, 40]").add("end_at_limit_point", true);
    } else {
      // Chambers of different sizes have one pressure, not one growth. The path ends where no equilibrium follows.
      text_.table("path").comment("All chambers together.");
      const std::array pressures_Pa{0.0, two_digits(highest_of_limit * usual_pressure_Pa(robot_))};
      text_.add("pressure_Pa", std::span<const double>(pressures_Pa)).add("end_at_limit_point", true);
    }
    text_.add("first_step", 0.005).add("largest_step", 0.01).add("smallest_step", 1e-4);
    return text_.text();
  }

  std::string load_cases() {
    load_case_head();
    text_.lines(calibration_cases_text(robot_));
    return text_.text();
  }

  std::string validate_load_cases() {
    load_case_head();
    text_.line("").entry("case").add("name", "robot_inflation").add("kind", "inflation");
    text_.add("pressures_Pa", std::span<const double>(validated_pressures_Pa()));
    body();
    if (robot_.chambers != ChamberLayout::single) {
      text_.add("cell_edge_m", robot_.design.cell_edge_m).add("wall_thickness_m", robot_.wall_thickness_m);
      text_.add("chambers", word_of(robot_.chambers));
    }
    return text_.text();
  }

  std::string calibrate() {
    text_.raw("curves", io::toml_value_text(std::vector{path(places_.folder(RobotStudy::load_cases))}));
    text_.add("cases", std::span<const std::string>(calibration_case_names())).add("silicone", silicone());
    text_.table("holds_for").add("silicone", robot_.record.name);
    text_.add("cell_edge_m", robot_.design.cell_edge_m).add("wall_thickness_m", robot_.wall_thickness_m);
    text_.table("fit").comment("The details that serve unseen bodies best.");
    text_.raw(
        "details",
        R"(["uniform", "stiffness", "sections", "shear", "bulge_classes", "lateral", "elbows", "fading", "plates", "necks"])");
    text_.add("choice", "necks");
    return text_.text();
  }

  std::string validate() {
    text_.add("parameters", parameters());
    text_.add("load_cases", path(places_.study(RobotStudy::validate_load_cases)));
    text_.raw("curves", io::toml_value_text(std::vector{path(places_.folder(RobotStudy::validate_load_cases))}));
    if (const double highest_Pa = drive_pressure_Pa(robot_)[1]; highest_Pa > 0.0) text_.add("actuation_pressure_Pa", highest_Pa);
    return text_.text();
  }

  std::string simulate() {
    design(false);
    surrogate();
    drive();
    ground();
    text_.table("time").add("duration_s", robot_.duration_s);
    return text_.text();
  }

  std::string locomote(std::string_view fidelity) {
    thin_walls(fidelity);
    design(true);
    material();
    drive();
    ground();
    text_.table("time").add("duration_s", robot_.duration_s);
    return text_.text();
  }

  std::string evolve() {
    const RobotSearch& search = *robot_.search;
    const bool has_elements = search.model != RobotSearchModel::voxels;
    text_.add("preset", "paper").add("generations", search.generations).add("seed", search.seed);
    text_.table("population").add("survivors", search.survivors).add("mutants", search.mutants);
    text_.table("evaluation").add("model", to_string(search.model)).add("measure", to_string(search.measure)).add("stand", true);
    if (has_elements) text_.add("confirm", search.evaluated_best);
    text_.table("body").raw("levels", "[1]").add("cell_edge_m", robot_.design.cell_edge_m).add("castable", true);
    // Otherwise [surrogate] says so.
    const bool has_voxels = search.model != RobotSearchModel::finite_elements;
    if (!has_voxels) text_.add("wall_thickness_m", robot_.wall_thickness_m).add("chambers", word_of(robot_.chambers));
    text_.table("time");
    text_.add("duration_s", std::ceil(search_periods / robot_.frequency_Hz * duration_digits_per_s) / duration_digits_per_s);
    if (has_voxels) surrogate();
    if (has_elements) {
      material();
      text_.table("elements").add("fidelity", "draft");
    }
    drive();
    ground();
    if (search.robust) text_.table("robust");
    return text_.text();
  }

  std::string reevaluate() {
    if (robot_.search->model == RobotSearchModel::both) text_.add("compare_with", "voxels");
    text_.table("elements").add("fidelity", to_string(robot_.fidelity));
    return text_.text();
  }

 private:
  [[nodiscard]] std::string path(const fs::path& file) const { return path_from(places_.studies(), file); }

  [[nodiscard]] std::string silicone() const {
    return robot_.silicone.find('/') == std::string::npos && !fs::path(robot_.silicone).has_extension()
               ? robot_.silicone
               : path(robot_.silicone_file);
  }

  /// The states in which the surrogate is compared with finite elements: those that the drive passes through.
  [[nodiscard]] std::vector<double> validated_pressures_Pa() const {
    std::vector<double> pressures_Pa;
    const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot_);
    for (const double end_Pa : {std::min(lowest_Pa, 0.0), std::max(highest_Pa, 0.0)}) {
      // Whole pascals, or so many decimals that no two are the same.
      const double step_Pa = std::abs(end_Pa) / validated_states;
      const double per_Pa = step_Pa == 0.0 ? 1.0 : std::pow(10.0, std::max(0.0, 1.0 - std::floor(std::log10(step_Pa))));
      for (int n = 1; n <= validated_states; ++n)
        pressures_Pa.push_back(std::round(end_Pa * n / validated_states * per_Pa) / per_Pa);
    }
    std::ranges::sort(pressures_Pa);
    std::erase(pressures_Pa, 0.0);
    return pressures_Pa;
  }

  /// Pressure first: walls that touch in vacuum end a path.
  [[nodiscard]] std::vector<double> pressures_in_phase() const {
    const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot_);
    if (lowest_Pa >= 0.0) return {0.0, highest_Pa};
    if (highest_Pa <= 0.0) return {0.0, lowest_Pa, highest_Pa};
    return {0.0, highest_Pa, 0.0, lowest_Pa};
  }

  /// The drive goes to and fro between two states, in which either material has the highest pressure and the other the lowest.
  void pressures_in_antiphase() {
    const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot_);
    const ModularBody body(robot_.design.body, 1, robot_.chambers);
    for (std::size_t n = 0; n < body.regions().size(); ++n) {
      const bool is_first = body.regions()[n].material == 1;
      const std::array pressures_Pa{0.0, is_first ? highest_Pa : lowest_Pa, is_first ? lowest_Pa : highest_Pa};
      text_.line("").entry("path.plenum").add("name", "plenum " + std::to_string(n));
      text_.add("pressure_Pa", std::span<const double>(pressures_Pa));
    }
  }

  void body() {
    const Polycube& cells = robot_.design.body;
    text_.add("cells", std::span<const std::int64_t>(std::array<std::int64_t, 3>{cells.nx(), cells.ny(), cells.nz()}));
    text_.add("digits", cells.digits());
  }

  void design(bool is_hollow) {
    text_.table("design").add("name", robot_.design.name);
    body();
    text_.add("cell_edge_m", robot_.design.cell_edge_m);
    if (is_hollow) text_.add("wall_thickness_m", robot_.wall_thickness_m).add("chambers", word_of(robot_.chambers));
  }

  void material() {
    text_.table("material").add("silicone", silicone());
    law();
  }

  void law() {
    if (robot_.law_name == materials::recommended_law_name) return;
    text_.add("law_name", robot_.law_name);
    if (robot_.law_variant != 1) text_.add("law_variant", static_cast<std::int64_t>(robot_.law_variant));
  }

  void thin_walls(std::string_view fidelity) { text_.table("elements").add("kind", "thin_wall").add("fidelity", fidelity); }

  void load_case_head() {
    text_.add("silicone", silicone());
    law();
    text_.add("relative_uncertainty", 0.05);
    text_.table("body").add("cell_edge_m", robot_.design.cell_edge_m).add("wall_thickness_m", robot_.wall_thickness_m);
    text_.table("elements").comment("Quadratic elements, one through a wall and one across a chamber.");
    text_.add("degree", 2).add("largest_element_m", std::round(robot_.span_m() * 1e9) / 1e9).add("growth", 4);
  }

  /// Those that come with menger lie far from here.
  [[nodiscard]] std::string parameters() const {
    const fs::path file = parameters_of(robot_, places_);
    return parameter_source(robot_) == ParameterSource::known ? file.stem().string() : path(file);
  }

  void surrogate() {
    text_.table("surrogate").add("parameters", parameters());
    text_.add("chambers", word_of(robot_.chambers)).add("outside_range", "warn");
  }

  /// What does not walk, such as a finger, stands on no ground, which would keep it from bending.
  void supports() {
    if (!robot_.walks) text_.table("supports").add("kind", "free");
  }

  void drive() {
    const auto pressure_Pa = drive_pressure_Pa(robot_);
    text_.table("drive").add("mode", to_string(robot_.drive)).add("pressure_Pa", std::span<const double>(pressure_Pa));
    text_.add("frequency_Hz", robot_.frequency_Hz);
  }

  void ground() {
    text_.table("ground").add("static_friction", robot_.static_friction).add("kinetic_friction", robot_.kinetic_friction);
  }

  const Robot& robot_;
  const RobotPlaces& places_;
  io::TomlText text_;
};

/// The command that reads a study.
std::string_view command_of(RobotStudy study) {
  switch (study) {
    case RobotStudy::mesh:
      return "mesh";
    case RobotStudy::inflate:
    case RobotStudy::limit:
      return "inflate";
    case RobotStudy::load_cases:
    case RobotStudy::validate_load_cases:
      return "load-cases";
    case RobotStudy::calibrate:
      return "calibrate";
    case RobotStudy::validate:
      return "validate";
    case RobotStudy::simulate:
      return "simulate";
    case RobotStudy::locomote:
    case RobotStudy::locomote_finer:
      return "locomote";
    case RobotStudy::evolve:
      return "evolve";
    case RobotStudy::reevaluate:
      return "reevaluate RUN.sqlite --study";
  }
  return "";
}

std::string content_of(const Robot& robot, RobotStudy study, const RobotPlaces& places) {
  StudyTexts texts(robot, places);
  switch (study) {
    case RobotStudy::mesh:
      return texts.mesh();
    case RobotStudy::inflate:
      return texts.inflate();
    case RobotStudy::limit:
      return texts.limit();
    case RobotStudy::load_cases:
      return texts.load_cases();
    case RobotStudy::calibrate:
      return texts.calibrate();
    case RobotStudy::validate_load_cases:
      return texts.validate_load_cases();
    case RobotStudy::validate:
      return texts.validate();
    case RobotStudy::simulate:
      return texts.simulate();
    case RobotStudy::locomote:
      return texts.locomote(to_string(robot.fidelity));
    case RobotStudy::locomote_finer:
      return texts.locomote(finer(robot.fidelity));
    case RobotStudy::evolve:
      return texts.evolve();
    case RobotStudy::reevaluate:
      return texts.reevaluate();
  }
  return "";
}

}  // namespace

std::string_view to_string(RobotStudy study) {
  switch (study) {
    case RobotStudy::mesh:
      return "mesh";
    case RobotStudy::inflate:
      return "inflate";
    case RobotStudy::limit:
      return "limit";
    case RobotStudy::load_cases:
      return "load_cases";
    case RobotStudy::calibrate:
      return "calibrate";
    case RobotStudy::validate_load_cases:
      return "validate_load_cases";
    case RobotStudy::validate:
      return "validate";
    case RobotStudy::simulate:
      return "simulate";
    case RobotStudy::locomote:
      return "locomote";
    case RobotStudy::locomote_finer:
      return "locomote_finer";
    case RobotStudy::evolve:
      return "evolve";
    case RobotStudy::reevaluate:
      return "reevaluate";
  }
  return "";
}

std::span<const RobotStudy> robot_studies() { return all_studies; }

bool needs_body(RobotStudy study) {
  return study != RobotStudy::load_cases && study != RobotStudy::calibrate && study != RobotStudy::evolve &&
         study != RobotStudy::reevaluate;
}

std::string missing_because(const Robot& robot, RobotStudy study) {
  const bool is_fit = study == RobotStudy::load_cases || study == RobotStudy::calibrate;
  if (is_fit && parameter_source(robot) == ParameterSource::given) return "surrogate.parameters names a file: nothing is fitted";
  const bool is_check = study == RobotStudy::validate || study == RobotStudy::validate_load_cases;
  if (is_check && parameter_source(robot) != ParameterSource::given && is_fitted_body(robot))
    return "the parameters of the voxels were fitted to this very body, so it cannot test them";
  if (study == RobotStudy::limit && drive_pressure_Pa(robot)[1] <= 0.0) return "drive.pressure_Pa is nowhere above 0";
  const bool is_walk = study == RobotStudy::simulate || study == RobotStudy::locomote || study == RobotStudy::locomote_finer;
  if (is_walk && !robot.walks) return "it does not walk (walk.present = false); menger inflate fills it";
  if (study == RobotStudy::locomote_finer && robot.fidelity == RobotFidelity::fine)
    return "walk.fidelity = \"fine\": there are no finer elements";
  const bool is_search = study == RobotStudy::evolve || study == RobotStudy::reevaluate;
  if (is_search && !robot.search) return "there is no table [search]";
  return "";
}

RobotPlaces::RobotPlaces(const fs::path& robot_file, const fs::path& results_folder)
    : results(results_folder.empty() ? robot_file.parent_path() / "results" : results_folder) {}

fs::path RobotPlaces::study(RobotStudy study) const { return studies() / (std::string(to_string(study)) + ".toml"); }

fs::path RobotPlaces::folder(RobotStudy study) const {
  // The curves of the robot itself are a part of its validation.
  if (study == RobotStudy::validate_load_cases)
    return (output.empty() ? results / to_string(RobotStudy::validate) : output) / "curves";
  return results / to_string(study);
}

ParameterSource parameter_source(const Robot& robot) {
  if (robot.parameters) return ParameterSource::given;
  return !robot.fits_anew && known_parameters(robot) ? ParameterSource::known : ParameterSource::fitted;
}

fs::path parameters_of(const Robot& robot, const RobotPlaces& places) {
  if (robot.parameters) return *robot.parameters;
  const auto known = robot.fits_anew ? std::nullopt : known_parameters(robot);
  return known.value_or(places.fitted_parameters());
}

std::string study_text(const Robot& robot, RobotStudy study, const RobotPlaces& places) {
  return "# For `menger " + std::string(command_of(study)) + "`, from " + path_from(places.studies(), robot.file) +
         ": menger loop writes this file anew.\n" + content_of(robot, study, places);
}

void write_studies(const Robot& robot, std::span<const RobotStudy> studies, const RobotPlaces& places) {
  for (const RobotStudy study : studies) {
    const fs::path file = places.study(study);
    const std::string text = study_text(robot, study, places);
    if (io::is_file(file) && io::read_whole(file) == text) continue;
    io::write_whole(file, text);
  }
}

}  // namespace menger::meshes
