#include "voxel/validation/validation_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <system_error>

#include "io/study/installed_folders.h"
#include "io/study/study_reader.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/curve_folder.h"
#include "meshes/load_cases/load_case_subject.h"

namespace menger::voxel {

namespace {

namespace fs = std::filesystem;

fs::path table_beside(const fs::path& provenance) { return fs::path(provenance).replace_extension(".csv"); }

bool is_folder(const fs::path& place) {
  std::error_code ignored;
  return fs::is_directory(place, ignored);
}

std::vector<fs::path> curve_files(const ValidationStudy& study) {
  std::vector<fs::path> files;
  std::set<fs::path> seen;
  for (const fs::path& place : study.curves) {
    const std::vector<fs::path> found = meshes::response_curve_files(place);
    if (found.empty()) throw io::InputError(place.string() + ": contains no response curve (NAME.toml with NAME.csv beside it)");
    for (const fs::path& file : found) {
      if (seen.insert(fs::weakly_canonical(file)).second) files.push_back(file);
    }
  }
  return files;
}

std::string quoted(const std::string& text) { return io::toml_quoted(text); }

bool agree(double a, double b) {
  constexpr double rounding = 1e-9;
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

/// Checks that a curve has the silicone, law, density, cell edge and wall of the parameters. @throws io::InputError if it does
/// not
void check_subject(const HeldOutCurve& held_out, const SurrogateParameters& parameters, const fs::path& parameters_file) {
  const meshes::CurveProvenance& provenance = held_out.curve.provenance;
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& wanted) {
    throw io::InputError(held_out.file.string() + ": " + key + " = " + value + ": the parameters " + parameters_file.string() +
                         " are for " + wanted);
  };
  const auto check_number = [&](const std::string& key, double value, double wanted) {
    if (!agree(value, wanted)) refuse(key, io::number_text(value), io::number_text(wanted));
  };
  if (provenance.silicone != parameters.silicone) refuse("silicone", quoted(provenance.silicone), quoted(parameters.silicone));
  if (provenance.law != parameters.law) refuse("law", quoted(provenance.law), quoted(parameters.law));
  check_number("density_kg_m3", provenance.density_kg_m3, parameters.density_kg_m3);
  check_number("case.cell_edge_m", provenance.load_case.cell_edge_m, parameters.cell_edge_m);
  check_number("case.wall_thickness_m", provenance.load_case.wall_thickness_m, parameters.wall_thickness_m);
}

/// Checks that the parameters were not fitted to a curve. @throws io::InputError if they were
void check_is_held_out(const HeldOutCurve& held_out, const FitRecord& record, const fs::path& parameters_file) {
  const auto refuse_if_known = [&](const fs::path& part, const std::string& key, const std::string& value,
                                   const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), value) == known.end()) return;
    throw io::InputError(part.string() + ": " + key + " = " + quoted(value) + ": is not held out: the parameters " +
                         parameters_file.string() + " were fitted to it");
  };
  for (const fs::path& part : {table_beside(held_out.file), held_out.file})
    refuse_if_known(part, "content hash", io::file_hash(part), record.hashes);
  refuse_if_known(held_out.file, "case", meshes::subject_of(held_out.curve.provenance.load_case), record.subjects);
}

void describe_curves(io::StudyVisitor& visitor, ValidationStudy& study) {
  const bool is_needed = study.curves.empty() && !study.load_cases;
  visitor.paths(
      {.name = "curves",
       .help = "Files of response curves, or folders with such files. Curves of load_cases are written to the first folder.",
       .example = is_needed ? "[\"curves\"]" : "",
       .may_be_elsewhere = true},
      study.curves);
  visitor.check(!study.curves.empty() || study.load_cases, "curves", "must name at least one folder or file of response curves");
}

}  // namespace

void describe(io::StudyVisitor& visitor, ValidationStudy& study) {
  const char* parameters = study.parameters.empty() ? "\"parameters.toml\"" : "";
  visitor.path({.name = "parameters",
                .help = "File of voxel parameters that menger calibrate wrote, or the name of some that come with menger: "
                        "dragon_skin_10_1cm for example.",
                .example = parameters,
                .may_be_elsewhere = true,
                .data = io::parameter_data},
               study.parameters);
  visitor.optional_path({"load_cases", "File of load cases. Their curves are computed first.", "\"load_cases.toml\""},
                        study.load_cases);
  describe_curves(visitor, study);
  visitor.number({"aim", "Aim for the median errors in displacement and volume, as a fraction."}, study.aim, io::positive());
  visitor.number({"actuation_pressure_Pa", "Pressure at which the change of the outer volume is reported."},
                 study.actuation_pressure_Pa, io::positive());
  visitor.number(
      {"actuation_amplitude", "Amplitude of the edges of solid voxels. Their change of volume is reported for comparison."},
      study.actuation_amplitude, io::between(0.0, 1.0));
}

ValidationStudy read_validation_study(const fs::path& file, const ValidationPlaces& instead) {
  ValidationStudy study{.file = file, .parameters = instead.parameters.value_or(fs::path()), .curves = instead.curves};
  io::read_described(io::read_toml(file), study);
  if (instead.parameters) study.parameters = *instead.parameters;
  if (!instead.curves.empty()) {
    study.curves = instead.curves;
    study.load_cases.reset();  // nothing is computed into folders of the user
  }
  return study;
}

fs::path load_case_folder(ValidationStudy& study, const fs::path& fallback) {
  if (study.curves.empty()) study.curves.push_back(fallback);
  const fs::path& folder = study.curves.front();
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !is_folder(folder)) {
    throw io::InputError(study.file.string() + ": curves[1] = " + quoted(folder.string()) +
                         ": must be the folder in which the curves of load_cases are computed");
  }
  return folder;
}

FitRecord read_fit_record(const fs::path& parameters_file) {
  FitRecord record;
  const auto fit = io::read_toml(parameters_file).optional_table("fit");
  if (!fit) return record;
  for (const io::TomlTable& curve : fit->optional_tables("curves")) {
    ++record.curve_count;
    record.hashes.push_back(curve.text("hash"));
    if (curve.has("table_hash")) record.hashes.push_back(curve.text("table_hash"));
    if (curve.has("subject")) record.subjects.push_back(curve.text("subject"));
  }
  return record;
}

std::vector<HeldOutCurve> read_held_out_curves(const ValidationStudy& study, const SurrogateParameters& parameters,
                                               const FitRecord& record) {
  std::vector<HeldOutCurve> curves;
  std::map<std::string, fs::path> known;
  for (const fs::path& file : curve_files(study)) {
    HeldOutCurve held_out{.file = file, .curve = meshes::read_response_curve(file)};
    const std::string& name = held_out.curve.provenance.load_case.name;
    if (const auto [other, is_new] = known.emplace(name, file); !is_new) {
      throw io::InputError(file.string() + ": case.name = " + quoted(name) + ": " + other->second.string() +
                           " has the same name");
    }
    check_subject(held_out, parameters, study.parameters);
    check_is_held_out(held_out, record, study.parameters);
    // Equal except for rounding, but the surrogate needs exactly equal values.
    held_out.curve.provenance.load_case.cell_edge_m = parameters.cell_edge_m;
    held_out.curve.provenance.load_case.wall_thickness_m = parameters.wall_thickness_m;
    curves.push_back(std::move(held_out));
  }
  return curves;
}

}  // namespace menger::voxel
