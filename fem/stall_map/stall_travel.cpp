#include "fem/stall_map/stall_travel.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <system_error>

#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/side_by_side.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

/// Records in a period of the trajectory. One record lies at the end of the first period.
constexpr int records_per_period = 20;

const io::Words<io::RunStatus>& status_words() {
  static const io::Words<io::RunStatus> words{{io::to_string(io::RunStatus::completed), io::RunStatus::completed},
                                              {io::to_string(io::RunStatus::diverged), io::RunStatus::diverged},
                                              {io::to_string(io::RunStatus::stopped), io::RunStatus::stopped}};
  return words;
}

class Walks {
 public:
  Walks(const StallMapStudy& study, const StallMap& map, const StallTravelOptions& options)
      : study_(study), map_(map), options_(options), program_(io::program_in(options.programs, "menger-simulate")) {
    program_hash_ = io::content_hash(io::read_whole(program_));
  }

  StallTravel walk(std::size_t place) const {
    const std::string scene = travel_scene(study_, map_.points[place]);
    const std::string hash = io::content_hash(program_hash_ + scene + study_.walker->parameters_text);
    const fs::path folder = options_.runs / hash.substr(0, 16);
    StallTravel travel{.point = place};
    if (!read(folder / "result", travel)) simulate(folder, scene, travel);
    return travel;
  }

 private:
  void simulate(const fs::path& folder, const std::string& scene, StallTravel& travel) const {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw io::InputError(folder.string() + ": cannot be created: " + error.message());
    io::write_whole(folder / "scene.toml", scene);
    const io::ChildOutcome outcome = io::run_child({.program = program_,
                                                    .arguments = {"scene.toml", "-o", "result", "--no-pictures"},
                                                    .folder = folder,
                                                    .out = folder / "out.txt",
                                                    .err = folder / "err.txt",
                                                    .stop = options_.stop});
    if (outcome.end == io::ChildEnd::stopped || outcome.exit_code == io::exit_code::interrupted) return;
    if (outcome.exit_code == io::exit_code::bad_input) {
      travel.is_refused = true;
      travel.remark = io::read_whole(folder / "err.txt");
      std::erase(travel.remark, '\n');
    } else if (!read(folder / "result", travel)) {
      throw io::InputError((folder / "scene.toml").string() + ": menger simulate failed: " + io::read_whole(folder / "err.txt"));
    }
  }

  /// Reads a finished walk.
  /// @return whether there is one
  [[nodiscard]] bool read(const fs::path& folder, StallTravel& travel) const {
    if (!io::is_file(folder / "result.toml")) return false;
    const io::TomlTable result = io::read_toml(folder / "result.toml");
    travel.status = result.word("status", status_words());
    if (travel.status == io::RunStatus::stopped) return false;
    travel.remark = result.text_or("reason", "");
    if (const auto surrogate = result.optional_table("surrogate"); surrogate && surrogate->has("outside_validity"))
      travel.remark += (travel.remark.empty() ? "" : "; ") + io::joined(surrogate->texts("outside_validity"), "; ");
    if (travel.status != io::RunStatus::completed) return true;
    const io::CsvContents path = io::read_csv(folder / "trajectory.csv");
    const std::size_t last = path.row_count() - 1;
    if (path.row_count() <= records_per_period + 1)
      throw io::InputError((folder / "trajectory.csv").string() + ": is incomplete");
    const auto moved = [&](const char* column) { return path.number(last, column) - path.number(records_per_period, column); };
    travel.displacement_x_m = moved("centre_of_mass_x_m");
    travel.displacement_y_m = moved("centre_of_mass_y_m");
    travel.body_lengths_per_minute = 60.0 * std::hypot(*travel.displacement_x_m, *travel.displacement_y_m) /
                                     (result.number("body_length_m", io::positive()) * moved("time_s"));
    return true;
  }

  const StallMapStudy& study_;
  const StallMap& map_;
  const StallTravelOptions& options_;
  fs::path program_;
  std::string program_hash_;
};

}  // namespace

std::vector<std::size_t> travel_points(const StallMapStudy& study, const StallMap& map) {
  const StallWalker& walker = *study.walker;
  const std::size_t strokes = study.strokes_m.size();
  std::vector<std::size_t> places;
  for (std::size_t f = 0; f < study.frequencies_Hz.size(); ++f) {
    for (std::size_t r = 0; r < study.resistances_Pa_s_per_m3.size(); r += walker.every_resistance) {
      for (std::size_t s = (strokes - 1) % walker.every_stroke; s < strokes; s += walker.every_stroke) {
        const std::size_t place = (f * study.resistances_Pa_s_per_m3.size() + r) * strokes + s;
        if (map.points.at(place).status == io::RunStatus::completed) places.push_back(place);
      }
    }
  }
  return places;
}

std::string travel_scene(const StallMapStudy& study, const StallPoint& point) {
  const StallWalker& walker = *study.walker;
  const double period_s = 1.0 / point.frequency_Hz;
  const fs::path parameters = fs::absolute(walker.parameters).lexically_normal();
  io::TomlText scene;
  scene.table("design").lines(meshes::design_text(walker.design)).add("level", walker.level);
  scene.table("time").add("duration_s", static_cast<double>(walker.periods) * period_s);
  scene.add("record_interval_s", period_s / records_per_period);
  scene.table("output").add("frames", false);
  scene.table("ground").add("static_friction", walker.static_friction).add("kinetic_friction", walker.kinetic_friction);
  scene.table("surrogate").add("parameters", parameters.string()).add("outside_range", "warn");
  scene.table("drive").add("mode", "in_phase").add("frequency_Hz", point.frequency_Hz);
  scene.add("pressure_Pa", std::vector<double>{point.lowest_pressure_Pa, point.peak_pressure_Pa});
  return scene.text();
}

std::optional<std::vector<StallTravel>> stall_travels(const StallMapStudy& study, const StallMap& map,
                                                      const StallTravelOptions& options) {
  const std::vector<std::size_t> places = travel_points(study, map);
  std::vector<StallTravel> travels(places.size());
  const Walks walks(study, map, options);
  std::mutex mutex;
  std::size_t done = 0;
  const bool is_whole = io::side_by_side(places.size(), options.jobs, options.stop, [&](std::size_t n) {
    travels[n] = walks.walk(places[n]);
    const std::scoped_lock lock(mutex);
    if (options.progress) options.progress(++done);
    return travels[n].is_refused || travels[n].status != io::RunStatus::stopped;
  });
  if (!is_whole) return std::nullopt;
  if (!travels.empty() && std::ranges::all_of(travels, &StallTravel::is_refused))
    throw io::InputError(study.file.string() + ": travel: " + travels.front().remark);
  return travels;
}

io::CsvTable travel_table(const StallMap& map, const std::vector<StallTravel>& travels) {
  io::CsvTable table({"frequency_Hz", "resistance_Pa_s_per_m3", "stroke_m", "lowest_pressure_Pa", "peak_pressure_Pa", "status",
                      "displacement_x_m", "displacement_y_m", "body_lengths_per_minute", "remark"});
  for (const StallTravel& travel : travels) {
    const StallPoint& point = map.points.at(travel.point);
    table.add_row(point.frequency_Hz, point.resistance_Pa_s_per_m3, point.stroke_m, point.lowest_pressure_Pa,
                  point.peak_pressure_Pa, travel.is_refused ? "refused" : io::to_string(travel.status), travel.displacement_x_m,
                  travel.displacement_y_m, travel.body_lengths_per_minute, travel.remark);
  }
  return table;
}

}  // namespace menger::fem
