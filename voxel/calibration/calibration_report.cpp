#include "voxel/calibration/calibration_report.h"

#include <algorithm>

#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/load_case_subject.h"
#include "voxel/calibration/calibration_damping.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/model/table_text.h"

namespace menger::voxel {
namespace {

std::string quoted_list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list.append(list.empty() ? "" : ", ").append(io::toml_quoted(text));
  return "[" + list + "]";
}

std::vector<std::string> names_with(const CalibrationFit& fit, Determination determination) {
  std::vector<std::string> names;
  for (const FittedValue& value : fit.values) {
    if (value.determination == determination) names.push_back(value.parameter.name);
  }
  return names;
}

void add_determination(TableText& table, const CalibrationFit& fit) {
  table.add("wide", quoted_list(names_with(fit, Determination::wide)));
  table.add("at_bound", quoted_list(names_with(fit, Determination::at_bound)));
  table.add("not_separable", quoted_list(names_with(fit, Determination::not_separable)));
  table.add("no_influence", quoted_list(names_with(fit, Determination::no_influence)));
}

/// @param ended how what the table is about ended: the calibration, or the fit that its parameters are of
void add_outcome(TableText& table, const Calibration& calibration, const CalibrationFit& ended) {
  const CalibrationFit& fit = calibration.fit();
  table.word("status", io::to_string(ended.status));
  if (!ended.reason.empty()) table.word("reason", ended.reason);
  table.word("details", to_string(calibration.details())).boolean("explained", fit.explained);
  table.number("chi2", fit.chi2).number("reduced_chi2", fit.reduced_chi2()).number("aic", fit.aic);
  table.number("residuals", static_cast<double>(fit.residual_count));
  table.number("parameters", static_cast<double>(fit.parameter_count));
}

void add_class_notes(std::vector<std::string>& notes, std::string_view what, const std::vector<std::size_t>& determined) {
  std::string others;
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    if (std::find(determined.begin(), determined.end(), c) == determined.end())
      others.append(others.empty() ? "" : ", ").append(wall_class_names[c]);
  }
  if (others.empty()) return;
  notes.push_back(std::string(what) + " of wall class " + others +
                  ": not determined by any load case; takes the value of the nearest class that is");
}

}  // namespace

std::vector<std::string> class_notes(const DeterminedClasses& classes) {
  std::vector<std::string> notes;
  add_class_notes(notes, "stiffness", classes.stiffness);
  add_class_notes(notes, "extension", classes.extension);
  add_class_notes(notes, "bulge", classes.bulge);
  return notes;
}

SurrogateParameters reported_parameters(const Calibration& calibration, const CalibrationStudy& study) {
  SurrogateParameters parameters = calibration.fit().parameters;
  if (study.loss) {
    parameters.bond_damping_ratio = bond_damping_ratio(parameters, *study.loss);
    parameters.damping_measured = true;
  }
  return parameters;
}

std::string parameters_text(const Calibration& calibration, const CalibrationStudy& study) {
  const CalibrationFit& fit = calibration.fit();
  TableText table("fit");
  add_outcome(table, calibration, fit);
  if (const std::vector<std::string> failed = failed_details(calibration); !failed.empty())
    table.add("failed", quoted_list(failed));
  add_determination(table, fit);
  TableText intervals("fit.confidence_95");
  for (const FittedValue& value : fit.values) {
    if (!value.confidence_95) continue;
    intervals.add(value.parameter.name,
                  "[" + io::number_text(value.confidence_95->first) + ", " + io::number_text(value.confidence_95->second) + "]");
  }
  std::string curves;
  for (const StudyCurve& curve : study.curves) {
    curves += "[[fit.curves]]\nname = " + io::toml_quoted(curve.curve.provenance.load_case.name) +
              "\nsubject = " + io::toml_quoted(meshes::subject_of(curve.curve.provenance.load_case)) +
              "\nhash = " + io::toml_quoted(curve.hash) + "\ntable_hash = " + io::toml_quoted(curve.table_hash) + "\n";
  }
  return surrogate_text(reported_parameters(calibration, study)) + table.text() + intervals.text() + curves;
}

std::string result_text(const Calibration& calibration, const CalibrationStudy& study, const std::vector<FittedCurve>& curves) {
  const CalibrationFit& fit = calibration.fit();
  TableText table("fit");
  add_outcome(table, calibration, calibration.ended());
  add_determination(table, fit);
  std::vector<std::string> notes = study.notes;
  for (const std::string& note : failed_details(calibration)) notes.push_back(note);
  for (const std::string& note : class_notes(calibration.classes)) notes.push_back(note);
  if (!fit.explained) {
    notes.emplace_back(
        "the stated uncertainties of the curves do not explain the residuals: the surrogate differs in shape, or "
        "curves contradict each other");
  }
  table.add("notes", quoted_list(notes));
  std::string text = table.text();
  for (const Outlier& outlier : outliers_of(curves, fit)) {
    text += "[[outliers]]\n";
    text += "case = " + io::toml_quoted(curves[outlier.curve].load_case.name) + "\n";
    text += "ordinate = " + io::toml_quoted(outlier.ordinate) + "\n";
    text += "row = " + std::to_string(outlier.row + 1) + "\n";
    text += "standard_deviations = " + io::number_text(outlier.residual) + "\n";
  }
  return text;
}

}  // namespace menger::voxel
