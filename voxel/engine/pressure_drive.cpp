#include "voxel/engine/pressure_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "voxel/engine/rest_lengths.h"
#include "voxel/model/elbows.h"
#include "voxel/model/law_extremes.h"
#include "voxel/model/wall_squares.h"

namespace menger::voxel {

template <class Real>
PressureDrive<Real>::PressureDrive(const Lattice& lattice, const HollowVoxels& voxels, const CalibratedBody& calibrated,
                                   const Actuation& actuation, const std::vector<double>& phases)
    : parameters_(calibrated.parameters), actuation_(actuation) {
  tables_.edge_m = parameters_.voxel_edge_m();
  for (std::size_t c = 0; c < law_class_count; ++c) {
    tables_.walls[c] = {parameters_.extension_of(c), parameters_.bulge_of(c), parameters_.bulge_peak_ratio_of(c)};
  }
  if (actuation.mode != ActuationMode::none) {
    tables_.wave = {.mean_Pa = 0.5 * (calibrated.pressure_Pa[0] + calibrated.pressure_Pa[1]),
                    .amplitude_Pa = 0.5 * (calibrated.pressure_Pa[1] - calibrated.pressure_Pa[0])};
  }
  std::map<double, std::size_t> index_of;
  phase_of_.resize(phases.size());
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const auto [entry, is_new] = index_of.try_emplace(phases[i], tables_.phases.size());
    const double angle = 2.0 * std::numbers::pi * phases[i];
    if (is_new) tables_.phases.push_back({std::cos(angle), std::sin(angle)});
    phase_of_[i] = entry->second;
  }
  responses_.resize(law_class_count * tables_.phases.size());
  const auto half_response = [&](std::int32_t voxel, std::size_t side) {
    const auto v = static_cast<std::size_t>(voxel);
    return law_class_count * phase_of_[v] + voxels.half_class[v][side];
  };
  const auto response = [&](std::size_t voxel, std::size_t axis) {
    return law_class_count * phase_of_[voxel] + voxels.size_class[voxel][axis];
  };
  const auto bulge_response = [&](std::size_t voxel, std::size_t axis) {
    return law_class_count * phase_of_[voxel] + voxels.bulge_class[voxel][axis];
  };
  openings_ = wall_openings(lattice, voxels, parameters_.voxels_per_cell);
  const auto add_necks = [&](std::size_t axis, std::size_t beam, std::int32_t voxel, std::size_t side) {
    const auto v = static_cast<std::size_t>(voxel);
    const WallOpening& opening = openings_[v][side];
    for (std::size_t c = 0; c < law_class_count && opening.lifts; ++c) {
      if (opening.lift[c] == 0.0) continue;
      tables_.necks_and_elbows[axis].push_back(
          {.beam = beam,
           .bulge = law_class_count * phase_of_[v] + c,
           .lift = parameters_.neck_ratio * opening.lift[c],
           .turn = {parameters_.neck_ratio * opening.turn[0][c], parameters_.neck_ratio * opening.turn[1][c]},
           .elbow = {0.0, 0.0}});
    }
  };
  const auto elbows = elbow_turns(lattice, voxels, parameters_.voxels_per_cell);
  const auto add_elbow = [&](std::size_t axis, std::size_t beam) {
    const auto& [about_u, about_v] = elbows[axis][beam];
    if (parameters_.elbow_ratio == 0.0 || (about_u == 0.0 && about_v == 0.0)) return;
    tables_.necks_and_elbows[axis].push_back({.beam = beam,
                                              .bulge = tables_.beam_responses[axis][beam][0],  // of a class that the body has
                                              .lift = 0.0,
                                              .turn = {0.0, 0.0},
                                              .elbow = {parameters_.elbow_ratio * about_u, parameters_.elbow_ratio * about_v}});
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      tables_.beam_responses[axis].push_back(
          {half_response(beams.lower[i], 2 * axis + 1), half_response(beams.upper[i], 2 * axis)});
      add_necks(axis, i, beams.lower[i], 2 * axis + 1);
      add_necks(axis, i, beams.upper[i], 2 * axis);
      add_elbow(axis, i);
    }
  }
  const auto most = std::ranges::max(tables_.beam_responses, {}, [](const auto& beams) { return beams.size(); }).size();
  lengths_m_.resize(most);
  rates_m_s_.resize(most);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    tables_.voxel_responses.push_back({response(i, 0), response(i, 1), response(i, 2)});
    tables_.bulge_responses.push_back({bulge_response(i, 0), bulge_response(i, 1), bulge_response(i, 2)});
    tables_.lengths_in_use.insert(tables_.voxel_responses.back().begin(), tables_.voxel_responses.back().end());
    tables_.bulges_in_use.insert(tables_.bulge_responses.back().begin(), tables_.bulge_responses.back().end());
    std::array<bool, 6>& bulging = bulging_.emplace_back();
    for (std::size_t side = 0; side < bulging.size(); ++side) bulging[side] = has_free_wall(lattice, voxels, i, side);
  }
  note_responses_in_use();
}

