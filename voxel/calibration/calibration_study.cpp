#include "voxel/calibration/calibration_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text/content_hash.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/load_case_file.h"
#include "voxel/calibration/calibration_curves.h"
#include "voxel/calibration/calibration_start.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/model/table_text.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

io::TomlTable table_or_empty(const io::TomlTable& table, std::string_view key) {
  if (const auto found = table.optional_table(key)) return *found;
  return io::parse_toml("", table.file());
}

CurveSubject read_holds_for(const io::TomlTable& table, CalibrationStudy& study) {
  CurveSubject wanted;
  wanted.silicone = table.text("silicone");
  if (table.has("law")) wanted.law = table.text("law");
  wanted.cell_edge_m = table.number("cell_edge_m", io::positive());
  wanted.wall_thickness_m = table.number("wall_thickness_m", io::positive());
  study.voxels_per_cell = table.integer_or("voxels_per_cell", 1, io::within(1, 4));
  const io::Words<meshes::ChamberLayout> layouts{{to_string(meshes::ChamberLayout::single), meshes::ChamberLayout::single},
                                                 {to_string(meshes::ChamberLayout::per_phase), meshes::ChamberLayout::per_phase}};
  study.chambers = table.word_or("chambers", meshes::ChamberLayout::single, layouts);
  return wanted;
}

void read_weights(const io::TomlTable& table, CalibrationStudy& study) {
  for (const auto& [word, kind] : meshes::load_case_kind_words()) {
    const double weight = table.number_or(word, 1.0, io::positive());
    for (StudyCurve& curve : study.curves) {
      if (curve.curve.provenance.load_case.kind == kind) curve.weight = weight;
    }
  }
}

void read_bounds(const io::TomlTable& table, CalibrationStudy& study) {
  for (const auto& [word, quantity] : quantity_words()) {
    if (!table.has(word)) continue;
    const std::vector<double> ends = table.numbers(word);
    if (ends.size() != 2) throw table.error(word, "must be two numbers, not " + std::to_string(ends.size()));
    if (!(ends[0] < ends[1])) throw table.error(word, "the first must be smaller than the second");
    const io::Range range = allowed_range(quantity);
    for (std::size_t n = 0; n < 2; ++n) {
      if (!range.contains(ends[n])) throw table.error(word, range.demand(), std::array{n});
    }
    study.bounds[quantity] = {ends[0], ends[1]};
  }
}

ValueRange read_pressures(const io::TomlTable& table) {
  const std::vector<double> ends = table.numbers("pressures_Pa");
  if (ends.size() != 2) throw table.error("pressures_Pa", "must be two numbers, not " + std::to_string(ends.size()));
  if (!(ends[0] <= 0.0 && ends[1] >= 0.0 && ends[0] < ends[1]))
    throw table.error("pressures_Pa", "must be lowest <= 0 <= highest, and not both 0");
  return {ends[0], ends[1]};
}

void read_fit(const io::TomlTable& table, CalibrationPlan& plan) {
  if (table.has("details")) {
    plan.details.clear();
    const std::vector<std::string> names = table.texts("details");
    for (std::size_t n = 0; n < names.size(); ++n) {
      const auto found =
          std::find_if(detail_words().begin(), detail_words().end(), [&](const auto& word) { return word.first == names[n]; });
      if (found == detail_words().end()) {
        std::vector<std::string> known;
        for (const auto& word : detail_words()) known.emplace_back(word.first);
        throw table.error("details", "must be one of " + io::joined(known), std::array{n});
      }
      plan.details.push_back(found->second);
    }
    if (plan.details.empty()) throw table.error("details", "must name at least one");
  }
  if (table.has("choice")) {
    plan.choice = table.word("choice", detail_words());
    if (std::find(plan.details.begin(), plan.details.end(), *plan.choice) == plan.details.end())
      throw table.error("choice", "is none of the details that are fitted");
  }
  plan.aic_margin = table.number_or("aic_margin", plan.aic_margin, io::non_negative());
  const bool is_robust = table.word_or("loss", false, io::Words<bool>{{"squares", false}, {"cauchy", true}});
  if (is_robust) plan.fit.loss_scale = table.number_or("loss_scale", 3.0, io::positive());
  plan.fit.largest_iteration_count =
      table.integer_or("largest_iteration_count", plan.fit.largest_iteration_count, io::within(1, 10000));
}

