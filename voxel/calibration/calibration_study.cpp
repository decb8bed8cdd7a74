#include "voxel/calibration/calibration_study.h"

#include <algorithm>
#include <cmath>

#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/content_hash.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "materials/laws/silicone_library.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/load_cases/load_case_file.h"
#include "voxel/calibration/calibration_curves.h"
#include "voxel/calibration/calibration_start.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

void describe_subject(io::StudyVisitor& visitor, CalibrationStudy& study) {
  CurveSubject& subject = study.subject;
  visitor.text({"silicone", "Name of the silicone, as in the curves.", "\"Dragon Skin 10\""}, subject.silicone);
  visitor.optional_text(
      {"law", "Law of the silicone, as in the curves. Without it, all curves must have the same law.", "\"neo-Hookean\""},
      subject.law);
  visitor.number({"cell_edge_m", "Edge of a cell.", "0.01"}, subject.cell_edge_m, io::positive());
  visitor.number({"wall_thickness_m", "Thickness of the walls of a cell.", "0.002"}, subject.wall_thickness_m, io::positive());
  visitor.integer({"voxels_per_cell", "Voxels along the edge of a cell."}, study.voxels_per_cell, io::within(1, 4));
  visitor.word(
      {"chambers", "Cells that share one chamber: all cells of a module, or each connected region of cells of one phase."},
      study.chambers, meshes::chamber_layout_words());
}

void describe_pressures(io::StudyVisitor& visitor, std::optional<ValueRange>& pressures_Pa) {
  std::optional<std::vector<double>> ends;
  if (pressures_Pa) ends = {pressures_Pa->lowest, pressures_Pa->highest};
  visitor.optional_numbers({"pressures_Pa", "Lowest and highest pressure of the states that are fitted.", "[-3e3, 6e3]"}, ends,
                           io::any_number(), {.fewest = 2, .most = 2});
  pressures_Pa.reset();
  if (!ends) return;
  pressures_Pa = ValueRange{ends->front(), ends->back()};
  visitor.check(ends->front() <= 0.0 && ends->back() >= 0.0 && ends->front() < ends->back(), "pressures_Pa",
                "must be lowest <= 0 <= highest, and not both 0");
}

void describe_loss(io::StudyVisitor& visitor, CalibrationFitOptions& fit) {
  bool is_robust = fit.loss_scale.has_value();
  double scale = fit.loss_scale.value_or(3.0);
  visitor.word({"loss", "Loss that the fit minimises: squares of residuals, or Cauchy's loss, which gives outliers less weight."},
               is_robust, io::Words<bool>{{"squares", false}, {"cauchy", true}});
  visitor.only_if(is_robust, "loss = \"cauchy\"", [&] {
    visitor.number({"loss_scale", "Residual above which Cauchy's loss gives less weight, in standard deviations."}, scale,
                   io::positive());
  });
  fit.loss_scale.reset();
  if (is_robust) fit.loss_scale = scale;
}

void describe_fit(io::StudyVisitor& visitor, CalibrationStudy& study) {
  CalibrationPlan& plan = study.plan;
  visitor.words({"details", "Details of the model that are fitted, in the order in which they are tried."}, plan.details,
                detail_words(), {.fewest = 1});
  visitor.optional_word({"choice", "All details up to this one are kept. Without it, Akaike's criterion decides.", "\"uniform\""},
                        plan.choice, detail_words());
  visitor.check(!plan.choice || std::ranges::find(plan.details, *plan.choice) != plan.details.end(), "choice",
                "must be one of the details that are fitted");
  visitor.number({"aic_margin", "A detail is kept if it lowers Akaike's criterion by more than this."}, plan.aic_margin,
                 io::non_negative());
  describe_loss(visitor, plan.fit);
  visitor.integer({"largest_iteration_count", "Largest number of iterations of one fit."}, plan.fit.largest_iteration_count,
                  io::within(1, 10000));
  describe_pressures(visitor, study.pressures_Pa);
}

