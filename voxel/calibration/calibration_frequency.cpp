#include "voxel/calibration/calibration_frequency.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "voxel/statics/vibration.h"

namespace menger::voxel {
namespace {

using meshes::Side;

HollowVoxels voxels_of(const SurrogateParameters& parameters, const meshes::LoadCase& body) {
  return hollow_voxels(meshes::Polycube::from_digits(body.cells[0], body.cells[1], body.cells[2], body.digits),
                       {.cell_edge_m = parameters.cell_edge_m,
                        .wall_thickness_m = parameters.wall_thickness_m,
                        .voxels_per_cell = parameters.voxels_per_cell,
                        .level = body.level,
                        .chambers = body.per_phase ? meshes::ChamberLayout::per_phase : meshes::ChamberLayout::single});
}

/// Motion of the middle of an end face relative to the centre of its voxel, m/Pa.
double face_slope(const SurrogateParameters& parameters, std::size_t size_class, std::size_t bulge_class, double pressure_Pa) {
  const double edge_m = parameters.voxel_edge_m();
  return 0.5 * edge_m * parameters.extension_of(size_class).derivative(pressure_Pa) +
         edge_m * parameters.bulge_peak_ratio_of(bulge_class) * parameters.bulge_of(bulge_class).derivative(pressure_Pa);
}

double magnitude_in(const io::CsvContents& table, std::size_t row, const std::string& column) {
  if (column.empty()) return std::abs(table.number(row, "gain_m_per_Pa"));
  return std::hypot(table.number(row, column + "_real_m_per_Pa"), table.number(row, column + "_imaginary_m_per_Pa"));
}

}  // namespace

std::vector<std::optional<double>> harmonic_gains(const SurrogateParameters& parameters, const meshes::LoadCase& body,
                                                  double pressure_Pa, BodyEnd end, std::span<const double> frequencies_Hz) {
  const Eigen::Index axis = end == BodyEnd::tip ? 0 : 2;
  const StaticBody statics(parameters, voxels_of(parameters, body), {end == BodyEnd::tip ? Side::x_min : Side::z_min});
  Equilibrium equilibrium(statics);
  StaticLoads loads;
  loads.pressures_Pa.assign(statics.voxels.chamber_count, pressure_Pa);
  std::vector<std::optional<double>> gains(frequencies_Hz.size());
  if (equilibrium.load(loads) != io::RunStatus::completed) return gains;
  const SmallMotion motion = small_motion(equilibrium);
  const std::vector<std::size_t> ends = statics.end_voxels(end == BodyEnd::tip ? Side::x_max : Side::z_max);
  for (std::size_t n = 0; n < frequencies_Hz.size(); ++n) {
    const double omega = 2.0 * std::numbers::pi * frequencies_Hz[n];
    Eigen::MatrixXd dynamic = motion.stiffness;
    dynamic.diagonal() -= omega * omega * motion.mass;
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(dynamic);
    constexpr double resonance = 1e-12;  // reciprocal condition number
    if (factors.rcond() < resonance) continue;
    const Eigen::VectorXd amplitude = factors.solve(motion.pressure_load);
    double gain = 0.0;
    for (const std::size_t voxel : ends) {
      const auto first = equilibrium.balance().first_unknown(voxel);
      const auto along = static_cast<std::size_t>(axis);
      gain += (first ? amplitude[*first + axis] : 0.0) + face_slope(parameters, statics.voxels.size_class[voxel][along],
                                                                    statics.voxels.bulge_class[voxel][along], pressure_Pa);
    }
    gains[n] = std::abs(gain) / static_cast<double>(ends.size());
  }
  return gains;
}

std::vector<FrequencyGain> read_frequency_gains(const FrequencyReference& reference) {
  const io::CsvContents table = io::read_csv(reference.file);
  std::vector<FrequencyGain> gains;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string first = reference.column.empty() ? "gain_m_per_Pa" : reference.column + "_real_m_per_Pa";
    if (!table.optional_number(row, first)) continue;  // at a resonance
    const double frequency_Hz = table.number(row, "frequency_Hz", io::non_negative());
    gains.push_back({frequency_Hz, magnitude_in(table, row, reference.column), std::nullopt});
  }
  return gains;
}

void compute_frequency_response(std::vector<FrequencyGain>& gains, const FrequencyReference& reference,
                                const SurrogateParameters& parameters) {
  std::vector<double> frequencies_Hz;
  frequencies_Hz.reserve(gains.size());
  for (const FrequencyGain& gain : gains) frequencies_Hz.push_back(gain.frequency_Hz);
  const auto responses = harmonic_gains(parameters, reference.body, reference.pressure_Pa, reference.end, frequencies_Hz);
  for (std::size_t n = 0; n < gains.size(); ++n) gains[n].surrogate_m_per_Pa = responses[n];
}

io::CsvTable frequency_table(const std::vector<FrequencyGain>& gains) {
  io::CsvTable table({"frequency_Hz", "reference_m_per_Pa", "surrogate_m_per_Pa", "relative_error"});
  for (const FrequencyGain& gain : gains) {
    std::optional<double> error;
    if (gain.surrogate_m_per_Pa && gain.reference_m_per_Pa > 0.0)
      error = *gain.surrogate_m_per_Pa / gain.reference_m_per_Pa - 1.0;
    table.add_row(gain.frequency_Hz, gain.reference_m_per_Pa, gain.surrogate_m_per_Pa, error);
  }
  return table;
}

}  // namespace menger::voxel
