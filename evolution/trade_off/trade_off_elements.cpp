#include "evolution/trade_off/trade_off_elements.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "evolution/trade_off/trade_off_body.h"
#include "evolution/trade_off/trade_off_runner.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

std::string inflation_text(const TradeStudy& study, const ElementFidelity& fidelity, double pressure_Pa) {
  io::TomlText text;
  text.table("design").add("file", "design.toml");
  if (fidelity.thin_walls) {
    text.add("wall_thickness_m", study.wall_thickness_m).add("chambers", study.chambers).add("level", study.level);
    text.table("elements").add("kind", "thin_wall").add("fidelity", std::string(fem::to_string(*fidelity.thin_walls)));
  } else {
    text.lines(meshes::hollow_body_text(hollow_options(study, fidelity), "design"));
    text.table("elements").add("degree", fidelity.degree);
  }
  text.table("material").add("silicone", "silicone.toml").add("bulk_modulus_Pa", fidelity.bulk_ratio * study.shear_modulus_Pa);
  text.table("supports").add("kind", "free");
  text.table("path").add("pressure_Pa", std::vector<double>{0.0, pressure_Pa});
  text.table("solver").add("force_tolerance", fidelity.force_tolerance);
  return text.table("output").add("fields", false).add("pictures", false).text();
}

/// Returns the change of a column from the first to the last row.
double growth(const io::CsvContents& curves, const std::string& column) {
  return curves.number(curves.row_count() - 1, column) - curves.number(0, column);
}

double volume_change(const io::CsvContents& curves) {
  double rest_m3 = 0.0;
  double change_m3 = 0.0;
  for (const std::string& column : curves.columns()) {
    if (!column.starts_with("chamber_") || !column.ends_with("_volume_m3")) continue;
    rest_m3 += curves.number(0, column, io::positive());
    change_m3 += growth(curves, column);
  }
  return change_m3 / rest_m3;
}

double observed(TradeObservable observable, const io::CsvContents& curves) {
  if (observable == TradeObservable::volume_change) return volume_change(curves);
  return growth(curves, column_of(observable));
}

auto fineness(const ElementFidelity& f) {
  return std::tuple(!f.thin_walls, f.thin_walls, f.degree * f.elements_through_wall, f.degree, f.bulk_ratio, -f.force_tolerance);
}

std::string elements_text(const ElementFidelity& fidelity) {
  if (fidelity.thin_walls) return "thin walls, " + std::string(fem::to_string(*fidelity.thin_walls));
  return (fidelity.degree == 1 ? "Q1/P0, elements through the wall: " : "Q2/P1, elements through the wall: ") +
         std::to_string(fidelity.elements_through_wall);
}

}  // namespace

std::vector<ElementFidelity> element_fidelities(const ElementChoice& choice) {
  std::vector<ElementFidelity> meshes;
  for (const fem::Fidelity fidelity : choice.thin_walls) meshes.push_back({.thin_walls = fidelity});
  for (const int degree : choice.degrees) {
    for (const int through : choice.elements_through_wall) meshes.push_back({.degree = degree, .elements_through_wall = through});
  }
  std::vector<ElementFidelity> all;
  for (ElementFidelity fidelity : meshes) {
    for (const double ratio : choice.bulk_ratios) {
      for (const double tolerance : choice.force_tolerances) {
        fidelity.bulk_ratio = ratio;
        fidelity.force_tolerance = tolerance;
        all.push_back(fidelity);
      }
    }
  }
  std::ranges::sort(all, [](const ElementFidelity& a, const ElementFidelity& b) { return fineness(a) < fineness(b); });
  return all;
}

TradeRow element_row(const ElementFidelity& fidelity) {
  TradeRow row{.model = "finite elements", .label = {}};
  row.label = elements_text(fidelity) + ", bulk ratio " + io::number_text(fidelity.bulk_ratio) + ", tolerance " +
              io::number_text(fidelity.force_tolerance);
  row.fidelity = {{"bulk_ratio", io::number_text(fidelity.bulk_ratio)},
                  {"force_tolerance", io::number_text(fidelity.force_tolerance)}};
  if (fidelity.thin_walls) {
    row.fidelity["thin_walls"] = fem::to_string(*fidelity.thin_walls);
  } else {
    row.fidelity["degree"] = std::to_string(fidelity.degree);
    row.fidelity["elements_through_wall"] = std::to_string(fidelity.elements_through_wall);
  }
  return row;
}

io::ProgramJob element_job(const TradeStudy& study, const ElementFidelity& fidelity, double pressure_Pa, const fs::path& program,
                           std::uint64_t unknowns) {
  io::ProgramJob job;
  job.name = "finite elements: " + element_row(fidelity).label;
  job.program = program;
  job.arguments = {"inflate.toml", "-o", "result", "--no-pictures"};
  job.inputs = {{"inflate.toml", inflation_text(study, fidelity, pressure_Pa)},
                {"design.toml", meshes::design_text(study.design)},
                {"silicone.toml", io::read_whole(study.silicone_file)}};
  job.time_limit_s = study.elements->time_limit_s;
  // About six steps of five iterations. The cost of the direct solver grows with the unknowns to a power between 4/3 and 2.
  job.estimated_s = 1.0 + 3.0 * std::pow(static_cast<double>(unknowns) / 2e4, 1.6);
  return job;
}

void read_element_result(const TradeStudy& study, const io::ProgramJobResult& result, TradeRow& row) {
  const io::TomlTable summary = read_summary(result, row);
  row.unknowns = summary.integer<std::uint64_t>("unknowns", io::at_least(0));
  row.steps = summary.integer<std::uint64_t>("accepted_newton_iterations", io::at_least(0));
  if (row.status != "completed") return;
  const io::CsvContents curves = io::read_csv(result.folder / "result/curves.csv");
  if (curves.row_count() < 2) throw io::InputError("curves.csv holds no state beyond rest");
  for (std::size_t n = 0; n < study.observables.size(); ++n) row.values[n] = observed(study.observables[n], curves);
}

std::optional<double> limit_pressure_Pa(const io::ProgramJobResult& result) {
  const io::TomlTable summary = io::read_toml(result.folder / "result/result.toml");
  std::optional<double> least;
  for (const io::TomlTable& limit : summary.optional_tables("limit_points")) {
    const double pressure_Pa = limit.number("pressure_Pa");
    if (!least || std::abs(pressure_Pa) < std::abs(*least)) least = pressure_Pa;
  }
  return least;
}

}  // namespace menger::evolution