void describe_weights(io::StudyVisitor& visitor, std::map<meshes::LoadCaseKind, double>& weights) {
  for (const auto& [word, kind] : meshes::load_case_kind_words()) {
    double& weight = weights.try_emplace(kind, 1.0).first->second;
    visitor.number({word, "Factor on the squares of residuals of load cases of this kind."}, weight, io::positive());
  }
}

void describe_bounds(io::StudyVisitor& visitor, CalibrationBounds& bounds) {
  for (const auto& [word, quantity] : quantity_words()) {
    const io::Range range = allowed_range(quantity);
    std::optional<std::vector<double>> ends;
    if (const auto known = bounds.find(quantity); known != bounds.end()) ends = {known->second.lowest, known->second.highest};
    const io::Key key{word, "Lowest and highest value in the fit. Without it, a wide range around a rough estimate.",
                      range.contains(2.0) ? "[1, 2]" : "[0.1, 0.5]"};
    visitor.optional_numbers(key, ends, range, {.fewest = 2, .most = 2});
    bounds.erase(quantity);
    if (!ends) continue;
    visitor.check(ends->front() < ends->back(), word, "the first must be smaller than the second");
    bounds[quantity] = {ends->front(), ends->back()};
  }
}

/// Frequency responses are solved with dense matrices of six unknowns per voxel.
void check_voxel_count(const io::TomlTable& table, const meshes::LoadCase& body, int voxels_per_cell) {
  constexpr double most_voxels = 500.0;  // 70 MB per matrix and a few seconds per frequency
  const auto cells =
      static_cast<double>(body.digits.size()) - static_cast<double>(std::count(body.digits.begin(), body.digits.end(), '0'));
  const double voxels = std::pow(cells, body.level) * std::pow(voxels_per_cell, 3);
  if (voxels <= most_voxels) return;
  throw table.error(table.has("level") ? "level" : "digits", "makes " + io::number_text(voxels) +
                                                                 " voxels; frequency responses are computed for at most " +
                                                                 io::number_text(most_voxels));
}

void describe_frequency_response(io::StudyVisitor& visitor, FrequencyReference& reference, int voxels_per_cell) {
  visitor.path({"file", "Table with the column frequency_Hz and the gains.", "\"frequency_response.csv\""}, reference.file);
  visitor.text({"column", "Observable whose real and imaginary parts are columns. If empty, the column is gain_m_per_Pa."},
               reference.column);
  std::vector<int> cells(reference.body.cells.begin(), reference.body.cells.end());
  visitor.integers({"cells", "Cells of the body along x, y and z.", "[1, 1, 1]"}, cells, io::at_least(1),
                   {.fewest = 3, .most = 3});
  if (cells.size() == 3) std::copy(cells.begin(), cells.end(), reference.body.cells.begin());
  visitor.text({"digits", "One digit for each cell: x varies fastest, then y, then z. 0 is empty.", "\"1\""},
               reference.body.digits);
  visitor.integer({"level", "Level of the fractal."}, reference.body.level, io::within(1, 3));
  if (const io::TomlTable* table = visitor.source()) {
    meshes::read_cells(*table, reference.body);
    check_voxel_count(*table, reference.body, voxels_per_cell);
  }
  visitor.number({"pressure_Pa", "Pressure at which the body is in equilibrium."}, reference.pressure_Pa);
  visitor.word({"end", "End of the body whose motion is compared: the end at the largest x, or at the largest z."}, reference.end,
               io::Words<BodyEnd>{{"tip", BodyEnd::tip}, {"top", BodyEnd::top}});
}

/// Describes the keys that name no file.
void describe_question(io::StudyVisitor& visitor, CalibrationStudy& study) {
  visitor.table({"holds_for", "Silicone and cells of the curves and the parameters."}, [&] { describe_subject(visitor, study); });
  visitor.table({"fit", "How the parameters are fitted."}, [&] { describe_fit(visitor, study); });
  visitor.table({"weights", "Factors on the squares of residuals, by kind of load case."},
                [&] { describe_weights(visitor, study.weights); });
  visitor.table({"bounds", "Range of each parameter in the fit."}, [&] { describe_bounds(visitor, study.bounds); });
}

