#include "evolution/page/report_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include "evolution/outputs/report_numbers.h"
#include "evolution/outputs/result_facts.h"
#include "evolution/page/body_frames.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_scenes = 12;

/// What a scene is made from, before its files are read.
struct ScenePlan {
  PageScene scene;    ///< without bodies
  std::string place;  ///< where the results are, which tells scenes of one title apart
  struct Part {
    std::string name;
    fs::path folder;  ///< of the output, which no file of the motion may lie outside of
    fs::path collection;
    int part = 0;
    bool has_phases = true;
    std::optional<ManifestBody> body;
    std::optional<double> held_cell_m{};  ///< see BodyRequest
    fs::path trajectory{};                ///< the table of the centre of mass; empty if there is none
  };
  std::vector<Part> parts;
  bool apart = false;      ///< whether the bodies have to be moved beside each other
  bool on_ground = false;  ///< whether they stand on the ground
};

bool walks(const CommandOutput& output, const char* command) {
  return command_of(output) == command && io::is_file(output.folder / "frames.pvd");
}

ScenePlan::Part walking(const CommandOutput& output) {
  const bool on_elements = command_of(output) == "locomote";
  return {.name = on_elements            ? "finite elements"
                  : output.is_calibrated ? "surrogate"
                                         : "voxels",
          .folder = output.folder,
          .collection = output.folder / "frames.pvd",
          .has_phases = !output.is_in_phase,
          .body = output.stated.body,
          .trajectory = output.folder / "trajectory.csv"};
}

io::TomlTable outcome_of(const CommandOutput& walk) {
  return io::read_toml(walk.folder / (command_of(walk) == "locomote" ? "locomotion.toml" : "result.toml"));
}

/// The direction of a walk, degrees from x; nothing if it is none.
std::optional<double> direction_deg(const io::TomlTable& result) {
  const auto lengths = result.optional_number("horizontal_displacement_body_lengths");
  if (!result.has("displacement_m") || lengths.value_or(0.0) < meshes::walk_limits::least_body_lengths) return std::nullopt;
  const std::vector<double> moved_m = result.numbers("displacement_m");
  if (moved_m.size() != 3) return std::nullopt;
  return meshes::direction_deg(moved_m[0], moved_m[1]);
}

/// Two walks of one body in both models, which are shown beside each other.
struct WalksBeside {
  const CommandOutput* elements = nullptr;
  const CommandOutput* other = nullptr;
  std::array<double, 2> ends_s{};     ///< of both; 0 where it is not known
  double element_count = 0.0;         ///< of the finite elements
  std::optional<double> angle_deg{};  ///< between both, if they last as long and go somewhere
  [[nodiscard]] bool are_as_long() const { return meshes::last_as_long(ends_s[0], ends_s[1]); }
};

WalksBeside walks_beside(const CommandOutput& elements, const CommandOutput& other) {
  WalksBeside walks{.elements = &elements, .other = &other};
  try {
    const io::TomlTable a = outcome_of(elements);
    const io::TomlTable b = outcome_of(other);
    walks.ends_s = {a.number("time_s"), b.number("time_s")};
    walks.element_count = a.optional_number("elements").value_or(0.0);
    const auto a_deg = direction_deg(a);
    const auto b_deg = direction_deg(b);
    if (a_deg && b_deg && walks.are_as_long()) walks.angle_deg = meshes::angle_between_directions_deg(*a_deg, *b_deg);
  } catch (const io::InputError&) {
    return walks;  // told where the walk has its own section
  }
  return walks;
}

/// All walks in both models. Those that decide what is said of the surrogate come first: of equal length, on the finest elements.
std::vector<WalksBeside> all_walks_beside(const std::vector<CommandOutput>& outputs) {
  std::vector<WalksBeside> all;
  for (const CommandOutput& elements : outputs) {
    if (!walks(elements, "locomote")) continue;
    const auto other = std::ranges::find_if(outputs, [&](const CommandOutput& output) {
      return walks(output, "simulate") && are_one_walk(elements.stated, output.stated);
    });
    if (other != outputs.end()) all.push_back(walks_beside(elements, *other));
  }
  std::ranges::stable_sort(all, [](const WalksBeside& a, const WalksBeside& b) {
    if (a.are_as_long() != b.are_as_long()) return a.are_as_long();
    return a.element_count > b.element_count;
  });
  return all;
}

