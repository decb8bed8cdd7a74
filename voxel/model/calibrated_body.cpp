#include "voxel/model/calibrated_body.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "meshes/design/fractal.h"
#include "meshes/load_cases/load_case.h"
#include "voxel/model/covered_pressures.h"
#include "voxel/model/surrogate_file.h"

namespace menger::voxel {
namespace {

/// Returns the `level`-th root of a number of cells, or 0 if it is not an integer.
int root_of(int cells, int level) {
  const int root = static_cast<int>(std::lround(std::pow(cells, 1.0 / level)));
  long long power = 1;
  for (int i = 0; i < level; ++i) power *= root;
  return power == cells ? root : 0;
}

/// Returns which classes the voxels of a body have, of their half beams or of their bulges.
ByLawClass<bool> classes_of(const CalibratedBody& calibrated, const meshes::Polycube& basal_body) {
  CalibratedBody module = calibrated;  // all modules have the same walls
  module.level = 1;
  return law_classes_of(calibrated_voxels(basal_body, module));
}

/// Returns why voxels of a size class have no size somewhere in the drive, or an empty text.
std::string sizeless_class(const CalibratedBody& calibrated, std::size_t c) {
  const SurrogateParameters& parameters = calibrated.parameters;
  const auto text = [c](const char* what, double pressure) { return law_class_text(c) + what + io::number_text(pressure); };
  // Both ends are enough: zero pressure, from which the drive may be ramped, has a value in every law. Between them a law of
  // extension is monotone but where a plate stretches and is drawn in. There no length is lost but by the draw-in, which is
  // less than 1.
  for (const double pressure : calibrated.pressure_Pa) {
    const PressureLaw extension = parameters.extension_of(c);
    if (!extension.has_value(pressure) || !parameters.bulge_of(c).has_value(pressure))
      return text(" have no equilibrium at pressure_Pa = ", pressure);
    if (!(1.0 + extension.value(pressure) > 0.0)) return text(" have no positive rest length at pressure_Pa = ", pressure);
  }
  return "";
}

std::vector<std::string> faults_of(const CalibratedBody& calibrated, const BodyWalls& walls, int longest_body_cells) {
  const SurrogateParameters& parameters = calibrated.parameters;
  const CoveredPressures covered = covered_pressures(parameters.validity, walls);
  std::vector<std::string> faults;
  for (const double pressure : calibrated.pressure_Pa) {
    if (covered.contains(pressure)) continue;
    faults.push_back("pressure_Pa = " + io::number_text(pressure) + " is outside the range of the fit for such a body, " +
                     io::shown(covered.lowest_Pa) + " to " + io::shown(covered.highest_Pa) +
                     " Pa; beyond, the fit does not know " + (pressure < 0.0 ? covered.lowest_by : covered.highest_by));
  }
  if (calibrated.chambers != parameters.chambers) {
    faults.push_back("chambers = \"" + std::string(to_string(calibrated.chambers)) + "\", the bodies of the fit had \"" +
                     std::string(to_string(parameters.chambers)) + "\"");
  }
  if (longest_body_cells > parameters.validity.longest_body_cells) {
    faults.push_back("the body is " + std::to_string(longest_body_cells) + " cells long, the longest of the fit was " +
                     std::to_string(parameters.validity.longest_body_cells));
  }
  const int modules = meshes::longest_side_modules(longest_body_cells, calibrated.level);
  if (modules > parameters.validity.longest_aggregate_modules) {
    faults.push_back("the body is " + std::to_string(modules) + " modules long, the longest of the fit was " +
                     std::to_string(parameters.validity.longest_aggregate_modules));
  }
  return faults;
}

}  // namespace

std::string_view to_string(OutsideRange rule) { return rule == OutsideRange::refuse ? "refuse" : "warn"; }

meshes::Polycube basal_body_of(const meshes::Polycube& body, int level) {
  if (level == 1) return body;
  const auto fault = [&] { return std::invalid_argument("the body is no fractal of level " + std::to_string(level)); };
  const int nx = root_of(body.nx(), level);
  const int ny = root_of(body.ny(), level);
  const int nz = root_of(body.nz(), level);
  const std::vector<meshes::CellIndex> cells = body.occupied();
  if (nx == 0 || ny == 0 || nz == 0 || cells.empty()) throw fault();
  // Every module of the fractal is a copy of the basal body: take the one of the first cell.
  const meshes::CellIndex first{cells.front().x / nx * nx, cells.front().y / ny * ny, cells.front().z / nz * nz};
  meshes::Polycube basal(nx, ny, nz);
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) basal.set({x, y, z}, body.at({first.x + x, first.y + y, first.z + z}));
    }
  }
  if (!(meshes::fractal(basal, level) == body)) throw fault();
  return basal;
}

