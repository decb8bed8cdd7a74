#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "meshes/load_cases/body_extents.h"
#include "voxel/statics/static_body.h"

namespace menger::voxel {

class Equilibrium;

/// The outer shape of a surrogate body at given voxel positions: half lengths, faces, volumes.
///
/// The half length of a voxel is the distance from its centre to a side. If a beam leaves the voxel there, it is half the length
/// of the beam, or the whole length of a half beam to a plate. Otherwise it is the driven half length, shortened by the lateral
/// coupling as if an unloaded beam were there: (L / 2)(1 + extension)(1 - c (e_b + e_d)), where e_a is half the sum of the
/// strains of the beams along a at the voxel. Walls bulge where neither a voxel nor a plate lies behind them.
class BodyShape {
 public:
  /// @param poses of the nodes, voxels first; for a body without plates only those of the voxels are needed
  /// All arguments must outlive this object.
  BodyShape(const StaticBody& body, const DrivenSizes& sizes, const std::vector<Pose>& poses);

  /// @param equilibrium must outlive this object and must not change meanwhile
  explicit BodyShape(const Equilibrium& equilibrium);

  /// Distance from the centre of a voxel to a side, without the bulge, m.
  [[nodiscard]] double half_length(std::size_t voxel, meshes::Side side) const;

  /// Mean bulge over the area of a side, outwards, m. It is 0 if there is no wall or if the wall cannot bulge.
  [[nodiscard]] double bulge(std::size_t voxel, meshes::Side side) const;

  /// World position of a side, m: its mean position, or its middle with bulge_peak_ratio as factor.
  [[nodiscard]] Vector3<double> face(std::size_t voxel, meshes::Side side, double bulge_factor = 1.0) const;

  /// Distance between the mean positions of the end faces across an axis, m.
  [[nodiscard]] double extent(std::size_t axis) const;

  /// Height of the middle of the top above the mean of the bottom faces, m. A wall stands out there by bulge_peak_ratio times its
  /// mean, beside the crown of a square of voxels by what a parabola between the walls has there, and at the end of a square from
  /// which an arm leaves by its mean. But where a wall across it ends, as in the corner of an L or where modules meet, it is the
  /// height of this rim. If no voxel lies in the middle of the top layer, it is the height of the nearest voxels without bulge,
  /// because the rim of a wall beside them does not move.
  [[nodiscard]] double top_height() const;

  /// Extents of the body and height of its top, in the frame of the body, m.
  struct FreeSize {
    std::array<double, 3> extents{};
    double top_height = 0.0;
  };

  /// Extents and height of the top after the rotation of the body is taken out (meshes::rotation_of_body). For a body that is
  /// free to move rigidly: if it is not symmetric, it turns depending on where it is held, and this rotation has no meaning.
  [[nodiscard]] FreeSize free_size() const;

  /// How far each foot has moved away from the middle of all feet, m, see meshes::feet_outwards_m.
  [[nodiscard]] std::vector<double> feet_outwards() const;

  /// Two facing walls across an axis that touch each other.
  struct WallContact {
    std::size_t voxel = 0;  ///< the voxel behind the wall on the low side
    std::size_t axis = 0;
  };

  /// The first pair of facing chamber walls that touch, in the mean over their areas and with the thickness of both; nothing
  /// while all chambers have air between their walls. Walls that bulge more in the middle meet there earlier.
  [[nodiscard]] std::optional<WallContact> wall_contact() const;

  /// Mean height of the faces on the x max side, m.
  [[nodiscard]] double tip_height() const;

  /// Relative change of the volume of all chambers: volume / volume at rest - 1. The wall keeps its volume, so the chambers
  /// change by as much as the voxels. The volume of a voxel is the product of its lengths, plus bulge times area of its walls, of
  /// plates and blocks times wide_volume_ratio.
  [[nodiscard]] double chamber_volume_change() const;

 private:
  [[nodiscard]] Vector3<double> mean_of_faces(meshes::Side side) const;
  [[nodiscard]] double bulge_factor_of_top(std::size_t voxel, const std::array<int, 2>& towards) const;
  [[nodiscard]] Vector3<double> middle_of_top() const;
  /// Whether a wall stands on a side of a voxel on which the middle of the top lies. @param towards see meshes::BodyTop
  [[nodiscard]] bool ends_at_wall(std::size_t voxel, const std::array<int, 2>& towards) const;
  /// The point of a voxel at the middle of the top, where its wall does not bulge.
  [[nodiscard]] Vector3<double> rim_of_top(std::size_t voxel, const std::array<int, 2>& towards) const;
  /// The ends of the body, at rest and now.
  struct Ends {
    meshes::EndPoints at_rest{};
    meshes::EndPoints deformed{};
  };
  [[nodiscard]] Ends ends() const;
  [[nodiscard]] double wall_within(std::size_t voxel, meshes::Side side) const;
  [[nodiscard]] double clearance(std::size_t voxel, std::size_t axis) const;
  [[nodiscard]] double voxel_volume(std::size_t voxel) const;

  [[nodiscard]] double rest_length(std::size_t beam) const;
  [[nodiscard]] double axial_strain(std::size_t beam) const;

  const StaticBody* body_;
  const DrivenSizes* sizes_;
  const std::vector<Pose>* poses_;
};

}  // namespace menger::voxel
