#include "meshes/robot/robot_file.h"

#include <algorithm>
#include <string>
#include <vector>

#include "io/study/installed_folders.h"
#include "io/study/study_reader.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "materials/laws/silicone_library.h"
#include "materials/laws/study_law.h"
#include "meshes/design/connectivity.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/design/weak_contacts.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

/// No cell of a robot is as large; who states more has written millimetres.
constexpr double largest_cell_edge_m = 0.5;

/// Walls down to this share of the edge of a cell have been tested.
constexpr double thinnest_wall_share = 0.02;

/// No walk is as long; who states more has written milliseconds.
constexpr double longest_walk_s = 3600.0;

/// Cells that a message names.
constexpr std::size_t named_cells = 4;

/// A cell by its place, counted from 0, and where it is written in layers, whose entries count from 1: "(2, 1, 0) (digit 3 of
/// layers[1][2])".
std::string cell_in_file(const CellIndex& place, std::string_view key) {
  const auto from_1 = [](int at) { return std::to_string(at + 1); };
  if (key != "layers") return cell_text(place);
  return cell_text(place) + " (digit " + from_1(place.x) + " of layers[" + from_1(place.z) + "][" + from_1(place.y) + "])";
}

/// The cells outside the largest part of a body, by their places: "cell (0, 0, 0) is", "cells (0, 0, 0), (2, 0, 0) and 3 more
/// are".
/// @param key of the table that has the body
std::string cells_apart(const Polycube& body, std::string_view key) {
  const Polycube largest = largest_component(body);
  std::vector<std::string> places;
  std::size_t count = 0;
  for (const CellIndex& place : body.occupied()) {
    if (largest.at(place) != empty) continue;
    if (++count <= named_cells) places.push_back(cell_in_file(place, key));
  }
  std::string text = (count == 1 ? "cell " : "cells ") + io::joined(places);
  if (count > places.size()) text += " and " + std::to_string(count - places.size()) + " more";
  return text + (count == 1 ? " is" : " are");
}

/// Refuses lengths in other units, walls that are too thin, and a body that cannot be cast as one.
void check_body(const Robot& robot, const io::TomlTable& table) {
  if (robot.design.cell_edge_m > largest_cell_edge_m) {
    const std::string reason =
        "is more than " + io::number_text(largest_cell_edge_m) + " m: lengths are in metres, 12 mm are 0.012";
    if (table.has("cell_edge_m")) throw table.error("cell_edge_m", reason);
    throw table.error("file", "its cell_edge_m " + reason);
  }
  const double thinnest_m = thinnest_wall_share * robot.design.cell_edge_m;
  if (robot.wall_thickness_m < thinnest_m) {
    const std::string reason = "must be at least " + io::number_text(thinnest_wall_share) + " of cell_edge_m, " +
                               io::number_text(thinnest_m) + ": thinner walls have not been tested (lengths are in metres)";
    if (table.has("wall_thickness_m")) throw table.error("wall_thickness_m", reason);
    throw table.error(
        table.has("cell_edge_m") ? "cell_edge_m" : "file",
        "is too large for wall_thickness_m, which is " + io::number_text(robot.wall_thickness_m) + " if not given and " + reason);
  }
  if (!robot.has_body()) return;
  const std::string_view key = robot.design_file ? "file" : table.has("digits") ? "digits" : "layers";
  if (const std::size_t parts = count_components(robot.design.body); parts > 1)
    throw table.error(key, "the body is in " + std::to_string(parts) + " parts that are not joined by a side of a cell: " +
                               cells_apart(robot.design.body, key) + " not joined to the largest part");
  if (const auto contact = first_weak_contact(robot.design.body)) {
    throw table.error(key, "cells " + cell_in_file(contact->first, key) + " and " + cell_in_file(contact->second, key) +
                               " touch only along an edge or at a corner: a cast body would break there");
  }
}

