#include "fem/stall_map/stall_map_output.h"

#include <array>
#include <string>

#include "fem/pneumatics/pneumatic_line.h"
#include "io/picture/chart.h"
#include "io/text/formatted.h"

namespace menger::fem {
namespace {

double swept_m3(const StallMapStudy& study, double stroke_m) {
  Piston piston = study.piston;
  piston.stroke_m = stroke_m;
  return swept_volume_m3(piston);
}

std::optional<double> swept_m3(const StallMapStudy& study, std::optional<double> stroke_m) {
  return stroke_m ? std::optional(swept_m3(study, *stroke_m)) : std::nullopt;
}

constexpr std::array measures{PressureMeasure::peak, PressureMeasure::swing};

std::string word_of(PressureMeasure measure) { return measure == PressureMeasure::peak ? "peak" : "swing"; }

void add_rows(const StallMapStudy& study, const Isobar& isobar, const std::string& label, io::CsvTable& table) {
  for (std::size_t r = 0; r < isobar.strokes_m.size(); ++r)
    table.add_row(word_of(isobar.measure), isobar.frequency_Hz, isobar.pressure_Pa, label, study.resistances_Pa_s_per_m3[r],
                  isobar.strokes_m[r], swept_m3(study, isobar.strokes_m[r]));
}

io::ChartSeries series_of(const StallMapStudy& study, const Isobar& isobar) {
  io::ChartSeries series{.name = io::formatted("%.3g kPa", 1e-3 * isobar.pressure_Pa)};
  for (std::size_t r = 0; r < isobar.strokes_m.size(); ++r) {
    if (!isobar.strokes_m[r]) continue;
    series.x.push_back(study.resistances_Pa_s_per_m3[r]);
    series.y.push_back(1e6 * swept_m3(study, *isobar.strokes_m[r]));
  }
  return series;
}

io::ChartPanel panel_of(const StallMapStudy& study, const StallMap& map, std::size_t frequency, PressureMeasure measure) {
  const double frequency_Hz = study.frequencies_Hz[frequency];
  io::ChartPanel panel{
      .title = word_of(measure) + io::formatted(" at %.3g Hz", frequency_Hz),
      .x = {.title = "resistance of the line (Pa s/m³)",
            .logarithmic = true,
            .lowest = study.resistances_Pa_s_per_m3.front(),
            .highest = study.resistances_Pa_s_per_m3.back()},
      .y = {.title = "swept volume (cm³)", .lowest = 0.0, .highest = 1e6 * swept_m3(study, study.strokes_m.back())}};
  for (const StallMark& mark : study.marks) {
    if (mark.frequency_Hz != frequency_Hz) continue;
    io::ChartSeries series = series_of(study, isobar(study, map, frequency, measure, mark.pressure_Pa));
    series.name = mark.label;
    series.dashed = true;
    series.colour = io::chart_ink;
    panel.series.push_back(series);
  }
  for (std::size_t n = 0; n < study.isobars_Pa.size(); ++n) {
    io::ChartSeries series = series_of(study, isobar(study, map, frequency, measure, study.isobars_Pa[n]));
    series.colour = io::chart_colour(n);
    if (!series.x.empty()) panel.series.push_back(series);
  }
  return panel;
}

io::ChartPanel travel_panel(const StallMapStudy& study, const StallMap& map, std::size_t frequency,
                            const std::vector<StallTravel>& travels) {
  const double frequency_Hz = study.frequencies_Hz[frequency];
  io::ChartPanel panel{.title = io::formatted("travel at %.3g Hz", frequency_Hz),
                       .x = {.title = "swept volume (cm³)", .lowest = 0.0},
                       .y = {.title = "speed (body lengths per minute)", .least_span = 0.1}};
  std::optional<double> resistance;
  for (const StallTravel& travel : travels) {
    const StallPoint& point = map.points.at(travel.point);
    if (point.frequency_Hz != frequency_Hz || !travel.body_lengths_per_minute) continue;
    if (resistance != point.resistance_Pa_s_per_m3) {
      resistance = point.resistance_Pa_s_per_m3;
      panel.series.push_back({.name = io::formatted("%.1e Pa s/m³", *resistance),
                              .marks = io::Marks::line_and_points,
                              .colour = io::chart_colour(panel.series.size())});
    }
    panel.series.back().x.push_back(1e6 * swept_m3(study, point.stroke_m));
    panel.series.back().y.push_back(*travel.body_lengths_per_minute);
  }
  return panel;
}

}  // namespace

io::CsvTable stall_map_table(const StallMapStudy& study, const StallMap& map) {
  io::CsvTable table({"frequency_Hz", "resistance_Pa_s_per_m3", "stroke_m", "swept_volume_m3", "status", "peak_pressure_Pa",
                      "lowest_pressure_Pa", "piston_peak_pressure_Pa", "smallest_volume_m3", "largest_volume_m3",
                      "largest_flow_m3_per_s", "diameter_m", "reynolds_number", "periods"});
  for (const StallPoint& point : map.points) {
    const PneumaticLine line = line_of(study, point.resistance_Pa_s_per_m3);
    std::optional<double> diameter;
    std::optional<double> reynolds;
    if (line.bore) {
      diameter = line.bore->diameter_m;
      reynolds = reynolds_number(study.gas, point.largest_flow_m3_per_s, *line.bore);
    }
    table.add_row(point.frequency_Hz, point.resistance_Pa_s_per_m3, point.stroke_m, swept_m3(study, point.stroke_m),
                  io::to_string(point.status), point.peak_pressure_Pa, point.lowest_pressure_Pa, point.piston_peak_pressure_Pa,
                  point.smallest_volume_m3, point.largest_volume_m3, point.largest_flow_m3_per_s, diameter, reynolds,
                  static_cast<std::uint64_t>(point.periods));
  }
  return table;
}

io::CsvTable isobars_table(const StallMapStudy& study, const StallMap& map) {
  io::CsvTable table(
      {"measure", "frequency_Hz", "pressure_Pa", "label", "resistance_Pa_s_per_m3", "stroke_m", "swept_volume_m3"});
  for (std::size_t f = 0; f < study.frequencies_Hz.size(); ++f) {
    for (const PressureMeasure measure : measures) {
      for (const double pressure : study.isobars_Pa) add_rows(study, isobar(study, map, f, measure, pressure), "", table);
      for (const StallMark& mark : study.marks)
        if (mark.frequency_Hz == study.frequencies_Hz[f])
          add_rows(study, isobar(study, map, f, measure, mark.pressure_Pa), mark.label, table);
    }
  }
  return table;
}

io::PictureOutcome draw_stall_map(const std::filesystem::path& file, const StallMapStudy& study, const StallMap& map,
                                  const std::vector<StallTravel>& travels) {
  io::Chart chart{.title = "piston stroke and line resistance for a pressure in the plenum"};
  for (std::size_t f = 0; f < study.frequencies_Hz.size(); ++f) {
    for (const PressureMeasure measure : measures) chart.panels.push_back(panel_of(study, map, f, measure));
    if (!travels.empty()) chart.panels.push_back(travel_panel(study, map, f, travels));
  }
  return io::write_chart(file, chart, {.width_px = static_cast<int>(800 * chart.panels.size()), .height_px = 900});
}

}  // namespace menger::fem