template <class Real>
void PressureDrive<Real>::note_responses_in_use() {
  std::set<std::size_t> in_use = tables_.lengths_in_use;
  in_use.insert(tables_.bulges_in_use.begin(), tables_.bulges_in_use.end());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const auto& of_halves : tables_.beam_responses[axis]) in_use.insert(of_halves.begin(), of_halves.end());
    for (const NeckOrElbow& entry : tables_.necks_and_elbows[axis]) in_use.insert(entry.bulge);
  }
  for (std::size_t i = 0; i < openings_.size(); ++i) {
    for (const WallOpening& opening : openings_[i]) {
      for (std::size_t c = 0; c < law_class_count; ++c)
        if (opening.lift[c] != 0.0) in_use.insert(law_class_count * phase_of_[i] + c);
    }
  }
  responses_in_use_.assign(in_use.begin(), in_use.end());
}

template <class Real>
void PressureDrive<Real>::set(double time_s, const StepData<Real>& d) {
  const DriveMoment moment = drive_moment(actuation_, time_s);
  for (const std::size_t r : responses_in_use_) {
    const auto [cosine, sine] = tables_.phases[r / law_class_count];
    responses_[r] = wall_response(tables_.edge_m, tables_.walls[r % law_class_count], tables_.wave.value(moment, cosine, sine),
                                  tables_.wave.rate(moment, cosine, sine));
  }
  largest_half_length_m_ = largest_foot_bulge_m_ = 0.0;
  for (const std::size_t length : tables_.lengths_in_use)
    largest_half_length_m_ = std::max(largest_half_length_m_, responses_[length].half_length_m);
  for (const std::size_t bulge : tables_.bulges_in_use)
    largest_foot_bulge_m_ = std::max(largest_foot_bulge_m_, responses_[bulge].bulge_peak_m);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < tables_.beam_responses[axis].size(); ++i) {
      const WallResponse& lower = responses_[tables_.beam_responses[axis][i][0]];
      const WallResponse& upper = responses_[tables_.beam_responses[axis][i][1]];
      lengths_m_[i] = lower.half_length_m + upper.half_length_m;
      rates_m_s_[i] = lower.half_length_rate_m_s + upper.half_length_rate_m_s;
    }
    if (d.axis[axis].half_kink != nullptr) set_kinks(axis, d.axis[axis]);
    for (const NeckOrElbow& entry : tables_.necks_and_elbows[axis]) {
      lengths_m_[entry.beam] += entry.lift * responses_[entry.bulge].bulge_peak_m;
      rates_m_s_[entry.beam] += entry.lift * responses_[entry.bulge].bulge_peak_rate_m_s;
    }
    for (std::size_t i = 0; i < tables_.beam_responses[axis].size(); ++i) {
      const auto length = static_cast<Real>(lengths_m_[i]);
      d.axis[axis].rest_length[i] = d.single_precision_rest_lengths ? rounded_to_single(length) : length;
      d.axis[axis].rest_length_rate[i] = static_cast<Real>(rates_m_s_[i]);
    }
  }
  for (std::size_t i = 0; i < tables_.voxel_responses.size(); ++i) {
    d.pose[line_size * i + slot::size] = static_cast<Real>(2.0 * responses_[tables_.voxel_responses[i][2]].half_length_m);
  }
}