void describe_body(io::StudyVisitor& visitor, Robot& robot) {
  std::optional<bool> evolves;
  if (robot.evolves) evolves = true;
  visitor.optional_word(
      {"design", "In place of layers: the body is that of the best robot that a search finds, of at most 3 x 3 x 3 cells.",
       "\"evolve\""},
      evolves, io::Words<bool>{{"evolve", true}});
  robot.evolves = evolves.has_value();
  if (robot.evolves) {
    const io::TomlTable* table = visitor.source();
    for (const std::string_view key : {"layers", "digits", "file"})
      visitor.check(table == nullptr || !table->has(key), key, "cannot stand beside design = \"evolve\"");
    robot.design.body = Polycube();
    visitor.number({"cell_edge_m", "Edge of a cell.", "0.01"}, robot.design.cell_edge_m, io::positive());
    if (robot.design.name.empty()) robot.design.name = "robot";
    visitor.text({"name", "Name of the design."}, robot.design.name);
  } else {
    describe_design(visitor, robot.design, robot.design_file);
  }
  visitor.number({"wall_thickness_m", "Thickness of every wall."}, robot.wall_thickness_m, io::positive());
  visitor.check(2.0 * robot.wall_thickness_m < robot.design.cell_edge_m, "wall_thickness_m",
                "walls fill a cell: must be less than half of cell_edge_m (lengths are in metres)");
  visitor.word(
      {"chambers", "Cells that share one chamber: all of them, or each connected region of cells of one material (per-phase)."},
      robot.chambers, chamber_layout_words());
  visitor.text({"silicone",
                "Silicone to cast it from: dragon_skin_10, dragon_skin_20, dragon_skin_30, ecoflex_00_10, ecoflex_00_30, "
                "ecoflex_00_50, or a file of your own (see materials/README.md).",
                "\"dragon_skin_10\""},
               robot.silicone);
  visitor.text({"law_name",
                "Law in the record of the silicone: the recommended one, or the name of another. menger loop says which is the "
                "softest."},
               robot.law_name);
  visitor.integer({"law_variant", "Number of the law, if the record has several of this name."}, robot.law_variant,
                  io::at_least(1));
}

/// Who states less, and less than a part of what moves such walls, has likely written kilopascals.
constexpr double least_drive_Pa = 100.0;
constexpr double least_drive_share = 0.1;

/// Refuses kilopascals in place of pascals. What such walls need decides, too: very thin and soft ones move at some pascals.
void check_drive(const Robot& robot, const io::TomlTable& top) {
  if (!robot.pressure_Pa) return;
  const double moves_Pa = usual_pressure_Pa(robot);
  const double highest_Pa = std::max(robot.pressure_Pa->back(), -robot.pressure_Pa->front());
  if (highest_Pa >= least_drive_Pa || highest_Pa >= least_drive_share * moves_Pa) return;
  throw top.table("drive").error("pressure_Pa", "is in pascals, and " + io::number_text(highest_Pa) + " kPa are " +
                                                    io::number_text(1e3 * highest_Pa) + ": " + io::number_text(highest_Pa) +
                                                    " Pa moves nothing where such walls take some " + io::number_text(moves_Pa) +
                                                    " Pa");
}

/// Of the air around, absolute.
constexpr double atmosphere_Pa = 101325.0;

bool is_number(const io::TomlTable& table, std::string_view key) {
  if (!table.has(key)) return false;
  try {
    static_cast<void>(table.unasked().number(key));
    return true;
  } catch (const io::InputError&) {
    return false;
  }
}

void describe_drive(io::StudyVisitor& visitor, Robot& robot) {
  if (const io::TomlTable* table = visitor.source(); table != nullptr && is_number(*table, "pressure_Pa"))
    throw table->error("pressure_Pa", "must be two numbers, the lowest and the highest pressure, such as [0, 3000]");
  std::optional<std::vector<double>> pressure_Pa;
  if (robot.pressure_Pa) pressure_Pa.emplace(robot.pressure_Pa->begin(), robot.pressure_Pa->end());
  visitor.optional_numbers(
      {"pressure_Pa",
       "Lowest and highest pressure in the chambers, above that around them; vacuum is negative, as in [-3000, 0]. Without it, 0 "
       "and what "
       "loads these walls as 6 kPa loads walls of 2 mm between cells of 10 mm in Dragon Skin 10: the first line of "
       "menger loop has it.",
       "[0, 6000]"},
      pressure_Pa, io::any_number(), {.fewest = 2, .most = 2});
  robot.pressure_Pa.reset();
  if (pressure_Pa && pressure_Pa->size() == 2) robot.pressure_Pa = {pressure_Pa->front(), pressure_Pa->back()};
  visitor.check(!robot.pressure_Pa || robot.pressure_Pa->front() <= robot.pressure_Pa->back(), "pressure_Pa",
                "the lowest comes first");
  visitor.check(!robot.pressure_Pa || robot.pressure_Pa->front() != 0.0 || robot.pressure_Pa->back() != 0.0, "pressure_Pa",
                "must not be 0 all the time");
  visitor.check(!robot.pressure_Pa || robot.pressure_Pa->front() >= -atmosphere_Pa, "pressure_Pa",
                "is below a perfect vacuum, which is " + io::number_text(-atmosphere_Pa));
  visitor.number(
      {"frequency_Hz",
       "Strokes per second. In a stroke the pressure swings from the middle of both up, down and back as a sine, which "
       "grows from 0 over the first stroke."},
      robot.frequency_Hz, io::positive());
  visitor.word({"mode",
                "in_phase: all chambers at the same time; antiphase: those of material 2 half a period later, which needs "
                "chambers = \"per-phase\"; hold: all have the highest pressure all the time."},
               robot.drive, io::words_of(RobotDrive::in_phase, RobotDrive::antiphase, RobotDrive::hold));
  visitor.check(robot.drive != RobotDrive::antiphase || robot.chambers == ChamberLayout::per_phase, "mode",
                "needs robot.chambers = \"per-phase\": a chamber has one pressure");
  visitor.check(robot.drive != RobotDrive::antiphase || !robot.has_body() || chamber_count(robot) > 1, "mode",
                "needs cells of material 1 and of material 2: all of this body would move together");
  visitor.check(robot.drive != RobotDrive::hold || !robot.pressure_Pa || robot.pressure_Pa->back() != 0.0, "mode",
                "keeps the highest of pressure_Pa, which is 0");
}