/// That one of two walks ends before the other; empty if they last as long.
std::string ends_text(const WalksBeside& walks) {
  if (walks.are_as_long()) return "";
  return "They do not last as long: " + walking(*walks.elements).name + " " + io::shown(walks.ends_s[0], 3) + " s, " +
         walking(*walks.other).name + " " + io::shown(walks.ends_s[1], 3) + " s. Distances are those at the end of each.";
}

void plan_walks(const std::vector<CommandOutput>& outputs, std::vector<ScenePlan>& plans) {
  std::vector<const CommandOutput*> paired;
  std::vector<ScenePlan> single;
  for (const WalksBeside& both : all_walks_beside(outputs)) {
    const CommandOutput& elements = *both.elements;
    const CommandOutput& other = *both.other;
    paired.insert(paired.end(), {&elements, &other});
    plans.push_back({.scene = {.title = "Walk of " + body_or_place(elements) + ": finite elements and " + walking(other).name,
                               .source = file_of(elements, "frames.pvd") + ", " + file_of(other, "frames.pvd"),
                               .angle_deg = both.angle_deg,
                               .frequency_Hz = elements.stated.stroke_frequency_Hz(),
                               .note = ends_text(both)},
                     .place = elements.name,
                     .parts = {walking(elements), walking(other)},
                     .apart = true,
                     .on_ground = true});
  }
  for (const CommandOutput& output : outputs) {
    if ((!walks(output, "locomote") && !walks(output, "simulate")) || std::ranges::find(paired, &output) != paired.end())
      continue;
    const ScenePlan::Part part = walking(output);
    single.push_back({.scene = {.title = "Walk of " + body_or_place(output) + ": " + part.name,
                                .source = file_of(output, "frames.pvd"),
                                .frequency_Hz = output.stated.stroke_frequency_Hz()},
                      .place = output.name,
                      .parts = {part},
                      .on_ground = true});
  }
  plans.insert(plans.end(), single.begin(), single.end());
}

void plan_reevaluations(const std::vector<CommandOutput>& outputs, std::vector<ScenePlan>& plans) {
  for (const CommandOutput& output : outputs) {
    const fs::path both = output.folder / "winner" / "both.pvd";
    if (command_of(output) != "reevaluate" || !io::is_file(both)) continue;
    plans.push_back({.scene = {.title = "Winner of the re-evaluation: finite elements and the model of the search",
                               .source = file_of(output, "winner/both.pvd"),
                               .frequency_Hz = output.stated.stroke_frequency_Hz()},
                     .place = output.name,
                     .parts = {{.name = "finite elements",
                                .folder = output.folder,
                                .collection = both,
                                .part = 0,
                                .has_phases = !output.is_in_phase,
                                .body = std::nullopt},
                               {.name = "model of the search",
                                .folder = output.folder,
                                .collection = both,
                                .part = 1,
                                .has_phases = !output.is_in_phase,
                                .body = std::nullopt}},
                     .on_ground = true});
  }
}

/// How a body that floats free is shown, and how far it bends.
std::string held_text(const CommandOutput& inflation) {
  std::string text = "It floats free; it is shown as if held at its near end, the lower one along its longest side.";
  if (const auto bend = bend_of(inflation))
    text += " So the middle of its far end moves " + io::millimetres(bend->sideways_m) + " sideways.";
  return text;
}

void plan_inflations(const std::vector<CommandOutput>& outputs, std::vector<ScenePlan>& plans) {
  for (const CommandOutput& output : outputs) {
    const fs::path fields = output.folder / "fields.pvd";
    if (command_of(output) != "inflate" || !io::is_file(fields)) continue;
    const bool is_free = output.stated.supports == "free" && output.stated.body;
    plans.push_back({.scene = {.title = "Inflation of " + body_or_place(output),
                               .source = file_of(output, "fields.pvd"),
                               .clock = "path parameter",
                               .unit = "",
                               .note = is_free ? held_text(output) : ""},
                     .place = output.name,
                     .parts = {{.name = "finite elements",
                                .folder = output.folder,
                                .collection = fields,
                                .has_phases = !output.is_in_phase,
                                .body = output.stated.body,
                                .held_cell_m = is_free ? std::optional(output.stated.body->cell_edge_m) : std::nullopt}}});
  }
}

