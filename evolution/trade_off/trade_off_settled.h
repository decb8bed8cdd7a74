#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_table.h"
#include "io/process/program_job.h"
#include "voxel/statics/static_body.h"

namespace menger::evolution {

/// Position and orientation of a voxel in a frame of `menger simulate`.
struct OrientedVoxel {
  voxel::Vector3<double> middle;               ///< m
  std::array<voxel::Vector3<double>, 3> axes;  ///< directions of its own x, y, z, of length one
};

/// Computes the observables of a calibrated body under pressure from frames of `menger simulate`, as finite elements have them.
///
/// Frames have the centres and orientations of voxels. The positions of the walls follow from the parameters, see
/// voxel::BodyShape.
class SettledBody {
 public:
  using Voxels = std::vector<OrientedVoxel>;  ///< in grid order

  /// @param parameters a file of voxel parameters
  /// @throws io::InputError with file, key and value if it is not such a file, or holds for another silicone, law, cell edge or
  /// wall thickness than those of the study
  SettledBody(const TradeStudy& study, const std::filesystem::path& parameters);

  [[nodiscard]] int voxels_per_cell() const { return body_.parameters.voxels_per_cell; }
  [[nodiscard]] std::size_t voxel_count() const { return body_.voxel_count(); }

  /// Checks that every wall has a size under a gauge pressure. @throws io::InputError with the file of parameters if not
  void require_sizes(double pressure_Pa) const;

  /// Returns the value of an observable. @param now as many voxels as the body has
  /// @param pressure_Pa gauge pressure of all chambers; see require_sizes
  [[nodiscard]] double observed(TradeObservable observable, const Voxels& now, double pressure_Pa) const;

 private:
  [[nodiscard]] voxel::DrivenSizes sizes(double pressure_Pa) const;

  std::filesystem::path file_;
  voxel::StaticBody body_;
};

/// Returns one body for each parameters file of study.settling, by file; none if the study has no settling. Nothing is simulated
/// here: the bodies measure the frames of the settling runs.
/// @throws io::InputError as the constructor of SettledBody does, and with both files if two have the same number of voxels per
/// cell
std::map<std::filesystem::path, SettledBody> settled_bodies(const TradeStudy& study);

/// Reads the voxels of a frame: their centres (centre_m, see voxel::write_frame) and the orientations of their boxes.
/// @throws io::InputError with the file if it is not such a frame
SettledBody::Voxels frame_voxels(const std::filesystem::path& file);

/// Reads the result of a settling run into a row. The reason has every observable that was still moving at the end: it changed by
/// more than a thousandth of its error_scales over the last tenth of the time.
/// @throws io::InputError if the result cannot be read
void read_settling_result(const TradeStudy& study, const SettledBody& body, double pressure_Pa,
                          const io::ProgramJobResult& result, TradeRow& row);

}  // namespace menger::evolution
