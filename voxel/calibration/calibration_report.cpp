#include "voxel/calibration/calibration_report.h"

#include <algorithm>
#include <array>

#include "io/text/toml_text.h"
#include "meshes/load_cases/load_case_subject.h"
#include "voxel/calibration/calibration_damping.h"
#include "voxel/model/surrogate_file.h"

namespace menger::voxel {
namespace {

std::vector<std::string> names_with(const CalibrationFit& fit, Determination determination) {
  std::vector<std::string> names;
  for (const FittedValue& value : fit.values) {
    if (value.determination == determination) names.push_back(value.parameter.name);
  }
  return names;
}

void add_determination(io::TomlText& text, const CalibrationFit& fit) {
  text.add("wide", names_with(fit, Determination::wide));
  text.add("at_bound", names_with(fit, Determination::at_bound));
  text.add("not_separable", names_with(fit, Determination::not_separable));
  text.add("no_influence", names_with(fit, Determination::no_influence));
}

/// Adds status, reason and details. @param ended the calibration as a whole, or the fit that gave the parameters
void add_outcome(io::TomlText& text, const Calibration& calibration, const CalibrationFit& ended) {
  const CalibrationFit& fit = calibration.fit();
  text.add("status", io::to_string(ended.status));
  if (!ended.reason.empty()) text.add("reason", ended.reason);
  text.add("details", to_string(calibration.details())).add("explained", fit.explained);
  text.add("chi2", fit.chi2).add("reduced_chi2", fit.reduced_chi2()).add("aic", fit.aic);
  text.add("residuals", fit.residual_count).add("parameters", fit.parameter_count);
}

void add_class_notes(std::vector<std::string>& notes, std::string_view what, const std::vector<std::size_t>& determined) {
  std::string others;
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    if (std::find(determined.begin(), determined.end(), c) == determined.end())
      others.append(others.empty() ? "" : ", ").append(wall_class_names[c]);
  }
  if (others.empty()) return;
  notes.push_back(std::string(what) + " of wall class " + others +
                  ": not determined by any load case; the value of the nearest determined class is used");
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
  io::TomlText text;
  text.lines(surrogate_text(reported_parameters(calibration, study)));
  text.table("fit");
  add_outcome(text, calibration, fit);
  if (const std::vector<std::string> failed = failed_details(calibration); !failed.empty()) text.add("failed", failed);
  add_determination(text, fit);
  text.table("fit.confidence_95");
  for (const FittedValue& value : fit.values) {
    if (value.confidence_95) {
      text.add(value.parameter.name, std::array{value.confidence_95->first, value.confidence_95->second});
    } else {
      text.add(value.parameter.name, not_determined);
    }
  }
  for (const StudyCurve& curve : study.curves) {
    const meshes::LoadCase& load_case = curve.curve.provenance.load_case;
    text.entry("fit.curves").add("name", load_case.name).add("subject", meshes::subject_of(load_case));
    text.add("hash", curve.hash).add("table_hash", curve.table_hash);
  }
  return text.text();
}

std::string result_text(const Calibration& calibration, const CalibrationStudy& study, const std::vector<FittedCurve>& curves) {
  const CalibrationFit& fit = calibration.fit();
  io::TomlText text;
  text.table("fit");
  add_outcome(text, calibration, calibration.ended());
  add_determination(text, fit);
  std::vector<std::string> notes = study.notes;
  for (const std::string& note : failed_details(calibration)) notes.push_back(note);
  for (const std::string& note : class_notes(calibration.classes)) notes.push_back(note);
  if (!fit.explained) {
    notes.emplace_back(
        "the stated uncertainties of the curves do not explain the residuals: the surrogate differs in shape, or "
        "curves contradict each other");
  }
  text.add("notes", notes);
  for (const Outlier& outlier : outliers_of(curves, fit)) {
    text.entry("outliers").add("case", curves[outlier.curve].load_case.name).add("ordinate", outlier.ordinate);
    text.add("row", outlier.row + 1).add("standard_deviations", outlier.residual);
  }
  return text.text();
}

}  // namespace menger::voxel
