#include "fem/inflation/inflation_study.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "fem/inflation/inflation_study_words.h"
#include "io/study/study_text.h"
#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::fem {
namespace {

constexpr double largest_refinement_count = 6;  ///< 8^n elements for each element of the mesh

// Entries of the maps of a study, which its file has as lists.
struct RegionMaterial {
  std::string region{};
  StudyMaterial material{};
};
struct NamedDrive {
  std::string plenum{};
  PlenumDrive drive{};
};

template <class Value>
std::size_t count_of(const std::vector<Value>& values, const std::string& name, std::string Value::*member) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [&](const Value& value) { return value.*member == name; }));
}

/// Describes a name that is valid in the head of a column, and gives a column that no other value has.
template <class Value>
void describe_name(io::StudyVisitor& visitor, const io::Key& key, Value& value, const std::vector<Value>& all) {
  visitor.text(key, value.name);
  visitor.check(!value.name.empty() && value.name.find_first_of(",\"\n\r") == std::string::npos, key.name,
                "must be a name without comma, quote or line break");
  for (const Value& other : all) {
    if (&other == &value || io::column_part(other.name) != io::column_part(value.name)) continue;
    const std::string columns = "names the same columns as \"" + other.name + "\"";
    visitor.check(false, key.name, other.name == value.name ? "is given twice" : columns);
  }
}

void describe_design_table(io::StudyVisitor& visitor, InflationStudy& study) {
  visitor.table({"design", "A body from a design: its cells are hollow."}, [&] {
    auto& source = std::get<DesignSource>(study.source);
    meshes::describe_design(visitor, source.design, source.file);
    describe(visitor, source.options, !study.has_thin_walls());
  });
}

void describe_mesh_table(io::StudyVisitor& visitor, InflationStudy& study) {
  visitor.table({"mesh", "A body from a mesh file."}, [&] {
    auto& mesh = std::get<MeshSource>(study.source);
    visitor.path({"file", "A mesh file of Gmsh (.msh) or of menger (.vtu).", "\"body.msh\""}, mesh.file);
    const bool is_vtu = mesh.file.extension() == ".vtu";
    visitor.check(is_vtu || mesh.file.extension() == ".msh", "file", "must be a mesh file, .msh or .vtu");
    visitor.only_if(!is_vtu, "a .msh file (a .vtu file is in metres)", [&] {
      visitor.number({"length_unit_m", "Unit of length of the .msh file."}, mesh.length_unit_m, io::positive());
    });
  });
}

void describe_source(io::StudyVisitor& visitor, InflationStudy& study) {
  const auto* design = std::get_if<DesignSource>(&study.source);
  const auto choose_design = [&] {
    if (!std::holds_alternative<DesignSource>(study.source)) study.source = DesignSource{};
  };
  const auto choose_mesh = [&] {
    if (!std::holds_alternative<MeshSource>(study.source)) study.source = MeshSource{};
  };
  visitor.one_of({{"design", design != nullptr && design->design.body.count() > 0, choose_design,
                   [&] { describe_design_table(visitor, study); }},
                  {"mesh", design == nullptr, choose_mesh, [&] { describe_mesh_table(visitor, study); }}},
                 "give the body as one of these tables");
}

void describe_materials(io::StudyVisitor& visitor, InflationStudy& study) {
  std::vector<RegionMaterial> regions;
  for (const auto& [region, material] : study.region_materials) regions.push_back({region, material});
  visitor.table({"material", "The material of the body."}, [&] {
    describe(visitor, study.material);
    visitor.tables({"regions", "Regions of the body that have another material."}, regions, [&](RegionMaterial& entry) {
      visitor.text({"region", "Name of the region.", "\"lid\""}, entry.region);
      visitor.check(count_of(regions, entry.region, &RegionMaterial::region) == 1, "region", "is given twice");
      describe(visitor, entry.material);
    });
  });
  study.region_materials.clear();
  for (const RegionMaterial& entry : regions) study.region_materials[entry.region] = entry.material;
}

