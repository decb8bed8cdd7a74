#include "evolution/loop/loop_stages.h"

#include <algorithm>
#include <optional>

#include "evolution/loop/loop_verdict_file.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/near_miss.h"
#include "voxel/model/expected_errors.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using meshes::RobotStudy;

/// Wall times on an idle core of a robot of eleven cells, s.
constexpr double mesh_s = 1.0;
constexpr double inflate_s = 6.0;
constexpr double load_cases_s = 110.0;
constexpr double calibrate_s = 60.0;
constexpr double validate_s = 60.0;
constexpr double simulate_s = 4.0;
constexpr double locomote_s = 7.0;
constexpr double robot_walk_s = 1.5;  ///< of a search, on draft elements
constexpr double voxel_walk_s = 0.3;
constexpr double export_s = 10.0;
constexpr double finer_walk_s = 20.0;  ///< of a re-evaluation, with its variants
constexpr double report_s = 10.0;

const char* const archive = "evolve/run.sqlite";

class Stages {
 public:
  Stages(const meshes::Robot& robot, const meshes::RobotPlaces& places) : robot_(robot), places_(places) {}

  std::vector<LoopStage> take() { return std::move(stages_); }

  /// Adds a stage that reads one study and writes a folder with a manifest.
  LoopStage& add(RobotStudy study, std::string program, double expected_s) {
    const std::string name(to_string(study));
    LoopStage& stage = stages_.emplace_back();
    stage.name = name;
    stage.program = std::move(program);
    stage.arguments = {study_name(study), "-o", name};
    stage.studies = {study};
    stage.manifest = manifest_of(name);
    stage.needs_body = meshes::needs_body(study);
    stage.is_driven = study == RobotStudy::validate || study == RobotStudy::simulate || study == RobotStudy::locomote ||
                      study == RobotStudy::locomote_finer;
    stage.expected_s = expected_s;
    if (stage.needs_body && robot_.evolves) stage.needs = {"export"};
    add_silicone(stage);
    return stage;
  }

  void add_body() {
    LoopStage& mesh = add(RobotStudy::mesh, "menger-mesh", mesh_s);
    mesh.arguments = {study_name(RobotStudy::mesh), "-o", "mesh/mesh.vtu"};
    mesh.begins_anew = true;
    for (const RobotStudy study : {RobotStudy::inflate, RobotStudy::limit})
      add(study, "menger-inflate", inflate_s).may_restart = true;
  }

  void add_fit() {
    if (parameter_source(robot_) != meshes::ParameterSource::fitted) return;
    add(RobotStudy::load_cases, "menger-load-cases", load_cases_s).is_usable_early = true;
    LoopStage& fit = add(RobotStudy::calibrate, "menger-calibrate", calibrate_s);
    fit.needs.push_back("load_cases");
    fit.follows.push_back("load_cases");
    fit.begins_anew = true;
  }

  void add_surrogate() {
    const bool is_validated = missing_because(robot_, RobotStudy::validate).empty();
    if (is_validated) {
      LoopStage& validate = add(RobotStudy::validate, "menger-validate", validate_s);
      validate.studies.push_back(RobotStudy::validate_load_cases);
      validate.helpers.emplace_back("menger-load-cases");
      // Parameters that come with menger have a table of errors of many bodies; those that were fitted here get one of this body.
      if (parameter_source(robot_) == meshes::ParameterSource::fitted) validate.arguments.emplace_back("--keep");
      add_parameters(validate);
    }
    if (!robot_.walks) return;
    LoopStage& simulate = add(RobotStudy::simulate, "menger-simulate", simulate_s);
    add_parameters(simulate);
    simulate.begins_anew = true;
    // It repeats the errors that the validation found.
    if (is_validated && parameter_source(robot_) == meshes::ParameterSource::fitted) simulate.follows.emplace_back("validate");
  }

  void add_walks() {
    for (const RobotStudy study : {RobotStudy::locomote, RobotStudy::locomote_finer}) {
      if (missing_because(robot_, study).empty()) add(study, "menger-locomote", locomote_s).may_restart = true;
    }
  }