/// Sets half the kinks of the beams along an axis, and their rates, from lengths that necks have not changed yet. Most beams have
/// none, and keep their zeros.
template <class Real>
void PressureDrive<Real>::set_kinks(std::size_t axis, const BeamAxisData<Real>& beams) const {
  const std::vector<NeckOrElbow>& entries = tables_.necks_and_elbows[axis];
  const double per_edge = 1.0 / tables_.edge_m;
  for (auto entry = entries.begin(); entry != entries.end();) {
    const std::size_t beam = entry->beam;
    const double strain = per_edge * lengths_m_[beam] - 1.0;
    const double strain_rate = per_edge * rates_m_s_[beam];
    double half_kink[4] = {};
    for (; entry != entries.end() && entry->beam == beam; ++entry)
      add_half_kink(half_kink, *entry, responses_[entry->bulge], per_edge, strain, strain_rate);
    for (std::size_t k = 0; k < 4; ++k) beams.half_kink[k * beams.count + beam] = static_cast<Real>(half_kink[k]);
  }
}

/// Returns how far the limb that leaves an open side is lifted, m.
template <class Real>
double PressureDrive<Real>::lift_m(std::size_t voxel, std::size_t side) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < law_class_count; ++c)
    sum += openings_[voxel][side].lift[c] * responses_[law_class_count * phase_of_[voxel] + c].bulge_peak_m;
  return parameters_.neck_ratio * sum;
}

template <class Real>
std::array<double, 6> PressureDrive<Real>::reach_m(std::size_t voxel) const {
  std::array<double, 6> reach{};
  for (std::size_t side = 0; side < reach.size(); ++side) {
    reach[side] = responses_[tables_.voxel_responses[voxel][side / 2]].half_length_m;
    if (bulging_[voxel][side]) reach[side] += responses_[tables_.bulge_responses[voxel][side / 2]].bulge_m;
    if (openings_[voxel][side].lifts) reach[side] += lift_m(voxel, side);
  }
  return reach;
}

template <class Real>
void PressureDrive<Real>::note_strains(const StepData<Real>& d) {
  Real smallest = Real(0);
  Real largest = Real(0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = d.axis[axis];
    for (std::size_t i = 0; i < tables_.beam_responses[axis].size(); ++i) {
      const Real strain = beams.history[i] / beams.rest_length[i];
      smallest = strain < smallest ? strain : smallest;
      largest = strain > largest ? strain : largest;
    }
  }
  strains_.smallest = std::min(strains_.smallest, static_cast<double>(smallest));
  strains_.largest = std::max(strains_.largest, static_cast<double>(largest));
}

double largest_collision_size_m(const HollowVoxels& voxels, const CalibratedBody& calibrated) {
  const SurrogateParameters& parameters = calibrated.parameters;
  ByLawClass<bool> in_use{};
  for (const auto& size_class : voxels.size_class) in_use.at(size_class[2]) = true;
  double largest = parameters.voxel_edge_m();
  for (std::size_t c = 0; c < law_class_count; ++c) {
    if (!in_use[c]) continue;
    // The drive may be ramped from zero pressure. A plate may be largest before it is drawn in.
    const auto [lowest_Pa, highest_Pa] = calibrated.pressure_Pa;
    for (const double pressure :
         extreme_pressures(parameters.extension_of(c), std::min(lowest_Pa, 0.0), std::max(highest_Pa, 0.0)))
      largest = std::max(largest, 2.0 * half_length_m(parameters, c, pressure));
  }
  return largest;
}

template class PressureDrive<double>;
template class PressureDrive<float>;

}  // namespace menger::voxel
