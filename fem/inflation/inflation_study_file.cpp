#include "fem/inflation/inflation_study_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "fem/inflation/inflation_study_words.h"
#include "io/text/content_hash.h"
#include "io/text/number_text.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr double largest_refinement_count = 6;  ///< eight to its power elements for each

/// An optional table: the keys of one that is missing have their defaults.
io::TomlTable table_or_empty(const io::TomlTable& table, std::string_view key) {
  if (const auto found = table.optional_table(key)) return *found;
  return io::parse_toml("", table.file());
}

Point read_position(const io::TomlTable& table, std::string_view key) {
  const std::vector<double> values = table.numbers(key);
  if (values.size() != 3) throw table.error(key, "must be three numbers, not " + std::to_string(values.size()));
  return {values[0], values[1], values[2]};
}

std::variant<DesignSource, MeshSource> read_source(const io::TomlTable& top) {
  const auto design = top.optional_table("design");
  const auto mesh = top.optional_table("mesh");
  if (design && mesh) throw top.error("mesh", "a table [design] beside it gives another body: keep one of them");
  if (design) {
    DesignSource source;
    source.file = design->path("file");
    source.options = meshes::read_hollow_body_options(*design);
    source.design = meshes::read_design(source.file);
    return source;
  }
  if (!mesh) throw io::InputError(top.file().string() + ": a table [design] or [mesh] is missing");
  MeshSource source;
  source.file = mesh->path("file");
  if (const fs::path extension = source.file.extension(); extension != ".msh" && extension != ".vtu")
    throw mesh->error("file", "must be a mesh file, .msh or .vtu");
  source.length_unit_m = mesh->number_or("length_unit_m", source.length_unit_m, io::positive());
  if (source.file.extension() == ".vtu" && mesh->has("length_unit_m"))
    throw mesh->error("length_unit_m", "a .vtu is in metres; the key is for .msh");
  return source;
}

StudySupports read_supports(const io::TomlTable& table) {
  StudySupports supports;
  supports.kind = table.word_or("kind", supports.kind, support_words());
  supports.ground_stiffness_Pa_per_m =
      table.number_or("ground_stiffness_Pa_per_m", supports.ground_stiffness_Pa_per_m, io::positive());
  for (const io::TomlTable& entry : table.optional_tables("labels")) {
    LabelSupport support{entry.text("label"), {}};
    const std::vector<std::string> held = entry.texts("held");
    for (std::size_t n = 0; n < held.size(); ++n) {
      const auto found = std::find(axis_words().begin(), axis_words().end(), held[n]);
      if (found == axis_words().end()) throw entry.error("held", "must be \"x\", \"y\" or \"z\"", std::array{n});
      support.held[static_cast<std::size_t>(found - axis_words().begin())] = true;
    }
    supports.labels.push_back(support);
  }
  return supports;
}

PlenumDrive read_drive(const io::TomlTable& table) {
  PlenumDrive drive;
  int given = 0;
  for (const DriveKind kind : {DriveKind::pressure, DriveKind::volume, DriveKind::gas}) {
    const std::string_view key = drive_key(kind);
    if (!table.has(key)) continue;
    if (++given > 1) throw table.error(key, "a plenum is driven in one way: keep one of these keys");
    drive.kind = kind;
    drive.values = table.numbers(key, kind == DriveKind::pressure ? io::any_number() : io::positive());
    if (drive.values.size() < 2) throw table.error(key, "needs at least two values: a start and an end");
    const double rest = kind == DriveKind::pressure ? 0.0 : 1.0;
    if (drive.values.front() != rest) {
      throw table.error(key, "must begin with " + io::number_text(rest) + ": a path begins at rest", std::array{std::size_t{0}});
    }
  }
  if (given == 0) throw table.error("pressure_Pa", "or volume_ratio or gas_amount must say how the plenum is driven");
  if (drive.kind == DriveKind::gas) {
    drive.gas_exponent = table.number_or("gas_exponent", drive.gas_exponent, io::positive());
    drive.ambient_pressure_Pa = table.number_or("ambient_pressure_Pa", drive.ambient_pressure_Pa, io::positive());
  }
  return drive;
}

std::map<std::string, PlenumDrive> read_drives(const io::TomlTable& table) {
  std::map<std::string, PlenumDrive> drives;
  const std::vector<io::TomlTable> plena = table.optional_tables("plenum");
  if (plena.empty()) return {{"", read_drive(table)}};
  for (const io::TomlTable& plenum : plena) {
    const std::string name = plenum.text("name");
    if (name.empty()) throw plenum.error("name", "must name a plenum");
    if (!drives.emplace(name, read_drive(plenum)).second) throw plenum.error("name", "this plenum is driven twice");
    const std::string_view key = drive_key(drives.at(name).kind);
    if (drives.at(name).values.size() != drives.begin()->second.values.size())
      throw plenum.error(key, "all plena need equally many values");
  }
  return drives;
}

