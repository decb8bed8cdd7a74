#include "materials/fit/fit_file.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "materials/laws/law_file.h"
#include "materials/laws/law_parameters.h"

namespace menger::materials {

namespace {

std::string line(const std::string& key, const std::string& value) { return key + " = " + value + "\n"; }
std::string line(const std::string& key, double value) { return line(key, io::number_text(value)); }
std::string line(const std::string& key, bool value) { return line(key, std::string(value ? "true" : "false")); }
std::string optional_line(const std::string& key, std::optional<double> value) { return value ? line(key, *value) : ""; }

std::string quoted_list(const std::vector<std::string>& texts) {
  std::string list = "[";
  for (const std::string& text : texts) list += (list.size() > 1 ? ", " : "") + io::toml_quoted(text);
  return list + "]";
}

std::string confidence_text(const LawFit& fit) {
  if (fit.confidence_95.empty()) return "";
  std::string text = "[fits.confidence_95]\n";
  const auto parameters = parameters_of(fit.law);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto& interval = fit.confidence_95[p];
    if (!interval) continue;
    text += line(parameters[p].first, "[" + io::number_text(interval->first) + ", " + io::number_text(interval->second) + "]");
  }
  return text;
}

/// A law without stiffness at rest describes no body, and read_law refuses it.
std::string law_table(const LawFit& fit) {
  const bool is_law = shear_modulus_at_rest_Pa(fit.law) > 0.0;
  return is_law ? "[fits.law]\n" + law_text(fit.law) : "[fits.parameters_of_no_law]\n" + law_text(fit.law);
}

std::string table_of(const LawFit& fit) {
  std::string text = "\n[[fits]]\n";
  text += line("name", io::toml_quoted(fit.name));
  text += line("status", io::toml_quoted(io::to_string(fit.status)));
  text += line("shear_modulus_at_rest_Pa", shear_modulus_at_rest_Pa(fit.law));
  text += line("rmse_Pa", fit.rmse_Pa);
  text += line("relative_rmse", fit.relative_rmse);
  text += line("r_squared", fit.r_squared);
  text += line("aic", fit.aic);
  const std::vector<std::string> shortcomings = shortcomings_of(fit);
  text += line("usable", shortcomings.empty());
  if (!shortcomings.empty()) text += line("not_usable_because", quoted_list(shortcomings));
  text += line("stable", fit.stable);
  text += line("stable_with_margin", fit.stable_with_margin);
  text += optional_line("unstable_from_uniaxial_stretch", fit.unstable_uniaxial);
  text += optional_line("unstable_from_equibiaxial_stretch", fit.unstable_equibiaxial);
  text += optional_line("unstable_from_planar_stretch", fit.unstable_planar);
  text += optional_line("unstable_from_compression_to_stretch", fit.unstable_compression);
  text += line("cancelling", fit.cancelling);
  // A number of TOML that readers refuse must not stand here: all may cancel.
  if (std::isfinite(fit.cancelled)) text += line("cancelled", fit.cancelled);
  text += "closer_fits_left_out = " + std::to_string(fit.skipped_count) + "\n";
  text += line("plausible", fit.plausible);
  text += optional_line("equibiaxial_ratio", fit.equibiaxial_ratio);
  if (!fit.at_bound.empty()) text += line("at_bound", quoted_list(fit.at_bound));
  return text + law_table(fit) + confidence_text(fit);
}

io::CsvTable curves_of(const FitReport& report, const TensileTest& test) {
  std::vector<std::string> columns{"strain", "stress_Pa"};
  for (const LawFit& fit : report.ranking) columns.push_back(fit.name + "_stress_Pa");
  io::CsvTable table(columns);
  for (std::size_t i = 0; i < test.strain.size(); ++i) {
    if (!report.range.holds(test.strain[i])) continue;
    std::vector<io::CsvCell> cells{io::cell(test.strain[i]), io::cell(test.stress_Pa[i])};
    for (const LawFit& fit : report.ranking) {
      const NominalStress stress = nominal_stress(fit.law, LoadingMode::uniaxial, 1.0 + test.strain[i]);
      cells.push_back(stress.status == LawStatus::valid ? io::cell(stress.stress_Pa) : io::CsvCell());
    }
    table.add_cells(cells);
  }
  return table;
}

}  // namespace

std::string fit_text(const FitReport& report, const TensileTest& test) {
  const FittedRows rows = fitted_rows(test, report.range);
  std::string text = line("material", io::toml_quoted(report.material));
  text += line("test", io::toml_quoted(report.file.filename().string()));
  if (!report.strain_source.empty()) text += line("strain_source", io::toml_quoted(report.strain_source));
  text += line("repairs", quoted_list(report.repairs));
  text += line("range", "[" + io::number_text(report.range.lowest) + ", " + io::number_text(report.range.highest) + "]");
  text += line("lowest_strain", rows.lowest_strain) + line("highest_strain", rows.highest_strain);
  text += line("notes", quoted_list(cancelling_notes(report.ranking)));
  if (const LawFit* best = recommended_fit(report.ranking)) text += line("recommended", io::toml_quoted(best->name));
  for (const LawFit& fit : report.ranking) text += table_of(fit);
  return text;
}

std::string silicone_text(const FitReport& report, const TensileTest& test, const LawFit& law, double density_kg_per_m3) {
  const FittedRows rows = fitted_rows(test, report.range);
  std::vector<std::string> not_measured{"bulk modulus", "damping", "friction"};
  if (rows.lowest_strain >= 0.0) not_measured.emplace_back("compression");
  std::string source = "tensile test " + report.file.filename().string() + ", strains of " + io::shown(rows.lowest_strain) +
                       " to " + io::shown(rows.highest_strain) + ", fitted by menger fit";
  for (const std::string& repair : report.repairs) source += "; " + repair;
  std::string text(silicone_text_start);
  text += line("name", io::toml_quoted(report.material));
  text += line("not_measured", quoted_list(not_measured));
  text += "\n[data_sheet]\n" + line("source", io::toml_quoted("--density of menger fit"));
  text += line("density_kg_per_m3", density_kg_per_m3);
  text += "\n[recommended]\n" + line("source", io::toml_quoted(source));
  text += line("smallest_stretch", std::min(1.0, 1.0 + rows.lowest_strain));
  text += line("largest_stretch", 1.0 + rows.highest_strain);
  return text + "[recommended.law]\n" + law_text(law.law);
}

void write_fits(const std::filesystem::path& folder, const FitReport& report, const TensileTest& test) {
  io::require_writable_folder(folder);
  io::write_whole(folder / "fits.toml", fit_text(report, test));
  curves_of(report, test).write(folder / "curves.csv");
}

}  // namespace menger::materials