HollowVoxels calibrated_voxels(const meshes::Polycube& body, const CalibratedBody& calibrated) {
  const SurrogateParameters& parameters = calibrated.parameters;
  return hollow_voxels(basal_body_of(body, calibrated.level), {.cell_edge_m = parameters.cell_edge_m,
                                                               .wall_thickness_m = parameters.wall_thickness_m,
                                                               .voxels_per_cell = parameters.voxels_per_cell,
                                                               .level = calibrated.level,
                                                               .chambers = calibrated.chambers});
}

std::string unusable_parameters(const CalibratedBody& calibrated, double cell_edge_m, const meshes::Polycube* basal_body) {
  const SurrogateParameters& parameters = calibrated.parameters;
  // The edge in a design file may differ in its last digit.
  if (!(std::abs(parameters.cell_edge_m - cell_edge_m) <= 1e-9 * cell_edge_m)) {
    return "the parameters are calibrated for cell_edge_m = " + io::number_text(parameters.cell_edge_m) +
           ", the design has cell_edge_m = " + io::number_text(cell_edge_m);
  }
  if (basal_body != nullptr) return sizeless_walls(calibrated, *basal_body);
  const std::vector<std::string> faults = sizeless_walls(calibrated);
  return faults.size() == law_class_count ? faults.front() + ", and the same holds for all other classes" : "";
}

std::string sizeless_walls(const CalibratedBody& calibrated, const meshes::Polycube& basal_body) {
  const ByLawClass<bool> classes = classes_of(calibrated, basal_body);
  for (std::size_t c = 0; c < law_class_count; ++c) {
    if (!classes[c]) continue;
    if (std::string fault = sizeless_class(calibrated, c); !fault.empty()) return fault;
  }
  return "";
}

std::vector<std::string> sizeless_walls(const CalibratedBody& calibrated) {
  std::vector<std::string> faults;
  for (std::size_t c = 0; c < law_class_count; ++c) {
    if (std::string fault = sizeless_class(calibrated, c); !fault.empty()) faults.push_back(std::move(fault));
  }
  return faults;
}

std::vector<std::string> outside_validity(const CalibratedBody& calibrated, const meshes::Polycube& basal_body) {
  return faults_of(calibrated, body_walls(basal_body, calibrated.level, calibrated.chambers),
                   meshes::longest_side_cells({basal_body.nx(), basal_body.ny(), basal_body.nz()}, basal_body.digits()));
}

std::vector<std::string> outside_validity(const CalibratedBody& calibrated, int longest_body_cells) {
  const bool has_joints = calibrated.level > 1 || calibrated.chambers == meshes::ChamberLayout::per_phase;
  return faults_of(calibrated, all_walls(has_joints), longest_body_cells);
}

std::string unrealisable_phases(const HollowVoxels& voxels, const std::vector<double>& phases) {
  std::vector<std::optional<double>> of_chamber(voxels.chamber_count);
  const std::vector<meshes::CellIndex> cells = voxels.body.occupied();
  for (std::size_t i = 0; i < phases.size(); ++i) {
    std::optional<double>& phase = of_chamber.at(voxels.chamber[i]);
    if (!phase) phase = phases[i];
    if (*phase == phases[i]) continue;
    return "a chamber has one pressure, but the voxels of one chamber would need the phases " + io::number_text(*phase) +
           " and " + io::number_text(phases[i]) + " (voxel " + std::to_string(cells[i].x) + ", " + std::to_string(cells[i].y) +
           ", " + std::to_string(cells[i].z) + "): drive the body in phase or choose chambers = \"per-phase\"";
  }
  return "";
}

}  // namespace menger::voxel
