// A solid with a Poisson's ratio near one half: the surrogate compared with finite elements.

#include <cmath>
#include <string>

#include "tests/extremes/solid_bar.h"
#include "tests/extremes/voxel_rows.h"
#include "voxel/statics/body_shape.h"
#include "voxel/statics/equilibrium.h"
#include "voxel/statics/load_case_response.h"

namespace menger::extremes {

namespace {

constexpr int bar_cells = 3;

/// Returns parameters of beams of which many side by side form the isotropic solid: E = lambda + 2 mu along them, and lambda = c
/// E. The modulus of bending is 2 mu, because a lattice of beams whose nodes rotate freely has half of it as shear modulus.
voxel::SurrogateParameters solid_parameters(double poissons_ratio, int voxels_across) {
  const double coupling = coupling_of(poissons_ratio);
  const double beam_Pa = modulus_Pa / wide_bar_stiffness(coupling);
  voxel::SurrogateParameters parameters;
  parameters.cell_edge_m = edge_m;
  parameters.wall_thickness_m = 0.2 * edge_m;
  parameters.voxels_per_cell = voxels_across;
  parameters.density_kg_m3 = 1000.0;
  parameters.axial_Pa.fill(beam_Pa);
  parameters.bending_Pa.fill((1.0 - coupling) * beam_Pa);
  parameters.torsion_Pa.fill((1.0 - coupling) * beam_Pa);
  parameters.lateral_coupling = coupling;
  parameters.ground_stiffness_N_per_m = stiffness_N_per_m;
  return parameters;
}

/// Returns the mean width of the middle section across y, m.
double middle_width_m(const voxel::Equilibrium& equilibrium, int n) {
  const voxel::BodyShape shape(equilibrium);
  const int length = n * bar_cells;
  double sum_m = 0.0;
  for (int x = length / 2 - 1; x <= length / 2; ++x) {
    for (int z = 0; z < n; ++z) {
      const auto voxel = [&](int y) {
        const int index = x + length * (y + n * z);
        return static_cast<std::size_t>(index);
      };
      sum_m += shape.face(voxel(n - 1), meshes::Side::y_max).y - shape.face(voxel(0), meshes::Side::y_min).y;
    }
  }
  return sum_m / (2 * n);
}

/// Computes the bar with the surrogate. The number of voxels across is even.
SolidBar surrogate_bar(Outcome& outcome, double poissons_ratio, int voxels_across) {
  const double pull_m = solid_bar_strain * bar_cells * edge_m;
  const meshes::LoadCase load_case{.name = "bar",
                                   .kind = meshes::LoadCaseKind::stretch,
                                   .cells = {bar_cells, 1, 1},
                                   .digits = std::string(bar_cells, '1'),
                                   .cell_edge_m = edge_m,
                                   .wall_thickness_m = 0.2 * edge_m,
                                   .pressures_Pa = {0.0},
                                   .imposed = {pull_m}};
  SolidBar found{poissons_ratio, std::nan(""), std::nan("")};
  double force_N = std::nan("");
  const voxel::LoadCaseResponse response = voxel::visit_states(
      solid_parameters(poissons_ratio, voxels_across), load_case, {}, [&](std::size_t, const voxel::Equilibrium& equilibrium) {
        force_N = equilibrium.plate_load(1).force.x;
        found.contraction = (1.0 - middle_width_m(equilibrium, voxels_across) / edge_m) / solid_bar_strain;
      });
  if (response.status != io::RunStatus::completed) outcome.expect_status(response.status, io::RunStatus::completed);
  found.stiffness = force_N / (modulus_Pa * edge_m * edge_m * solid_bar_strain);
  return found;
}

/// The expected difference between the surrogate and finite elements.
struct Disagreement {
  std::size_t bar;            ///< index in solid_bars
  double least, most;         ///< stiffness of the bar of 8 voxels across, divided by that of finite elements
  double wide_stiffness_off;  ///< relative, of the wide bar
  double wide_contraction_off;
};

void run_bar(Outcome& outcome, const Disagreement& stated) {
  const SolidBar& exact = solid_bars[stated.bar];
  const auto narrow = surrogate_bar(outcome, exact.poissons_ratio, 2);
  const auto middle = surrogate_bar(outcome, exact.poissons_ratio, 4);
  const auto wide = surrogate_bar(outcome, exact.poissons_ratio, 8);
  outcome.note("2, 4, 8 voxels across: stiffness " + shown(narrow.stiffness / exact.stiffness, 3) + ", " +
               shown(middle.stiffness / exact.stiffness, 3) + ", " + shown(wide.stiffness / exact.stiffness, 3) +
               " and contraction " + shown(narrow.contraction / exact.contraction, 3) + ", " +
               shown(middle.contraction / exact.contraction, 3) + ", " + shown(wide.contraction / exact.contraction, 3) +
               " times those of finite elements");
  outcome.expect_between("stiffness of 8 across by that of finite elements", wide.stiffness / exact.stiffness, stated.least,
                         stated.most);
  outcome.expect_near("stiffness of a wide bar", extrapolated(narrow.stiffness, middle.stiffness, wide.stiffness),
                      exact.stiffness, stated.wide_stiffness_off);
  outcome.expect_near("contraction of a wide bar", extrapolated(narrow.contraction, middle.contraction, wide.contraction),
                      exact.contraction, stated.wide_contraction_off);
}

}  // namespace

std::vector<Row> voxel_solid_bar_rows() {
  std::vector<Row> rows;
  for (const Disagreement& stated : {Disagreement{0, 1.02, 1.06, 0.005, 0.01}, Disagreement{1, 1.15, 1.25, 0.01, 0.01},
                                     Disagreement{2, 1.7, 1.9, 0.15, 0.15}}) {
    const SolidBar& exact = solid_bars[stated.bar];
    rows.push_back(
        {.name = "solid bar of nu " + shown(exact.poissons_ratio) + " against finite elements",
         .done =
             "equilibria of bars of 2 x 2 x 6, 4 x 4 x 12 and 8 x 8 x 24 voxels between bonded plates, beams of the modulus " +
             shown(1.0 / wide_bar_stiffness(coupling_of(exact.poissons_ratio)), 3) + " E",
         .expected = "too stiff by the beams on the surface, which have half the neighbours: 8 across " +
                     shown(100.0 * stated.least - 100.0) + " to " + shown(100.0 * stated.most - 100.0) +
                     " %; after taking out errors in 1/width and its square the force of finite elements, " +
                     shown(exact.stiffness) + " E A strain, to " + shown(100.0 * stated.wide_stiffness_off) +
                     " %, and their contraction, " + shown(exact.contraction) + ", to " +
                     shown(100.0 * stated.wide_contraction_off) + " %",
         .run = [stated](Outcome& outcome) { run_bar(outcome, stated); }});
  }
  return rows;
}

}  // namespace menger::extremes
