#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <vector>

#include "voxel/engine/wall_response.h"
#include "voxel/kernels/step_data.h"
#include "voxel/model/actuation.h"
#include "voxel/model/calibrated_body.h"
#include "voxel/model/strain_range.h"
#include "voxel/model/wall_feet.h"
#include "voxel/model/wall_openings.h"

namespace menger::voxel {

/// Sets the rest lengths of beams and the sizes of voxels of a calibrated body from the pressures of its chambers.
///
/// The size of a voxel is the one with which it meets other voxels. It is L (1 + extension) with the laws along z. It does not
/// include the bulge: with it, voxels that are joined across a corner would touch.
///
/// The laws are evaluated once per step for every phase and size class that the body has, not for every beam.
template <class Real>
class PressureDrive {
 public:
  /// @param phases of the voxels, in periods; equal within a chamber
  PressureDrive(const Lattice& lattice, const HollowVoxels& voxels, const CalibratedBody& calibrated, const Actuation& actuation,
                const std::vector<double>& phases);

  /// Sets rest lengths, their rates and sizes for a time.
  void set(double time_s, const StepData<Real>& d);

  /// Returns the distances from the centre of a voxel to its sides -x, +x, -y, +y, -z, +z, m, as they were last set. They are
  /// half its driven lengths. Walls behind which no voxel lies add their mean bulge, and open sides in a plate add the lift
  /// of their limb (WallOpening).
  [[nodiscard]] std::array<double, 6> reach_m(std::size_t voxel) const;

  /// Returns the half lengths of a voxel along x, y, z, m.
  [[nodiscard]] std::array<double, 3> half_lengths_m(std::size_t voxel) const {
    const std::array<std::size_t, 3>& of_axes = tables_.voxel_responses[voxel];
    return {responses_[of_axes[0]].half_length_m, responses_[of_axes[1]].half_length_m, responses_[of_axes[2]].half_length_m};
  }
  /// Returns the bulge of the walls of a voxel across an axis.
  [[nodiscard]] WallBulge wall_bulge(std::size_t voxel, std::size_t axis) const {
    const WallResponse& response = responses_[tables_.bulge_responses[voxel][axis]];
    return {.mean = response.bulge_m, .peak = response.bulge_peak_m};
  }
  /// Return the largest half length and the largest bulge of any voxel, m. The bulge is 0 at least.
  [[nodiscard]] double largest_half_length_m() const { return largest_half_length_m_; }
  [[nodiscard]] double largest_foot_bulge_m() const { return largest_foot_bulge_m_; }

  /// Widens the range of strains by the strains of all beams in the last step. Call it before the next set.
  void note_strains(const StepData<Real>& d);

  /// Widens the range of strains by that of steps that other code has made.
  void widen(const StrainRange& strains) {
    strains_.smallest = std::min(strains_.smallest, strains.smallest);
    strains_.largest = std::max(strains_.largest, strains.largest);
  }

  [[nodiscard]] const StrainRange& strains() const { return strains_; }

  /// What decides rest lengths and sizes, for code that computes them by itself. Responses are numbered by phase, then size
  /// class.
  struct Tables {
    double edge_m = 0.0;
    PressureWave wave;
    ByLawClass<WallLaws> walls;
    std::vector<std::array<double, 2>> phases;  ///< cos and sin of 2 pi phase, of the phases that occur
    std::array<std::vector<std::array<std::size_t, 2>>, 3> beam_responses;  ///< per axis and beam, of its two halves
    std::vector<std::array<std::size_t, 3>> voxel_responses;                ///< per voxel, of its size classes along x, y, z
    std::vector<std::array<std::size_t, 3>> bulge_responses;                ///< the same for its bulge classes
    std::array<std::vector<NeckOrElbow>, 3> necks_and_elbows;               ///< per axis, those of a beam one after the other
    std::set<std::size_t> lengths_in_use, bulges_in_use;
  };
  [[nodiscard]] const Tables& tables() const { return tables_; }

 private:
  void note_responses_in_use();
  [[nodiscard]] double lift_m(std::size_t voxel, std::size_t side) const;
  void set_kinks(std::size_t axis, const BeamAxisData<Real>& beams) const;

  SurrogateParameters parameters_;
  Tables tables_;
  Actuation actuation_;
  std::vector<WallResponse> responses_;               ///< values of the laws
  std::vector<std::size_t> responses_in_use_;         ///< the others are not evaluated
  std::vector<std::array<WallOpening, 6>> openings_;  ///< per voxel and side
  std::vector<std::size_t> phase_of_;                 ///< per voxel: index in tables_.phases
  std::vector<double> lengths_m_, rates_m_s_;         ///< of the beams of an axis, while they are set
  std::vector<std::array<bool, 6>> bulging_;          ///< per voxel: sides with a wall and no voxel behind it
  double largest_half_length_m_ = 0.0;
  double largest_foot_bulge_m_ = 0.0;
  StrainRange strains_;
};

/// Returns the largest size (m) with which any voxel of a calibrated body meets other voxels at any pressure of its drive, from
/// the start of a ramp on.
double largest_collision_size_m(const HollowVoxels& voxels, const CalibratedBody& calibrated);

}  // namespace menger::voxel
