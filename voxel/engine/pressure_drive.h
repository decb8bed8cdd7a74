#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <vector>

#include "voxel/kernels/step_data.h"
#include "voxel/model/actuation.h"
#include "voxel/model/calibrated_body.h"
#include "voxel/model/strain_range.h"
#include "voxel/model/wall_feet.h"

namespace menger::voxel {

/// Puts the pressures of the chambers into the rest lengths of beams and the sizes of voxels of a calibrated body.
///
/// The size of a voxel, by which it meets others, is L (1 + extension) with the laws along z: without the bulge, which would make
/// voxels touch that are joined across a corner.
///
/// The laws are evaluated once per step for every phase and wall class that occur, not for every beam.
template <class Real>
class PressureDrive {
 public:
  /// @param phases of the voxels, in periods; equal within a chamber
  PressureDrive(const Lattice& lattice, const HollowVoxels& voxels, const CalibratedBody& calibrated, const Actuation& actuation,
                const std::vector<double>& phases);

  /// Sets rest lengths, their rates and sizes for a time.
  void set(double time_s, const StepData<Real>& d);

  /// From the centre of a voxel to its sides -x, +x, -y, +y, -z, +z, m, as they were last set: half its driven lengths, plus the
  /// mean bulge of walls behind which no voxel lies, or what a neck rides on.
  [[nodiscard]] std::array<double, 6> reach_m(std::size_t voxel) const;

  /// Of a voxel along x, y, z, m.
  [[nodiscard]] std::array<double, 3> half_lengths_m(std::size_t voxel) const {
    const std::array<std::size_t, 3>& answers = voxel_answers_[voxel];
    return {answers_[answers[0]].half_length_m, answers_[answers[1]].half_length_m, answers_[answers[2]].half_length_m};
  }
  /// Of its walls across an axis.
  [[nodiscard]] WallBulge wall_bulge(std::size_t voxel, std::size_t axis) const {
    const Answer& answer = answers_[bulge_answers_[voxel][axis]];
    return {.mean = answer.bulge_m, .peak = answer.bulge_peak_m};
  }
  /// The largest of any voxel, m; of bulges 0 at least.
  [[nodiscard]] double largest_half_length_m() const { return largest_half_length_m_; }
  [[nodiscard]] double largest_foot_bulge_m() const { return largest_foot_bulge_m_; }

  /// Widens the range of strains by the beams as they were in the last step; to be called before the next set.
  void note_strains(const StepData<Real>& d);

  [[nodiscard]] const StrainRange& strains() const { return strains_; }

 private:
  /// What the laws give for a phase and a wall class.
  struct Answer {
    double half_length_m, half_length_rate_m_s, bulge_peak_m, bulge_m, bulge_rate_m_s;
  };
  /// A half beam that leaves a plate, see wall_openings.
  struct Neck {
    std::size_t beam, bulge;  ///< its answer
    double share;
  };

  SurrogateParameters parameters_;
  double mean_Pa_, amplitude_Pa_;
  Actuation actuation_;
  std::vector<std::array<double, 2>> phases_;                            ///< cos and sin of 2 pi phase, of the phases that occur
  std::vector<Answer> answers_;                                          ///< by phase, then wall class
  std::array<std::vector<std::array<std::size_t, 2>>, 3> beam_answers_;  ///< per axis and beam: of its two halves
  std::vector<std::array<std::size_t, 3>> voxel_answers_;                ///< per voxel: of its wall classes along x, y, z
  std::vector<std::array<std::size_t, 3>> bulge_answers_;                ///< the same of its bulge classes
  std::vector<std::array<double, 6>> openings_;                          ///< per voxel and side
  std::array<std::vector<Neck>, 3> necks_;                               ///< per axis
  std::vector<double> lengths_m_, rates_m_s_;                            ///< of the beams of an axis, while they are set
  std::vector<std::array<bool, 6>> bulging_;                             ///< per voxel: sides with a wall and no voxel behind it
  std::set<std::size_t> lengths_in_use_, bulges_in_use_;                 ///< answers
  double largest_half_length_m_ = 0.0;
  double largest_foot_bulge_m_ = 0.0;
  StrainRange strains_;
};

/// Largest size (m) against other voxels of any voxel of a calibrated body in its drive.
double largest_collision_size_m(const HollowVoxels& voxels, const CalibratedBody& calibrated);

}  // namespace menger::voxel