void plan_validations(const std::vector<CommandOutput>& outputs, std::vector<ScenePlan>& plans) {
  for (const CommandOutput& output : outputs) {
    const fs::path worst = output.folder / "worst.pvd";
    if (command_of(output) != "validate" || !io::is_file(worst)) continue;
    plans.push_back(
        {.scene = {.title = "Worst case of the validation: finite elements and surrogate",
                   .source = file_of(output, "worst.pvd"),
                   .clock = "state",
                   .unit = ""},
         .place = output.name,
         .parts = {{.name = "finite elements", .folder = output.folder, .collection = worst, .part = 0, .body = std::nullopt},
                   {.name = "surrogate", .folder = output.folder, .collection = worst, .part = 1, .body = std::nullopt}}});
  }
}

void plan_champions(const std::vector<CommandOutput>& outputs, std::vector<ScenePlan>& plans) {
  constexpr int most_levels = 5;
  for (const CommandOutput& output : outputs) {
    if (command_of(output) != "export") continue;
    for (int level = 1; level <= most_levels; ++level) {
      const std::string name = "level_" + std::to_string(level);
      const fs::path place = output.folder / name;
      // A walk on finite elements has a manifest, and is found as any other.
      if (!io::is_file(place / "frames.pvd") || io::is_file(place / "manifest.json")) continue;
      plans.push_back({.scene = {.title = "Champion of the search at level " + std::to_string(level),
                                 .source = file_of(output, name + "/frames.pvd"),
                                 .frequency_Hz = output.stated.stroke_frequency_Hz()},
                       .place = output.name,
                       .parts = {{.name = "voxels",
                                  .folder = output.folder,
                                  .collection = place / "frames.pvd",
                                  .body = std::nullopt,
                                  .trajectory = place / "trajectory.csv"}},
                       .on_ground = true});
    }
  }
}

/// The horizontal displacement of the centre of mass at the times of the frames, by interpolation.
std::vector<double> travelled_m(const fs::path& trajectory, const std::vector<double>& times_s) {
  if (!io::is_file(trajectory)) return {};
  const io::CsvContents table = io::read_csv(trajectory);
  std::vector<double> travelled;
  std::size_t row = 0;
  for (const double time_s : times_s) {
    while (row + 1 < table.row_count() && number_in(table, row + 1, "time_s").value_or(time_s) <= time_s) ++row;
    const auto here = row < table.row_count() ? number_in(table, row, "horizontal_displacement_m") : std::nullopt;
    if (!here) return {};
    const auto from = number_in(table, row, "time_s");
    const bool is_last = row + 1 >= table.row_count();
    const auto next = is_last ? std::nullopt : number_in(table, row + 1, "horizontal_displacement_m");
    const auto to = is_last ? std::nullopt : number_in(table, row + 1, "time_s");
    const bool between = from && next && to && *to > *from && time_s > *from;
    travelled.push_back(between ? *here + (*next - *here) * (time_s - *from) / (*to - *from) : *here);
  }
  return travelled;
}

