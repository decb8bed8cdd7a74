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

/// A voxel as a frame of `menger simulate` shows it.
struct OrientedVoxel {
  voxel::Vector3<double> middle;               ///< m
  std::array<voxel::Vector3<double>, 3> axes;  ///< directions of its own x, y, z, of length one
};

/// A calibrated body under a pressure, as frames of `menger simulate` show it, observed like one of finite elements.
///
/// Frames hold the middles of voxels and how they are turned. Where the walls lie follows from the parameters, see
/// voxel::BodyShape.
class SettledBody {
 public:
  using Voxels = std::vector<OrientedVoxel>;  ///< in grid order

  /// @param parameters a file of voxel parameters
  /// @throws io::InputError with file, key and value for what is none, or holds for another silicone, law, cell edge or wall
  /// thickness than the study's
  SettledBody(const TradeStudy& study, const std::filesystem::path& parameters);

  [[nodiscard]] int voxels_per_cell() const { return body_.parameters.voxels_per_cell; }
  [[nodiscard]] std::size_t voxel_count() const { return body_.voxel_count(); }

  /// @throws io::InputError with the file of parameters if a wall has no size under a gauge pressure
  void require_sizes(double pressure_Pa) const;

  /// @param now as many voxels as the body has @param pressure_Pa gauge, of all chambers; see require_sizes
  [[nodiscard]] double observed(TradeObservable observable, const Voxels& now, double pressure_Pa) const;

 private:
  [[nodiscard]] voxel::DrivenSizes sizes(double pressure_Pa) const;

  std::filesystem::path file_;
  voxel::StaticBody body_;
};

/// The body by each parameters file of the study's settling, if it has one.
/// @throws io::InputError as the constructor does, and naming both files if two divide a cell into equally many voxels
std::map<std::filesystem::path, SettledBody> settled_bodies(const TradeStudy& study);

/// The voxels of a frame: where their centres are (centre_m, see voxel::write_frame) and how their boxes are turned.
/// @throws io::InputError if the file is none, with its name
SettledBody::Voxels frame_voxels(const std::filesystem::path& file);

/// Reads what a settling run gave into a row; the reason names every observable that was still moving at the end, by more than a
/// thousandth of its error_scales over the last tenth of the time.
/// @throws io::InputError if the result cannot be read
void read_settling_result(const TradeStudy& study, const SettledBody& body, double pressure_Pa,
                          const io::ProgramJobResult& result, TradeRow& row);

}  // namespace menger::evolution
