#include "fem/load_cases/load_case_chart.h"

#include "io/picture/chart.h"
#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "meshes/load_cases/response_axis.h"

namespace menger::fem {
namespace {

using meshes::ResponseCurve;

std::vector<double> scaled_by(const std::vector<double>& values, double factor) {
  std::vector<double> result = values;
  for (double& value : result) value *= factor;
  return result;
}

io::ChartPanel panel_of(const ResponseCurve& curve, std::size_t ordinate) {
  const std::size_t abscissa = meshes::abscissa_count(curve.provenance.load_case.kind) - 1;
  const io::ShownColumn x = io::shown_column(curve.columns[abscissa]);
  const io::ShownColumn y = io::shown_column(curve.columns[ordinate]);
  io::ChartPanel panel;
  panel.x.title = x.title();
  panel.y.title = y.title();
  const std::vector<double>& outer = curve.values.front();
  for (std::size_t row = 0; row < curve.row_count(); ++row) {
    const bool begins = row == 0 || (abscissa > 0 && outer[row] != outer[row - 1]);
    if (begins)
      panel.series.push_back({.name = abscissa > 0 ? io::kilopascals(outer[row]) : "", .marks = io::Marks::line_and_points});
    panel.series.back().x.push_back(x.factor * curve.values[abscissa][row]);
    panel.series.back().y.push_back(y.factor * curve.values[ordinate][row]);
  }
  return panel;
}

/// Returns one panel of ordinates that share their unit and abscissa.
io::ChartPanel panel_of_all(const ResponseCurve& curve, const std::vector<std::size_t>& ordinates) {
  io::ChartPanel panel;
  const io::ShownColumn x = io::shown_column(curve.columns.front());
  panel.x.title = x.title();
  std::vector<std::string> columns;
  for (const std::size_t ordinate : ordinates) {
    columns.push_back(curve.columns[ordinate]);
    const io::ShownColumn y = io::shown_column(curve.columns[ordinate]);
    panel.series.push_back({.name = y.quantity,
                            .x = scaled_by(curve.values.front(), x.factor),
                            .y = scaled_by(curve.values[ordinate], y.factor),
                            .marks = io::Marks::line_and_points});
  }
  panel.y.title = meshes::response_axis_title(columns);
  return panel;
}

}  // namespace

io::PictureOutcome draw_response_curve(const std::filesystem::path& file, const ResponseCurve& curve) {
  io::Chart chart;
  chart.title = curve.provenance.load_case.name;
  switch (curve.provenance.load_case.kind) {
    case meshes::LoadCaseKind::inflation:
      chart.panels = {panel_of(curve, 1), panel_of_all(curve, {2, 3, 4, 5})};
      break;
    case meshes::LoadCaseKind::modes:
      chart.panels = {panel_of_all(curve, {1, 2, 3})};
      break;
    default:
      for (std::size_t column = meshes::abscissa_count(curve.provenance.load_case.kind); column < curve.columns.size(); ++column)
        if (chart.panels.size() < 2) chart.panels.push_back(panel_of(curve, column));
      break;
  }
  return io::write_chart(file, chart, {.width_px = static_cast<int>(1000 * chart.panels.size()), .height_px = 900});
}

}  // namespace menger::fem
