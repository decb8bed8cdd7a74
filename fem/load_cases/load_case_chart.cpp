#include "fem/load_cases/load_case_chart.h"

#include <array>
#include <utility>

#include "io/picture/chart.h"
#include "io/text/formatted.h"

namespace menger::fem {
namespace {

using meshes::ResponseCurve;

/// The title of an axis for a column, with the factor from the column's unit to that of the figure.
struct Quantity {
  std::string title;
  double factor = 1.0;
};

Quantity quantity_of(const std::string& column) {
  constexpr std::array<std::pair<const char*, std::pair<const char*, double>>, 7> units{{{"_Pa", {" (kPa)", 1e-3}},
                                                                                         {"_N_m", {" (mN m)", 1e3}},
                                                                                         {"_m", {" (mm)", 1e3}},
                                                                                         {"_N", {" (N)", 1.0}},
                                                                                         {"_rad", {" (rad)", 1.0}},
                                                                                         {"_Hz", {" (Hz)", 1.0}},
                                                                                         {"_change", {" change (%)", 100.0}}}};
  for (const auto& [suffix, unit] : units) {
    if (!column.ends_with(suffix)) continue;
    std::string title = column.substr(0, column.size() - std::string(suffix).size());
    for (char& sign : title)
      if (sign == '_') sign = ' ';
    return {title + unit.first, unit.second};
  }
  return {column, 1.0};
}

std::string pressure_label(double pressure_Pa) { return io::shown(1e-3 * pressure_Pa, 3) + " kPa"; }

std::vector<double> scaled_by(const std::vector<double>& values, double factor) {
  std::vector<double> result = values;
  for (double& value : result) value *= factor;
  return result;
}

io::ChartPanel panel_of(const ResponseCurve& curve, std::size_t ordinate) {
  const std::size_t abscissa = meshes::abscissa_count(curve.provenance.load_case.kind) - 1;
  const Quantity x = quantity_of(curve.columns[abscissa]);
  const Quantity y = quantity_of(curve.columns[ordinate]);
  io::ChartPanel panel;
  panel.x.title = x.title;
  panel.y.title = y.title;
  const std::vector<double>& outer = curve.values.front();
  for (std::size_t row = 0; row < curve.row_count(); ++row) {
    const bool begins = row == 0 || (abscissa > 0 && outer[row] != outer[row - 1]);
    if (begins)
      panel.series.push_back({.name = abscissa > 0 ? pressure_label(outer[row]) : "", .marks = io::Marks::line_and_points});
    panel.series.back().x.push_back(x.factor * curve.values[abscissa][row]);
    panel.series.back().y.push_back(y.factor * curve.values[ordinate][row]);
  }
  return panel;
}

/// Returns one panel of ordinates that share their unit and abscissa.
io::ChartPanel panel_of_all(const ResponseCurve& curve, const std::string& title, const std::vector<std::size_t>& ordinates) {
  io::ChartPanel panel;
  const Quantity x = quantity_of(curve.columns.front());
  panel.x.title = x.title;
  panel.y.title = title;
  for (const std::size_t ordinate : ordinates) {
    const Quantity y = quantity_of(curve.columns[ordinate]);
    panel.series.push_back({.name = y.title.substr(0, y.title.find(" (")),
                            .x = scaled_by(curve.values.front(), x.factor),
                            .y = scaled_by(curve.values[ordinate], y.factor),
                            .marks = io::Marks::line_and_points});
  }
  return panel;
}

}  // namespace

io::PictureOutcome draw_response_curve(const std::filesystem::path& file, const ResponseCurve& curve) {
  io::Chart chart;
  chart.title = curve.provenance.load_case.name;
  switch (curve.provenance.load_case.kind) {
    case meshes::LoadCaseKind::inflation:
      chart.panels = {panel_of(curve, 1), panel_of_all(curve, "growth (mm)", {2, 3, 4, 5})};
      break;
    case meshes::LoadCaseKind::modes:
      chart.panels = {panel_of_all(curve, "natural frequency (Hz)", {1, 2, 3})};
      break;
    default:
      for (std::size_t column = meshes::abscissa_count(curve.provenance.load_case.kind); column < curve.columns.size(); ++column)
        if (chart.panels.size() < 2) chart.panels.push_back(panel_of(curve, column));
      break;
  }
  return io::write_chart(file, chart, {.width_px = static_cast<int>(1000 * chart.panels.size()), .height_px = 900});
}

}  // namespace menger::fem