void read_record(const io::TomlTable& top, const std::string& silicone, CalibrationStudy& study) {
  const auto file = top.optional_path("record");
  if (!file) {
    study.notes.emplace_back("damping: not measured, no record of the silicone is named");
    return;
  }
  const materials::SiliconeRecord record = materials::read_silicone(*file);
  if (record.name != silicone) throw top.error("record", "is of " + record.name + ", the study is for " + silicone);
  study.inputs[file->string()] = io::file_hash(*file);
  study.loss = record.loss;
  study.notes.push_back(record.loss ? "damping: " + record.loss->source : "damping: not measured for " + silicone);
}

/// Frequency responses are solved with dense matrices of six unknowns per voxel.
void check_voxel_count(const io::TomlTable& table, const meshes::LoadCase& body, int voxels_per_cell) {
  constexpr double most_voxels = 500.0;  // 70 MB per matrix and a few seconds per frequency
  const auto cells =
      static_cast<double>(body.digits.size()) - static_cast<double>(std::count(body.digits.begin(), body.digits.end(), '0'));
  const double voxels = std::pow(cells, body.level) * std::pow(voxels_per_cell, 3);
  if (voxels <= most_voxels) return;
  throw table.error(
      table.has("level") ? "level" : "digits",
      "makes " + io::number_text(voxels) + " voxels; frequency responses are found for up to " + io::number_text(most_voxels));
}

FrequencyReference read_frequency_response(const io::TomlTable& table, CalibrationStudy& study) {
  FrequencyReference reference;
  reference.file = table.path("file");
  reference.column = table.text_or("column", "");
  meshes::read_cells(table, reference.body);
  reference.body.level = table.integer_or("level", 1, io::within(1, 3));
  check_voxel_count(table, reference.body, study.voxels_per_cell);
  reference.pressure_Pa = table.number_or("pressure_Pa", 0.0);
  reference.end = table.word_or("end", BodyEnd::tip, io::Words<BodyEnd>{{"tip", BodyEnd::tip}, {"top", BodyEnd::top}});
  study.inputs[reference.file.string()] = io::file_hash(reference.file);
  return reference;
}

}  // namespace

CalibrationStudy read_calibration_study(const fs::path& file, const std::vector<fs::path>& curves) {
  const io::TomlTable top = io::read_toml(file);
  CalibrationStudy study;
  study.file = file;
  study.inputs[file.string()] = io::file_hash(file);
  const io::TomlTable holds_for = top.table("holds_for");
  const CurveSubject wanted = read_holds_for(holds_for, study);
  const io::TomlTable weights = table_or_empty(top, "weights");
  const io::TomlTable fit = table_or_empty(top, "fit");
  read_fit(fit, study.plan);
  if (fit.has("pressures_Pa")) study.pressures_Pa = read_pressures(fit);
  read_bounds(table_or_empty(top, "bounds"), study);
  read_record(top, wanted.silicone, study);
  if (const auto table = top.optional_table("frequency_response"))
    study.frequency_response = read_frequency_response(*table, study);
  read_curves(top, curves, wanted, study);
  read_weights(weights, study);
  top.finish();
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
  std::string text = "voxels_per_cell = " + std::to_string(study.voxels_per_cell) + "\n";
  std::string details;
  for (const CalibrationDetail detail : study.plan.details)
    details.append(details.empty() ? "" : ", ").append(io::toml_quoted(to_string(detail)));
  TableText fit("fit");
  fit.add("details", "[" + details + "]");
  if (study.plan.choice) fit.word("choice", to_string(*study.plan.choice));
  fit.number("aic_margin", study.plan.aic_margin).word("loss", study.plan.fit.loss_scale ? "cauchy" : "squares");
  if (study.plan.fit.loss_scale) fit.number("loss_scale", *study.plan.fit.loss_scale);
  fit.number("largest_iteration_count", study.plan.fit.largest_iteration_count);
  if (study.pressures_Pa) fit.numbers("pressures_Pa", std::array{study.pressures_Pa->lowest, study.pressures_Pa->highest});
  TableText bounds("bounds");
  for (const auto& [quantity, range] : problem.bounds)
    bounds.numbers(to_string(quantity), std::array{range.lowest, range.highest});
  text += fit.text() + bounds.text();
  for (const StudyCurve& curve : study.curves) {
    text += TableText("curves." + curve.curve.provenance.load_case.name)
                .word("hash", curve.hash)
                .number("weight", curve.weight)
                .text();
  }
  return text;
}

}  // namespace menger::voxel
