#include "fem/inflation/modes_files.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>

#include "fem/inflation/field_grid.h"
#include "fem/inflation/inflation_tables.h"
#include "io/picture/chart.h"
#include "io/text/formatted.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "io/vtk/vtk_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view shape_prefix = "mode_";

/// Returns the largest magnitude of the amplitudes of a curve.
double peak_of(const ModesCurve& curve) {
  double peak = 0.0;
  for (const auto& amplitude : curve.amplitudes) peak = std::max(peak, amplitude ? std::abs(*amplitude) : 0.0);
  return peak;
}

io::ChartSeries series_of(const ModesResult& result, const ModesCurve& curve, double scale) {
  io::ChartSeries series{.name = curve.name};
  for (std::size_t f = 0; f < result.frequencies_Hz.size(); ++f) {
    if (!curve.amplitudes[f] || std::abs(*curve.amplitudes[f]) == 0.0) continue;  // the axis is logarithmic
    series.x.push_back(result.frequencies_Hz[f]);
    series.y.push_back(scale * std::abs(*curve.amplitudes[f]));
  }
  return series;
}

/// Returns the panel of some curves. Curves that are zero by symmetry, except for rounding, are left out.
io::ChartPanel panel_of(const ModesResult& result, const std::string& title, std::size_t first, std::size_t last, double scale) {
  constexpr double rounding = 1e-6;
  io::ChartPanel panel;
  panel.x.title = "frequency (Hz)";
  panel.y.title = title;
  double peak = 0.0;
  for (std::size_t c = first; c < last; ++c) peak = std::max(peak, peak_of(result.curves[c]));
  for (std::size_t c = first; c < last; ++c)
    if (peak_of(result.curves[c]) > rounding * peak) panel.series.push_back(series_of(result, result.curves[c], scale));
  for (const double frequency_Hz : result.states.back().vibrations.frequencies_Hz) {
    if (frequency_Hz > result.frequencies_Hz.back()) continue;
    panel.markers.push_back(
        {io::ChartMarker::Direction::vertical, frequency_Hz, panel.markers.empty() ? "natural frequencies" : ""});
  }
  return panel;
}

}  // namespace

io::CsvTable modes_table(const ModesResult& result) {
  std::vector<std::string> columns{"path_parameter"};
  for (const std::string& plenum : result.plenum_names) columns.push_back(io::column_part(plenum) + "_pressure_Pa");
  for (const char* name : {"rigid_modes", "mode", "frequency_Hz"}) columns.emplace_back(name);
  io::CsvTable table(columns);
  for (const ModesState& state : result.states) {
    std::vector<io::CsvCell> begin{io::cell(state.s)};
    for (const double pressure_Pa : state.pressures_Pa) begin.push_back(io::cell(pressure_Pa));
    begin.push_back(io::cell(state.vibrations.rigid_modes));
    const auto add = [&](const io::CsvCell& mode, const io::CsvCell& frequency_Hz) {
      std::vector<io::CsvCell> row = begin;
      row.push_back(mode);
      row.push_back(frequency_Hz);
      table.add_cells(row);
    };
    const auto& frequencies_Hz = state.vibrations.frequencies_Hz;
    for (std::size_t m = 0; m < frequencies_Hz.size(); ++m) add(io::cell(static_cast<int>(m) + 1), io::cell(frequencies_Hz[m]));
    if (frequencies_Hz.empty()) add({}, {});
  }
  return table;
}

io::CsvTable frequency_response_table(const ModesResult& result) {
  std::vector<std::string> columns{"frequency_Hz"};
  for (const ModesCurve& curve : result.curves) {
    for (const char* part : {"real", "imaginary"})
      columns.push_back(io::column_part(curve.name) + "_" + part + "_" + curve.unit + "_per_Pa");
  }
  io::CsvTable table(columns);
  for (std::size_t f = 0; f < result.frequencies_Hz.size(); ++f) {
    std::vector<io::CsvCell> row{io::cell(result.frequencies_Hz[f])};
    for (const ModesCurve& curve : result.curves) {
      const auto& amplitude = curve.amplitudes[f];
      row.push_back(amplitude ? io::cell(amplitude->real()) : io::CsvCell{});
      row.push_back(amplitude ? io::cell(amplitude->imag()) : io::CsvCell{});
    }
    table.add_cells(row);
  }
  return table;
}

std::string modes_result_text(const ModesResult& result) {
  io::TomlText text;
  text.add("status", io::to_string(result.status));
  if (!result.reason.empty()) text.add("reason", result.reason);
  text.add("elements", result.elements);
  text.add("unknowns", result.unknowns);
  text.add("linear_solver", result.linear_solver);
  text.line("notes = [");
  for (const std::string& note : result.notes) text.line("  " + io::toml_quoted(note) + ",");
  text.line("]");
  for (const ModesState& state : result.states) {
    text.line("").entry("states").add("path_parameter", state.s).add("status", io::to_string(state.vibrations.status));
    if (!state.vibrations.reason.empty()) text.add("reason", state.vibrations.reason);
    text.add("rigid_modes", state.vibrations.rigid_modes);
  }
  return text.text();
}

io::PictureOutcome draw_frequency_response(const fs::path& file, const ModesResult& result) {
  // the first curve is the volume's, then three components of each point
  const std::size_t last = std::min<std::size_t>(result.curves.size(), 7);
  io::Chart chart{.title = "response to harmonic chamber pressure",
                  .panels = {panel_of(result, "amplitude of chamber volume (cm³/kPa)", 0, 1, 1e9),
                             panel_of(result, "amplitude of displacement (mm/kPa)", 1, last, 1e6)}};
  return io::write_chart(file, chart, {.width_px = 2000, .height_px = 900});
}

void write_mode_shapes(const fs::path& folder, const Space& space, std::span<const double> displacements,
                       const NodalFields& fields, const FieldStep& step, const VibrationReport& vibrations) {
  for (std::size_t m = 0; m < vibrations.modes.size(); ++m) {
    const std::vector<double>& mode = vibrations.modes[m];
    double largest = 0.0;
    for (std::size_t n = 0; n < mode.size(); n += 3) largest = std::max(largest, std::hypot(mode[n], mode[n + 1], mode[n + 2]));
    const auto grid = field_grid(space, displacements, fields, step);
    vtkNew<vtkDoubleArray> shape;
    shape->SetName("mode");
    shape->SetNumberOfComponents(3);
    for (std::size_t n = 0; n < mode.size(); n += 3)
      shape->InsertNextTuple3(mode[n] / largest, mode[n + 1] / largest, mode[n + 2] / largest);
    grid->GetPointData()->AddArray(shape);
    vtkNew<vtkDoubleArray> frequency;
    frequency->SetName("frequency_Hz");
    frequency->InsertNextValue(vibrations.frequencies_Hz[m]);
    grid->GetFieldData()->AddArray(frequency);
    io::write_vtu(folder / (std::string(shape_prefix) + io::padded(m + 1, 2) + ".vtu"), *grid);
  }
}

void remove_mode_shapes(const fs::path& folder) { io::remove_files(folder, {std::string(shape_prefix) + "*.vtu"}); }

}  // namespace menger::fem