void read_record(const io::TomlTable& top, CalibrationStudy& study) {
  if (!study.silicone) {
    study.notes.emplace_back("damping: not measured, because the study has no key silicone");
    return;
  }
  const fs::path file = materials::silicone_file(top, "silicone");
  const materials::SiliconeRecord record = top.reading("silicone", [&] { return materials::read_silicone(file); });
  const std::string& wanted = study.subject.silicone;
  if (record.name != wanted) throw top.error("silicone", "is " + record.name + ", but the study is for " + wanted);
  io::note_input(study.inputs, file);
  study.loss = record.loss;
  study.notes.push_back(record.loss ? "damping: " + record.loss->source : "damping: not measured for " + wanted);
}

}  // namespace

void describe(io::StudyVisitor& visitor, CalibrationStudy& study) {
  visitor.paths({.name = "curves",
                 .help = "Files of response curves, or folders with such files.",
                 .example = study.places.empty() ? "[\"curves\"]" : "",
                 .may_be_elsewhere = true},
                study.places, {.fewest = 1});
  visitor.optional_texts({"cases", "Names of the load cases that are fitted. Without it, all are fitted.", "[\"bar_inflation\"]"},
                         study.cases, {.fewest = 1});
  visitor.optional_text({.name = "silicone",
                         .help = "Name of a silicone of menger, or file of a silicone. Its measured damping is used.",
                         .example = "\"dragon_skin_10\"",
                         .earlier = "record"},
                        study.silicone);
  describe_question(visitor, study);
  visitor.optional_table(
      {"frequency_response", "Harmonic responses of finite elements. They are used for comparison only, not for the fit."},
      study.frequency_response,
      [&](FrequencyReference& reference) { describe_frequency_response(visitor, reference, study.voxels_per_cell); });
}

CalibrationStudy read_calibration_study(const fs::path& file, const std::vector<fs::path>& curves) {
  const io::TomlTable top = io::read_toml(file);
  CalibrationStudy study{.file = file, .places = curves};
  io::read_described(top, study);
  io::note_input(study.inputs, file);
  read_record(top, study);
  if (study.frequency_response) io::note_input(study.inputs, study.frequency_response->file);
  read_curves(top, curves, study);
  return study;
}

CalibrationProblem problem_of(const CalibrationStudy& study, const Responder& responder) {
  CalibrationProblem problem;
  problem.responder = responder;
  problem.start = rough_parameters(study.curves.front().curve.provenance, study.voxels_per_cell);
  problem.start.chambers = study.chambers;
  for (const StudyCurve& curve : study.curves) {
    problem.curves.push_back(fitted_curve(curve.curve, curve.weight));
    problem.curves.back().load_case.cell_edge_m = problem.start.cell_edge_m;  // they may differ by rounding
    problem.curves.back().load_case.wall_thickness_m = problem.start.wall_thickness_m;
  }
  const ValueRange pressures = pressure_range_Pa(problem.curves);
  problem.bounds = default_bounds(problem.start, pressures.lowest, pressures.highest);
  for (const auto& [quantity, range] : study.bounds) problem.bounds[quantity] = range;
  return problem;
}

std::string study_text(const CalibrationStudy& study, const CalibrationProblem& problem) {
  CalibrationStudy stated = study;
  stated.bounds = problem.bounds;
  io::StudyTextWriter writer;
  describe_question(writer, stated);
  io::TomlText text;
  text.lines(writer.text());
  for (const StudyCurve& curve : study.curves) {
    text.table("curves." + curve.curve.provenance.load_case.name);
    text.add("hash", curve.hash).add("weight", curve.weight);
  }
  return text.text();
}

}  // namespace menger::voxel