/// Moves the second body of a scene beside the first: both begin at the same place but for a shift along -y.
void move_apart(std::vector<PageBody>& bodies) {
  for (std::size_t n = 1; n < bodies.size(); ++n) {
    const auto [low, high] = box_of(bodies.front(), 0);
    const auto [own_low, own_high] = box_of(bodies[n], 0);
    const double aside_m = 2.2 * static_cast<double>(n) * std::max(high[0] - low[0], high[1] - low[1]);
    const std::array<double, 3> shift{0.5 * (low[0] + high[0] - own_low[0] - own_high[0]),
                                      0.5 * (low[1] + high[1] - own_low[1] - own_high[1]) - aside_m, low[2] - own_low[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bodies[n].origin_m.at(axis) += shift.at(axis);
      for (auto& centre : bodies[n].centres_m) centre.at(axis) += shift.at(axis);
    }
  }
}

/// Adds the place to titles that occur several times.
void tell_apart(std::vector<ScenePlan>& plans) {
  std::map<std::string, int> counts;
  for (const ScenePlan& plan : plans) ++counts[plan.scene.title];
  for (ScenePlan& plan : plans)
    if (counts[plan.scene.title] > 1 && !plan.place.empty()) plan.scene.title += " (" + plan.place + ")";
}

std::size_t bytes_of(const PageScene& scene) {
  std::size_t bytes = 0;
  for (const PageBody& body : scene.bodies)
    bytes += sizeof(std::int16_t) * body.positions.size() + sizeof(body.faces.front()) * body.faces.size();
  return bytes;
}

std::optional<PageScene> scene_of(const ScenePlan& plan, std::size_t most_bytes, std::vector<std::string>& notes) {
  PageScene scene = plan.scene;
  const auto add_note = [&](const std::string& words) {
    if (scene.note.find(words) == std::string::npos) scene.note += (scene.note.empty() ? "" : " ") + words;
  };
  for (const ScenePlan::Part& part : plan.parts) {
    try {
      const std::vector<BodyFrames> bodies = read_body_frames(part.collection, part.folder);
      const auto found = std::ranges::find(bodies, part.part, &BodyFrames::part);
      if (found == bodies.end()) continue;
      PageBody body = read_page_body({.name = part.name,
                                      .frames = found->frames,
                                      .most_bytes = most_bytes / plan.parts.size(),
                                      .has_phases = part.has_phases,
                                      .body = part.body,
                                      .held_cell_m = part.held_cell_m});
      if (const std::string guessed = guess_text(body, found->frames.size(), scene.frequency_Hz.value_or(0.0)); !guessed.empty())
        add_note(guessed);
      if (!part.trajectory.empty()) body.travelled_m = travelled_m(part.trajectory, body.times);
      scene.bodies.push_back(std::move(body));
    } catch (const io::InputError& error) {
      notes.push_back(std::string("not shown in 3-D: ") + error.what());
    }
  }
  if (scene.bodies.empty()) return std::nullopt;
  if (std::ranges::any_of(scene.bodies, [](const PageBody& body) { return body.name != "finite elements"; })) {
    add_note("Voxels are drawn as cubes: their faces are not the surface of a body, and gaps between them are no gaps in it.");
  }
  if (plan.apart) move_apart(scene.bodies);
  if (plan.on_ground) {
    for (const PageBody& body : scene.bodies)
      scene.ground_m = std::min(scene.ground_m.value_or(box_of(body, 0).first[2]), box_of(body, 0).first[2]);
  }
  return scene;
}

}  // namespace

std::string guess_text(const PageBody& body, std::size_t frames, double frequency_Hz) {
  const double strokes = frequency_Hz * (body.times.back() - body.times.front());
  const auto between = static_cast<double>(body.times.size() - 1);
  const std::string name = body.name == "surrogate" ? "the surrogate" : body.name;
  std::string few;
  if (strokes > 1.0 && !shows_strokes(between / strokes))
    few = "frames shown of a stroke: " + io::shown(between / strokes, 2);
  else if (strokes <= 1.0 && 2 * body.times.size() < frames)
    few = std::to_string(body.times.size()) + " of " + std::to_string(frames) + " frames are shown";
  return few.empty() ? "" : "Of " + name + ", " + few + "; between them the motion is a guess along straight lines.";
}

std::vector<PageScene> read_scenes(const std::vector<CommandOutput>& outputs, std::size_t most_bytes,
                                   std::vector<std::string>& notes) {
  std::vector<ScenePlan> plans;
  plan_walks(outputs, plans);
  plan_reevaluations(outputs, plans);
  plan_inflations(outputs, plans);
  plan_champions(outputs, plans);
  plan_validations(outputs, plans);
  tell_apart(plans);
  if (plans.size() > most_scenes) {
    notes.push_back("of " + std::to_string(plans.size()) + " motions, the first " + std::to_string(most_scenes) +
                    " are shown in 3-D");
    plans.resize(most_scenes);
  }
  std::vector<PageScene> scenes;
  std::size_t left = most_bytes;
  for (std::size_t n = 0; n < plans.size(); ++n) {
    // What small scenes do not need, large ones may have.
    std::optional<PageScene> scene = scene_of(plans[n], left / (plans.size() - n), notes);
    if (!scene) continue;
    left -= std::min(left, bytes_of(*scene));
    scenes.push_back(std::move(*scene));
  }
  return scenes;
}

}  // namespace menger::evolution