void describe_search(io::StudyVisitor& visitor, RobotSearch& search) {
  visitor.word(
      {"model",
       "What moves the robots of the search. finite_elements: silicone, slow and true; voxels: the surrogate, fast; both: "
       "voxels choose which of them finite elements evaluate."},
      search.model, io::words_of(RobotSearchModel::finite_elements, RobotSearchModel::voxels, RobotSearchModel::both));
  visitor.word(
      {"measure",
       "What is rewarded. last_periods: the displacement in one stroke, so walking; net_displacement: that from start to "
       "end, so also a fall."},
      search.measure, io::words_of(RobotMeasure::last_periods, RobotMeasure::net_displacement));
  visitor.boolean({"robust",
                   "Whether a robot counts as much as in the worst of several frictions and losses of silicone, of which none is "
                   "measured. Only where finite elements decide; six times the work."},
                  search.robust);
  visitor.check(!search.robust || (search.model != RobotSearchModel::voxels && search.measure == RobotMeasure::last_periods),
                "robust", "needs model = \"finite_elements\" or \"both\", and measure = \"last_periods\"");
  visitor.integer({"generations", "Generations after the first."}, search.generations, io::non_negative());
  visitor.integer({"survivors", "Robots that survive a generation."}, search.survivors, io::within(1, 1e6));
  visitor.integer(
      {"mutants",
       "Children in each generation, each of which walks: on finite elements that takes a core some seconds, and more "
       "where chambers are driven apart."},
      search.mutants, io::within(0, 1e6));
  visitor.integer({"evaluated_best", "Robots that walk again on finer elements at the end."}, search.evaluated_best,
                  io::within(1, 1e6));
  visitor.integer({"seed", "Seed of the random numbers."}, search.seed, io::non_negative());
}

bool has_key(const io::TomlTable& top, std::string_view table, std::string_view key) {
  return top.has(table) && top.unasked().table(table).unasked().has(key);
}

/// What the file of a robot says in vain, or may not mean.
std::vector<std::string> notes_of(const Robot& robot, const io::TomlTable& top) {
  std::vector<std::string> notes;
  const bool is_held = robot.drive == RobotDrive::hold;
  if (is_held && has_key(top, "drive", "frequency_Hz"))
    notes.emplace_back("drive.frequency_Hz has no effect: with mode = \"hold\" the pressure stays");
  if (is_held && robot.walks) {
    notes.emplace_back(
        "it is filled once and keeps its pressure (drive.mode = \"hold\"), so that it does not walk; for a finger or a "
        "gripper set walk.present = false");
  }
  if (!robot.walks && has_key(top, "walk", "duration_s"))
    notes.emplace_back("walk.duration_s has no effect: walk.present = false");
  const double stroke_s = 1.0 / robot.frequency_Hz;
  if (robot.walks && !is_held && robot.duration_s < stroke_s)
    notes.push_back("the walk of " + io::shown(robot.duration_s) + " s ends within the first stroke, which takes " +
                    io::shown(stroke_s) + " s and in which the drive only grows: raise walk.duration_s or drive.frequency_Hz");
  const Polycube& body = robot.design.body;
  const auto has = [&](Material material) {
    return std::ranges::any_of(body.occupied(), [&](const CellIndex& place) { return body.at(place) == material; });
  };
  if (robot.chambers == ChamberLayout::single && robot.has_body() && has(1) && has(2))
    notes.emplace_back(
        "digits 1 and 2 mean the same here: with chambers = \"single\" all cells share one chamber, and one pressure");
  if (robot.search && !robot.evolves)
    notes.emplace_back(
        "[search] looks for another body, from random ones; the stages up to the walks compute the body of this file");
  if (robot.search && !robot.walks) notes.emplace_back("[search] lets its robots walk, although walk.present = false");
  if (robot.design_file && has_key(top, "robot", "cell_edge_m"))
    notes.push_back("robot.cell_edge_m, " + io::shown(robot.design.cell_edge_m) + " m, takes the place of that in robot.file");
  return notes;
}

}  // namespace