/// The motion of a plate from the lists of its parts.
std::vector<PlateMotion> read_motions(const io::TomlTable& table, const StudyPlate& plate, std::size_t knot_count) {
  std::vector<PlateMotion> motions(knot_count);
  const auto read = [&](const std::string& key, bool may_move, const auto& part) {
    if (!table.has(key)) return;
    const std::vector<double> values = table.numbers(key);
    if (values.size() != knot_count)
      throw table.error(key, "must hold one value for each of the " + std::to_string(knot_count) + " knots of the path");
    if (values.front() != 0.0) throw table.error(key, "must begin with 0: the path starts at rest");
    if (!may_move) throw table.error(key, "a sliding plate moves along the normal of its side alone");
    for (std::size_t knot = 0; knot < knot_count; ++knot) part(motions[knot]) = values[knot];
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool may_shift = !plate.slides || meshes::axis_of(*plate.side) == axis;
    read(plate_displacement_key(axis), may_shift, [axis](PlateMotion& motion) -> double& { return motion.displacement_m[axis]; });
    read(plate_rotation_key(axis), !plate.slides, [axis](PlateMotion& motion) -> double& { return motion.rotation_rad[axis]; });
  }
  return motions;
}

std::vector<StudyPlate> read_plates(const io::TomlTable& top, std::size_t knot_count) {
  std::vector<StudyPlate> plates;
  for (const io::TomlTable& table : top.optional_tables("plates")) {
    StudyPlate plate;
    plate.name = table.text("name");
    const bool is_name = !plate.name.empty() && plate.name.find_first_of(",\"\n\r") == std::string::npos;
    if (!is_name) throw table.error("name", "must be a name without comma, quote or line break");
    const auto same = [&](const StudyPlate& other) { return other.name == plate.name; };
    if (std::any_of(plates.begin(), plates.end(), same)) throw table.error("name", "is given twice");
    if (table.has("side") == table.has("label")) throw table.error("name", "needs either side or label");
    if (table.has("side")) plate.side = table.word("side", meshes::side_words());
    if (table.has("label")) plate.label = table.text("label");
    plate.slides = table.word_or("grip", plate.slides, grip_words());
    if (plate.slides && !plate.side) throw table.error("grip", "only the faces of a side slide");
    plate.drive.values = read_motions(table, plate, knot_count);
    plates.push_back(std::move(plate));
  }
  return plates;
}