void describe_elements(io::StudyVisitor& visitor, InflationStudy& study) {
  visitor.table({"elements", "The finite elements."}, [&] {
    describe(visitor, study.elements, false);
    visitor.only_if(!study.has_thin_walls(), "kind = \"three_field\"", [&] {
      visitor.integer(
          {.name = "degree", .help = "Degree of the displacements: 1 is Q1/P0, 2 is Q2/P1.", .earlier = "/element.degree"},
          study.degree, io::within(1, 2));
      visitor.word({.name = "formulation",
                    .help = "three_field: pressure and dilatation are separate fields; displacement: they are not.",
                    .earlier = "/element.formulation"},
                   study.formulation, formulation_words());
      visitor.integer(
          {.name = "refinements", .help = "How many times every element is split into eight.", .earlier = "/element.refinements"},
          study.refinements, io::within(0, largest_refinement_count));
    });
  });
}

void describe(io::StudyVisitor& visitor, LabelSupport& support) {
  visitor.text({"label", "Label of the faces.", "\"outer\""}, support.label);
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (support.held[axis]) axes.push_back(axis);
  }
  visitor.words({"held", "Directions in which these faces do not move.", "[\"z\"]"}, axes, axis_words());
  support.held = {};
  for (const std::size_t axis : axes) support.held[axis] = true;
}

void describe_supports(io::StudyVisitor& visitor, InflationStudy& study) {
  StudySupports& supports = study.supports;
  visitor.table({"supports", "How the body is held."}, [&] {
    visitor.word({"kind",
                  "ground_guided: slides on the ground; ground_held: held on the ground; resting: rests on the ground by its "
                  "weight; free: only its rigid motions are held; labels: held by labels only. What slides or rests is held "
                  "against drifting at the node nearest to its vertical axis, from which all else moves away."},
                 supports.kind, support_words());
    visitor.only_if(supports.kind == SupportKind::resting, "kind = \"resting\"", [&] {
      visitor.number({"ground_stiffness_Pa_per_m", "Pressure of the ground divided by depth."},
                     supports.ground_stiffness_Pa_per_m, io::positive());
    });
    visitor.tables({"labels", "Faces that are held in addition."}, supports.labels,
                   [&](LabelSupport& support) { describe(visitor, support); });
  });
  visitor.table({"loads", "Loads on the body in addition to its path."}, [&] {
    visitor.number({"gravity_m_per_s2", "Acceleration of gravity, downwards."}, study.gravity_m_per_s2, io::non_negative());
  });
}

void describe_drive(io::StudyVisitor& visitor, PlenumDrive& drive) {
  const bool is_pressure = drive.kind == DriveKind::pressure;
  const std::string_view key = drive_key(drive.kind);
  constexpr std::array<std::string_view, 3> helps{
      "Gauge pressure at the knots of the path. It begins with 0.",
      "Volume of the air at the knots of the path, divided by its volume at rest. It begins with 1.",
      "Amount of gas at the knots of the path, divided by its amount at rest. It begins with 1."};
  visitor.numbers({key, helps.at(static_cast<std::size_t>(drive.kind)), is_pressure ? "[0, 2000]" : "[1, 1.05]"}, drive.values,
                  is_pressure ? io::any_number() : io::positive(), {.fewest = 2});
  const double rest = is_pressure ? 0.0 : 1.0;
  visitor.check(!drive.values.empty() && drive.values.front() == rest, key,
                "must begin with " + io::number_text(rest) + ": a path begins at rest", {0});
  if (drive.kind != DriveKind::gas) return;
  visitor.number({"gas_exponent", "Exponent n of the gas law p V^n: 1 is isothermal, 1.4 is adiabatic air."}, drive.gas_exponent,
                 io::positive());
  visitor.number({"ambient_pressure_Pa", "Absolute pressure of the surroundings."}, drive.ambient_pressure_Pa, io::positive());
}

/// Returns the alternatives for driving plena.
/// @param choose called with each choice
std::vector<io::Alternative> drive_alternatives(io::StudyVisitor& visitor, PlenumDrive& drive,
                                                const std::function<void()>& choose) {
  std::vector<io::Alternative> alternatives;
  for (const DriveKind kind : {DriveKind::pressure, DriveKind::volume, DriveKind::gas}) {
    const auto choose_kind = [&drive, choose, kind] {
      if (drive.kind != kind) drive = {.kind = kind, .values = {}};
      choose();
    };
    alternatives.push_back({drive_key(kind), drive.kind == kind && !drive.values.empty(), choose_kind,
                            [&visitor, &drive] { describe_drive(visitor, drive); }});
  }
  return alternatives;
}

