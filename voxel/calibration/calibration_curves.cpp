#include "voxel/calibration/calibration_curves.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "io/text/content_hash.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "meshes/load_cases/curve_folder.h"
#include "voxel/model/surrogate_file.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

/// Provenance files in the order of their names, independent of the order in the folder.
std::set<fs::path> provenance_files(const io::TomlTable& top, const std::vector<fs::path>& given, const CalibrationStudy& study) {
  const std::vector<fs::path>& places = given.empty() ? study.places : given;
  std::set<fs::path> files;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const std::vector<fs::path> found = meshes::response_curve_files(places[n]);
    files.insert(found.begin(), found.end());
    if (!found.empty()) continue;
    constexpr const char* none = "no response curve (NAME.toml and NAME.csv) is in this folder";
    throw given.empty() ? top.error("curves", none, std::array{n}) : io::InputError(places[n].string() + ": " + none);
  }
  return files;
}

/// The states of a curve whose pressure lies in a range.
meshes::ResponseCurve within(const meshes::ResponseCurve& curve, const ValueRange& pressures_Pa) {
  meshes::ResponseCurve kept{curve.provenance, curve.columns, std::vector<std::vector<double>>(curve.values.size())};
  const std::vector<double>& pressure = curve.column("pressure_Pa");
  for (std::size_t row = 0; row < curve.row_count(); ++row) {
    if (pressure[row] < pressures_Pa.lowest || pressure[row] > pressures_Pa.highest) continue;
    for (std::size_t c = 0; c < curve.values.size(); ++c) kept.values[c].push_back(curve.values[c][row]);
  }
  return kept;
}

void check_curve(const StudyCurve& curve, const CalibrationStudy& study, CurveSubject& wanted) {
  const meshes::CurveProvenance& provenance = curve.curve.provenance;
  const auto require_text = [&](std::string_view what, const std::string& has, const std::string& needs) {
    if (has == needs) return;
    throw io::InputError(curve.file.string() + ": " + std::string(what) + " = " + io::toml_quoted(has) + ": the study is for " +
                         io::toml_quoted(needs));
  };
  const auto require_length = [&](std::string_view what, double has, double needs) {
    constexpr double rounding = 1e-9;
    if (std::abs(has - needs) <= rounding * needs) return;
    throw io::InputError(curve.file.string() + ": " + std::string(what) + " = " + io::number_text(has) + ": the study is for " +
                         io::number_text(needs));
  };
  require_text("silicone", provenance.silicone, wanted.silicone);
  if (!wanted.law) wanted.law = provenance.law;  // all further curves must have the same
  require_text("law", provenance.law, *wanted.law);
  require_length("cell_edge_m", provenance.load_case.cell_edge_m, wanted.cell_edge_m);
  require_length("wall_thickness_m", provenance.load_case.wall_thickness_m, wanted.wall_thickness_m);
  const auto layout = provenance.load_case.per_phase ? meshes::ChamberLayout::per_phase : meshes::ChamberLayout::single;
  require_text("chambers", std::string(to_string(layout)), std::string(to_string(study.chambers)));
  const meshes::CurveProvenance& first = study.curves.empty() ? provenance : study.curves.front().curve.provenance;
  require_length("density_kg_m3", provenance.density_kg_m3, first.density_kg_m3);
  require_length("shear_modulus_Pa", provenance.shear_modulus_Pa, first.shear_modulus_Pa);
}

}  // namespace

void read_curves(const io::TomlTable& top, const std::vector<fs::path>& given, CalibrationStudy& study) {
  const std::vector<std::string> names = study.cases.value_or(std::vector<std::string>());
  const std::set<std::string> cases(names.begin(), names.end());
  CurveSubject wanted = study.subject;
  std::set<std::string> missing = cases;
  std::map<std::string, fs::path> known;
  for (const fs::path& file : provenance_files(top, given, study)) {
    StudyCurve curve{meshes::read_response_curve(file), file, io::file_hash(file),
                     io::file_hash(fs::path(file).replace_extension(".csv"))};
    const std::string& name = curve.curve.provenance.load_case.name;
    missing.erase(name);
    if (study.cases && cases.count(name) == 0) continue;
    if (const auto [other, is_new] = known.emplace(name, file); !is_new) {
      throw io::InputError(file.string() + ": case.name = " + io::toml_quoted(name) + ": " + other->second.string() +
                           " has the same name");
    }
    check_curve(curve, study, wanted);
    if (const auto weight = study.weights.find(curve.curve.provenance.load_case.kind); weight != study.weights.end())
      curve.weight = weight->second;
    if (curve.curve.provenance.status != io::RunStatus::completed) {
      study.notes.push_back(name + " ends early (" + std::string(io::to_string(curve.curve.provenance.status)) +
                            "): " + std::to_string(curve.curve.row_count()) + " states are fitted");
    }
    study.inputs[file.string()] = curve.hash;
    if (study.pressures_Pa) {
      const std::size_t states = curve.curve.row_count();
      curve.curve = within(curve.curve, *study.pressures_Pa);
      if (curve.curve.row_count() == 0)
        throw io::InputError(file.string() + ": has no state within the study's fit.pressures_Pa");
      if (curve.curve.row_count() < states)
        study.notes.push_back(name + ": " + std::to_string(states - curve.curve.row_count()) + " of " + std::to_string(states) +
                              " states lie outside fit.pressures_Pa");
    }
    study.curves.push_back(std::move(curve));
  }
  if (!missing.empty()) throw top.error("cases", "there is no curve for " + io::joined({missing.begin(), missing.end()}));
}

}  // namespace menger::voxel