void describe(io::StudyVisitor& visitor, Robot& robot) {
  visitor.table({"robot", "The body, and what it is cast from."}, [&] { describe_body(visitor, robot); });
  visitor.table({"drive", "The air that drives it."}, [&] { describe_drive(visitor, robot); });
  visitor.table({"ground", "The ground that it walks on. Friction of silicone is hardly measured: these are assumptions."}, [&] {
    visitor.number({"static_friction", "Coefficient of friction at rest."}, robot.static_friction, io::non_negative());
    visitor.number({"kinetic_friction", "Coefficient of friction while sliding, at most that at rest."}, robot.kinetic_friction,
                   io::non_negative());
    visitor.check(robot.kinetic_friction <= robot.static_friction, "kinetic_friction",
                  "must be at most static_friction, which is " + io::number_text(robot.static_friction) + "; left out, it is " +
                      io::number_text(Robot().kinetic_friction));
  });
  visitor.table({"walk", "The walk that both models compute."}, [&] {
    visitor.boolean(
        {"present",
         "Whether it is put on the ground and driven. false for a finger or a gripper: it is inflated without a ground."},
        robot.walks);
    visitor.number({"duration_s",
                    "Simulated time. Robots of a search walk for six strokes instead; a copy of the study that "
                    "menger loop --write-studies writes for it can be given another time."},
                   robot.duration_s, {.lowest = 0.0, .highest = longest_walk_s, .lowest_excluded = true});
    visitor.word({"fidelity",
                  "How finely walls are cut into finite elements, also where the body is inflated. The robot walks on the next "
                  "finer ones, too, to show how well "
                  "its walk is known."},
                 robot.fidelity, io::words_of(RobotFidelity::draft, RobotFidelity::standard, RobotFidelity::fine));
  });
  visitor.table({"surrogate", "The fast stand-in of voxels."}, [&] {
    visitor.optional_path(
        {.name = "parameters",
         .help =
             "Parameters of the voxels: a file that menger calibrate wrote, or the name of some that come with menger. Without "
             "it, those that come with menger for this silicone, cell edge and wall, or else parameters that are fitted.",
         .example = "\"parameters.toml\"",
         .data = io::parameter_data},
        robot.parameters);
    visitor.boolean({"fit_anew", "Whether parameters are fitted although menger comes with some (minutes)."}, robot.fits_anew);
    visitor.check(!robot.parameters || !robot.fits_anew, "fit_anew", "cannot be true beside parameters");
  });
  visitor.optional_table({"search", "A search for a body that walks, of the same cells, walls, silicone, drive and ground."},
                         robot.search, [&](RobotSearch& search) { describe_search(visitor, search); });
}

bool is_robot_file(const fs::path& file) {
  if (file.extension() != ".toml" || !io::is_file(file)) return false;
  try {
    return io::read_toml(file).is_table("robot");
  } catch (const io::InputError&) {
    return false;
  }
}

Robot read_robot(const fs::path& file) {
  const io::TomlTable top = io::read_toml(file);
  if (!top.is_table("robot")) throw io::InputError(file.string() + ": has no table [robot]; menger init writes a robot");
  Robot robot;
  io::read_described(top, robot);
  robot.file = file;
  if (robot.evolves && !robot.search) robot.search.emplace();
  if (robot.search && robot.drive == RobotDrive::hold)
    throw top.table("drive").error("mode", "cannot stand beside a search: nothing that holds its pressure walks");
  const io::TomlTable table = top.table("robot");
  check_body(robot, table);
  robot.silicone_file = materials::silicone_file(table, "silicone");
  robot.record = table.reading("silicone", [&] { return materials::read_silicone(robot.silicone_file); });
  robot.law = materials::law_in_record(table, robot.record, robot.law_name, robot.law_variant);
  if (robot.search && robot.search->model != RobotSearchModel::finite_elements &&
      robot.law_name != materials::recommended_law_name)
    throw table.error("law_name", "a search on voxels takes the recommended law: set search.model = \"finite_elements\"");
  check_drive(robot, top);
  robot.notes = notes_of(robot, top);
  return robot;
}

}  // namespace menger::meshes