constexpr std::string_view drive_missing = "give one of them to drive the plenum";

void describe_plena(io::StudyVisitor& visitor, std::vector<NamedDrive>& plena) {
  const auto describe_plenum = [&](NamedDrive& entry) {
    visitor.text({"name", "Name of the plenum.", "\"plenum 0\""}, entry.plenum);
    visitor.check(!entry.plenum.empty(), "name", "must name a plenum");
    visitor.check(count_of(plena, entry.plenum, &NamedDrive::plenum) == 1, "name",
                  "this plenum has two drives: keep one of them");
    visitor.one_of(drive_alternatives(visitor, entry.drive, [] {}), drive_missing);
    visitor.check(entry.drive.values.size() == plena.front().drive.values.size(), drive_key(entry.drive.kind),
                  "all plena must have the same number of values");
  };
  visitor.tables({"plenum", "How each plenum is driven."}, plena, describe_plenum, {.fewest = 1});
}

void describe_drives(io::StudyVisitor& visitor, InflationStudy& study) {
  PlenumDrive of_all;
  std::vector<NamedDrive> plena;
  for (const auto& [name, drive] : study.drives) {
    if (name.empty())
      of_all = drive;
    else
      plena.push_back({name, drive});
  }
  std::vector<io::Alternative> alternatives = drive_alternatives(visitor, of_all, [&] { plena.clear(); });
  alternatives.push_back({"plenum", !plena.empty(), [&] { of_all = {}; }, [&] { describe_plena(visitor, plena); }});
  visitor.one_of(alternatives, drive_missing);
  study.drives.clear();
  if (!of_all.values.empty()) study.drives[""] = of_all;
  for (const NamedDrive& entry : plena) study.drives[entry.plenum] = entry.drive;
}

/// Returns the number of knots of the path.
std::size_t knot_count(const InflationStudy& study) {
  return study.drives.empty() ? 2 : study.drives.begin()->second.values.size();
}