  void add_search() {
    const meshes::RobotSearch& search = *robot_.search;
    const double robots = search.survivors + search.generations * (search.mutants + 1.0);
    const bool has_elements = search.model != meshes::RobotSearchModel::voxels;
    LoopStage& evolve = add(RobotStudy::evolve, "menger-evolve", robots * (has_elements ? robot_walk_s : voxel_walk_s));
    evolve.arguments = {study_name(RobotStudy::evolve), "-o", archive};
    evolve.is_set_aside = true;
    if (search.model != meshes::RobotSearchModel::finite_elements) add_parameters(evolve);

    LoopStage& exported = stages_.emplace_back();
    exported.name = "export";
    exported.program = "menger-export";
    exported.arguments = {archive, "-o", "export", "--levels", "1"};
    exported.needs = {"evolve"};
    exported.follows = {"evolve"};
    exported.manifest = manifest_of(exported.name);
    exported.is_usable_early = true;
    exported.expected_s = export_s;
  }

  void add_reference() {
    LoopStage& stage = add(RobotStudy::reevaluate, "menger-reevaluate", finer_walk_s * robot_.search->evaluated_best);
    const std::string best = std::to_string(robot_.search->evaluated_best);
    stage.arguments = {archive, "--top", best, "--study", study_name(RobotStudy::reevaluate), "-o", stage.name};
    stage.needs = {"evolve"};
    stage.follows = {"evolve"};
  }

  void add_report() {
    LoopStage stage;
    stage.name = "report";
    stage.program = "menger-report";
    stage.arguments = {places_.results.string()};
    stage.manifest = manifest_of(stage.name);
    for (const LoopStage& other : stages_) stage.follows.push_back(other.name);
    stage.reads.emplace_back(loop_verdict_name);
    stage.expected_s = report_s;
    stages_.push_back(stage);
  }

 private:
  [[nodiscard]] std::string study_name(RobotStudy study) const {
    return places_.study(study).lexically_relative(places_.results).string();
  }

  void add_silicone(LoopStage& stage) const { stage.reads.push_back(fs::absolute(robot_.silicone_file)); }

  /// Adds what a stage needs that reads voxel parameters.
  void add_parameters(LoopStage& stage) const {
    const fs::path parameters = fs::absolute(parameters_of(robot_, places_));
    stage.reads.push_back(parameters);
    if (parameter_source(robot_) == meshes::ParameterSource::fitted)
      stage.needs.push_back("calibrate");
    else
      stage.reads.push_back(voxel::expected_errors_file(parameters));  // a stage tells the errors to expect
  }

  const meshes::Robot& robot_;
  const meshes::RobotPlaces& places_;
  std::vector<LoopStage> stages_;
};

}  // namespace

fs::path manifest_of(const std::string& stage) {
  if (stage == "mesh") return "mesh/mesh_manifest.json";
  if (stage == "evolve") return "evolve/run.manifest.json";
  if (stage == "report") return "report.html";
  return fs::path(stage) / "manifest.json";
}

std::vector<LoopStage> loop_stages(const meshes::Robot& robot, const meshes::RobotPlaces& places, bool has_report) {
  Stages stages(robot, places);
  const bool searches_voxels = robot.search && robot.search->model != meshes::RobotSearchModel::finite_elements;
  if (robot.evolves && searches_voxels) stages.add_fit();
  if (robot.evolves) stages.add_search();
  stages.add_body();
  if (!(robot.evolves && searches_voxels)) stages.add_fit();
  stages.add_surrogate();
  stages.add_walks();
  if (robot.search && !robot.evolves) stages.add_search();
  if (robot.search) stages.add_reference();
  if (has_report) stages.add_report();
  return stages.take();
}

const LoopStage& stage_named(const std::vector<LoopStage>& stages, std::string_view option, const std::string& name) {
  const auto found = std::ranges::find(stages, name, &LoopStage::name);
  if (found != stages.end()) return *found;
  std::vector<std::string> names;
  names.reserve(stages.size());
  for (const LoopStage& stage : stages) names.push_back(stage.name);
  const std::optional<std::string> meant = io::near_miss(name, names);
  throw io::InputError(std::string(option) + " " + name + ": this robot has no such stage" +
                       (meant ? ", did you mean " + *meant + "?" : ".") + " Its stages: " + io::joined(names));
}

}  // namespace menger::evolution