PathOptions read_path(const io::TomlTable& table, std::size_t knot_count) {
  PathOptions options;
  const io::Range part{.lowest = 0.0, .highest = 1.0, .lowest_excluded = true};
  options.largest_step = table.number_or("largest_step", options.largest_step, part);
  const io::Range step{.lowest = 0.0, .highest = options.largest_step, .lowest_excluded = true};
  options.first_step = table.number_or("first_step", std::min(options.first_step, options.largest_step), step);
  options.smallest_step = table.number_or("smallest_step", std::min(options.smallest_step, options.first_step),
                                          {.lowest = 0.0, .highest = options.first_step, .lowest_excluded = true});
  options.desired_iterations = table.integer_or("desired_iterations", options.desired_iterations, io::within(1, 100));
  options.predictor_order = table.integer_or("predictor_order", options.predictor_order, io::within(0, 2));
  if (table.has("stations")) options.stations = table.numbers("stations", io::within(0.0, static_cast<double>(knot_count - 1)));
  std::sort(options.stations.begin(), options.stations.end());
  options.touching_gap =
      table.number_or("touching_gap", options.touching_gap, {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
  return options;
}

EquilibriumOptions read_solver(const io::TomlTable& table) {
  EquilibriumOptions options;
  const io::Range tolerance{.lowest = 0.0, .highest = 1e-2, .lowest_excluded = true};
  options.linear.method = table.word_or("linear", options.linear.method, linear_words());
  options.linear.largest_direct_size =
      table.integer_or("largest_direct_size", options.linear.largest_direct_size, io::at_least(1));
  options.linear.relative_tolerance = table.number_or("linear_tolerance", options.linear.relative_tolerance, tolerance);
  options.relative_force_tolerance = table.number_or("force_tolerance", options.relative_force_tolerance, tolerance);
  options.relative_volume_tolerance = table.number_or("volume_tolerance", options.relative_volume_tolerance, tolerance);
  options.largest_iteration_count =
      table.integer_or("largest_iteration_count", options.largest_iteration_count, io::within(1, 1000));
  options.predict_pressure = table.boolean_or("predict_pressure", options.predict_pressure);
  return options;
}

StudyOutput read_output(const io::TomlTable& table) {
  StudyOutput output;
  output.fields = table.boolean_or("fields", output.fields);
  output.fields_every = table.integer_or("fields_every", output.fields_every, io::at_least(1));
  output.pictures = table.boolean_or("pictures", output.pictures);
  for (const io::TomlTable& entry : table.optional_tables("points")) {
    NamedPoint point{entry.text("name"), read_position(entry, "position_m")};
    const bool is_name = !point.name.empty() && point.name.find_first_of(",\"\n\r") == std::string::npos;
    if (!is_name) throw entry.error("name", "must be a name without comma, quote or line break");
    const auto same = [&](const NamedPoint& other) { return other.name == point.name; };
    if (std::any_of(output.points.begin(), output.points.end(), same)) throw entry.error("name", "is given twice");
    output.points.push_back(point);
  }
  return output;
}

void read_materials(const io::TomlTable& table, InflationStudy& study) {
  const auto read_input = [&](const fs::path& file) { study.inputs[file.string()] = io::file_hash(file); };
  study.material = read_study_material(table, read_input, study.notes);
  for (const io::TomlTable& entry : table.optional_tables("regions")) {
    const std::string region = entry.text("region");
    const StudyMaterial material = read_study_material(entry, read_input, study.notes);
    if (!study.region_materials.emplace(region, material).second) throw entry.error("region", "is given twice");
  }
}

void check_gravity(const io::TomlTable& loads, const io::TomlTable& supports, const InflationStudy& study) {
  if (study.supports.kind == SupportKind::resting && study.gravity_m_per_s2 == 0.0) {
    throw supports.error("kind", "a body rests on the ground by its weight: loads.gravity_m_per_s2 must be > 0");
  }
  if (study.gravity_m_per_s2 == 0.0) return;
  const auto weightless = [](const StudyMaterial& material) { return !material.density_kg_per_m3; };
  const bool any = weightless(study.material) || std::any_of(study.region_materials.begin(), study.region_materials.end(),
                                                             [&](const auto& entry) { return weightless(entry.second); });
  if (any) throw loads.error("gravity_m_per_s2", "needs material.density_kg_per_m3");
}

/// Whatever else holds or loads a body would pass forces into the three points.
void check_freedom(const io::TomlTable& supports, const InflationStudy& study) {
  if (study.supports.kind != SupportKind::free) return;
  if (!study.supports.labels.empty()) throw supports.error("kind", "nothing else may hold a free body: [[supports.labels]] does");
  if (!study.plates.empty()) throw supports.error("kind", "nothing else may hold a free body: [[plates]] does");
  if (study.gravity_m_per_s2 != 0.0)
    throw supports.error("kind", "nothing carries a free body's weight: loads.gravity_m_per_s2 must be 0");
}

}  // namespace

InflationStudy read_inflation_study(const fs::path& file) {
  const io::TomlTable top = io::read_toml(file);
  InflationStudy study;
  study.file = file;
  study.inputs[file.string()] = io::file_hash(file);
  study.source = read_source(top);
  const fs::path& body_file = std::visit([](const auto& source) -> const fs::path& { return source.file; }, study.source);
  study.inputs[body_file.string()] = io::file_hash(body_file);
  read_materials(top.table("material"), study);

  const io::TomlTable element = table_or_empty(top, "element");
  study.degree = element.integer_or("degree", study.degree, io::within(1, 2));
  study.formulation = element.word_or("formulation", study.formulation, formulation_words());
  study.refinements = element.integer_or("refinements", study.refinements, io::within(0, largest_refinement_count));
  const io::TomlTable supports = table_or_empty(top, "supports");
  study.supports = read_supports(supports);
  const io::TomlTable loads = table_or_empty(top, "loads");
  study.gravity_m_per_s2 = loads.number_or("gravity_m_per_s2", study.gravity_m_per_s2, io::non_negative());
  check_gravity(loads, supports, study);

  const io::TomlTable path = top.table("path");
  study.drives = read_drives(path);
  study.path = read_path(path, study.drives.begin()->second.values.size());
  study.plates = read_plates(top, study.drives.begin()->second.values.size());
  check_freedom(supports, study);
  study.solver = read_solver(table_or_empty(top, "solver"));
  study.output = read_output(table_or_empty(top, "output"));
  top.finish();
  return study;
}

}  // namespace menger::fem