void describe_steps(io::StudyVisitor& visitor, PathOptions& path, std::size_t knots) {
  const auto up_to = [](double most) { return io::Range{.lowest = 0.0, .highest = most, .lowest_excluded = true}; };
  visitor.number({"largest_step", "Largest step, as a fraction of the path between two knots."}, path.largest_step, up_to(1.0));
  path.first_step = std::min(path.first_step, path.largest_step);
  visitor.number({"first_step", "First step of the path, as a fraction of the way between two knots."}, path.first_step,
                 up_to(path.largest_step));
  path.smallest_step = std::min(path.smallest_step, path.first_step);
  visitor.number({"smallest_step", "Smallest step. If even this step fails, the path ends."}, path.smallest_step,
                 up_to(path.first_step));
  visitor.integer(
      {"desired_iterations", "Steps grow if they take fewer Newton iterations than this, and shrink if they take more."},
      path.desired_iterations, io::within(1, 100));
  visitor.integer({"predictor_order", "Start of a step: 0 is the last state, 1 a secant, 2 a parabola."}, path.predictor_order,
                  io::within(0, 2));
  visitor.numbers({"stations", "Values of the path parameter that the path meets exactly, in addition to the knots at 0, 1, ..."},
                  path.stations, io::within(0.0, static_cast<double>(knots - 1)));
  std::sort(path.stations.begin(), path.stations.end());
  visitor.number(
      {"touching_gap", "Walls touch where their gap is this fraction of the chamber's size. 0: no search for contact."},
      path.touching_gap, {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
}

/// Describes one component of the motion of a plate at the knots.
/// @param part selects the component
template <class Part>
void describe_motion(io::StudyVisitor& visitor, const io::Key& key, bool may_move, std::vector<PlateMotion>& motions,
                     const Part& part) {
  std::vector<double> values;
  values.reserve(motions.size());
  for (PlateMotion& motion : motions) values.push_back(part(motion));
  const std::string count = std::to_string(motions.size());
  visitor.only_if(may_move, "grip = \"bonded\" (a sliding plate moves only along the normal of its side)", [&] {
    visitor.numbers(key, values);
    visitor.check(values.size() == motions.size(), key.name,
                  "must hold one value for each of the " + count + " knots of the path");
    visitor.check(values.empty() || values.front() == 0.0, key.name, "must begin with 0: the path starts at rest");
  });
  if (values.size() != motions.size()) return;
  for (std::size_t knot = 0; knot < motions.size(); ++knot) part(motions[knot]) = values[knot];
}

void describe_motions(io::StudyVisitor& visitor, StudyPlate& plate, std::size_t knots) {
  constexpr std::array<std::string_view, 3> displacements{"displacement_x_m", "displacement_y_m", "displacement_z_m"};
  constexpr std::array<std::string_view, 3> rotations{"rotation_x_rad", "rotation_y_rad", "rotation_z_rad"};
  std::vector<PlateMotion>& motions = plate.drive.values;
  motions.resize(knots);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool may_shift = !plate.slides || (plate.side && meshes::axis_of(*plate.side) == axis);
    describe_motion(visitor, {displacements.at(axis), "Displacement at the knots of the path."}, may_shift, motions,
                    [axis](PlateMotion& motion) -> double& { return motion.displacement_m[axis]; });
    describe_motion(
        visitor,
        {rotations.at(axis), "Component of the rotation vector about the middle of the plate's faces, at the knots of the path."},
        !plate.slides, motions, [axis](PlateMotion& motion) -> double& { return motion.rotation_rad[axis]; });
  }
}

void describe_plate(io::StudyVisitor& visitor, StudyPlate& plate, std::size_t knots) {
  const auto describe_side = [&] {
    meshes::Side side = plate.side.value_or(meshes::Side::x_max);
    visitor.word({"side", "Side of the body's bounding box. The plate holds the faces on it.", "\"x max\""}, side,
                 meshes::side_words());
    plate.side = side;
  };
  const auto choose_label = [&] { plate.side.reset(); };
  visitor.one_of({{"side", plate.side.has_value(), [&] { plate.label.clear(); }, describe_side},
                  {"label", !plate.side && !plate.label.empty(), choose_label,
                   [&] {
                     visitor.text({"label", "Label of the faces that the plate holds.", "\"ground\""}, plate.label);
                   }}},
                 "give the faces that the plate holds");
  visitor.word(
      {"grip",
       "bonded: the faces are bonded to the plate; sliding: they slide on it, and it moves only along the normal of its side."},
      plate.slides, grip_words());
  visitor.check(!plate.slides || plate.side, "grip", "only the faces of a side can slide: give a side");
  describe_motions(visitor, plate, knots);
}

void describe_end(io::StudyVisitor& visitor, PathOptions& path) {
  bool ends_at_limit_point = static_cast<bool>(path.ends_at);
  visitor.boolean(
      {"end_at_limit_point",
       "Whether the path ends, completed, at a limit point: the largest pressure that the chambers bear. A path of volumes or of "
       "gas passes it; one of pressures comes as near as it can."},
      ends_at_limit_point);
  path.ends_at = {};
  if (ends_at_limit_point)
    path.ends_at = [](const PathPoint&, const std::vector<LimitPoint>& limit_points) { return !limit_points.empty(); };
}

void describe_path(io::StudyVisitor& visitor, InflationStudy& study) {
  visitor.table({"path", "The path of equilibria, which goes through knots."}, [&] {
    describe_drives(visitor, study);
    describe_steps(visitor, study.path, knot_count(study));
    describe_end(visitor, study.path);
  });
  visitor.tables({"plates", "Rigid plates on faces of the body. Supports do not act on what a plate holds."}, study.plates,
                 [&](StudyPlate& plate) {
                   describe_name(visitor, {"name", "Name of the plate, in columns of results.", "\"tip\""}, plate, study.plates);
                   describe_plate(visitor, plate, knot_count(study));
                 });
}

void describe_solver(io::StudyVisitor& visitor, InflationStudy& study) {
  EquilibriumOptions& solver = study.solver;
  const io::Range tolerance{.lowest = 0.0, .highest = 1e-2, .lowest_excluded = true};
  visitor.table({"solver", "How each equilibrium is found."}, [&] {
    visitor.word(
        {"linear", "Linear solver. automatic: direct up to largest_direct_size unknowns; above, the cheaper one by an estimate."},
        solver.linear.method, linear_words());
    visitor.integer({"largest_direct_size", "Number of unknowns up to which automatic means direct without an estimate."},
                    solver.linear.largest_direct_size, io::at_least(1));
    visitor.number({"linear_tolerance", "Relative residual of the iterative linear solver."}, solver.linear.relative_tolerance,
                   tolerance);
    visitor.number({"force_tolerance", "Largest residual force divided by the force of the loads."},
                   solver.relative_force_tolerance, tolerance);
    visitor.number({"volume_tolerance", "Largest relative error of a volume that drives a plenum."},
                   solver.relative_volume_tolerance, tolerance);
    visitor.integer({"largest_iteration_count", "Largest number of Newton iterations of a step."}, solver.largest_iteration_count,
                    io::within(1, 1000));
    visitor.only_if(!study.has_thin_walls(), "elements.kind = \"three_field\"", [&] {
      visitor.boolean({"predict_pressure", "true: Newton's method in the three fields; false: in the displacements only."},
                      solver.predict_pressure);
    });
  });
}

void check_gravity(const io::StudyVisitor& visitor, const InflationStudy& study) {
  const bool is_weightless = study.gravity_m_per_s2 == 0.0;
  visitor.check(study.supports.kind != SupportKind::resting || !is_weightless, "supports.kind",
                "the weight holds the body on the ground: loads.gravity_m_per_s2 must be > 0");
  const auto has_density = [](const auto& entry) { return entry.second.density_kg_per_m3.has_value(); };
  const bool has_densities =
      study.material.density_kg_per_m3 && std::all_of(study.region_materials.begin(), study.region_materials.end(), has_density);
  visitor.check(is_weightless || has_densities, "loads.gravity_m_per_s2", "needs material.density_kg_per_m3");
}

/// Checks that nothing else holds or loads a free body: the forces would pass into its three held points.
void check_freedom(const io::StudyVisitor& visitor, const InflationStudy& study) {
  if (study.supports.kind != SupportKind::free) return;
  visitor.check(study.supports.labels.empty(), "supports.kind", "nothing else may hold a free body: remove [[supports.labels]]");
  visitor.check(study.plates.empty(), "supports.kind", "nothing else may hold a free body: remove [[plates]]");
  visitor.check(study.gravity_m_per_s2 == 0.0, "supports.kind",
                "nothing carries a free body's weight: loads.gravity_m_per_s2 must be 0");
}

/// Describes everything that the path depends on.
void describe_states(io::StudyVisitor& visitor, InflationStudy& study) {
  describe_elements(visitor, study);
  describe_source(visitor, study);
  visitor.check(!study.has_thin_walls() || std::holds_alternative<DesignSource>(study.source), "elements.kind",
                "the walls of a mesh file are not known: give a design");
  describe_materials(visitor, study);
  describe_supports(visitor, study);
  describe_path(visitor, study);
  describe_solver(visitor, study);
  check_gravity(visitor, study);
  check_freedom(visitor, study);
}

void describe_output(io::StudyVisitor& visitor, StudyOutput& output) {
  visitor.table({"output", "What is written."}, [&] {
    visitor.boolean({"fields", "Whether displacements and stresses are written, for ParaView."}, output.fields);
    visitor.integer({"fields_every", "Number of states of the path per state that is written. The last state is always written."},
                    output.fields_every, io::at_least(1));
    visitor.boolean({"pictures", "Whether pictures are drawn."}, output.pictures);
    visitor.tables(
        {"points",
         "Points whose displacement and stretch are recorded, beside the middles of the top (top centre) and of the "
         "side at the largest x (side centre)."},
        output.points, [&](NamedPoint& point) {
          describe_name(visitor, {"name", "Name of the point, in columns of results.", "\"foot\""}, point, output.points);
          visitor.numbers({"position_m", "Position of the point at rest.", "[0, 0, 0]"}, point.position);
        });
  });
}

}  // namespace

void describe(io::StudyVisitor& visitor, InflationStudy& study) {
  describe_states(visitor, study);
  describe_output(visitor, study.output);
}

std::string path_text(const InflationStudy& study) {
  InflationStudy identified = study;
  if (auto* mesh = std::get_if<MeshSource>(&identified.source)) {
    // a mesh is identified by its content, not by its place
    mesh->file = study.inputs.at(mesh->file.string()) + mesh->file.extension().string();
  }
  io::StudyTextWriter writer;
  describe_states(writer, identified);
  return writer.text() + (study.has_thin_walls() ? text_of(constants_of_equilibria) + "\n" : "");
}

std::string resolved_text(const InflationStudy& study) { return io::described_text(study); }

}  // namespace menger::fem
