#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "voxel/statics/static_body.h"

namespace menger::voxel {

class Equilibrium;

/// What a body of the surrogate looks like from outside where its voxels lie: half lengths, faces, volumes.
///
/// From the centre of a voxel to a side it is half the length of the beam there, the whole of a half beam to a plate, and where
/// there is none the driven half length, shortened by the lateral coupling as if a beam without load were there: (L / 2)(1 +
/// extension)(1 - c (e_b + e_d)), e_a half the sum of the strains of the beams along a at the voxel. Walls bulge where neither a
/// voxel nor a plate lies behind them.
class BodyShape {
 public:
  /// @param poses of the nodes, those of the voxels first; of a body without plates they may end there. All must outlive this
  BodyShape(const StaticBody& body, const DrivenSizes& sizes, const std::vector<Pose>& poses);

  /// @param equilibrium must outlive this and not move
  explicit BodyShape(const Equilibrium& equilibrium);

  /// From the centre of a voxel to a side, without the bulge, m.
  [[nodiscard]] double half_length(std::size_t voxel, meshes::Side side) const;

  /// Mean bulge over the area of a side, m outwards; 0 where the wall cannot bulge or there is none.
  [[nodiscard]] double bulge(std::size_t voxel, meshes::Side side) const;

  /// Place of a side: its mean, or with the factor bulge_peak_ratio its middle, world, m.
  [[nodiscard]] Vector3<double> face(std::size_t voxel, meshes::Side side, double bulge_factor = 1.0) const;

  /// Distance of the mean positions of the end faces across an axis, m.
  [[nodiscard]] double extent(std::size_t axis) const;

  /// Height of the middle of the top over the mean of the bottom faces, m. Where no voxel lies in the middle of the top layer it
  /// is that of the nearest voxels, without bulge: the rim of a wall stands still beside it.
  [[nodiscard]] double top_height() const;

  /// Extents and height of the top in the frame of the body, m.
  struct FreeSize {
    std::array<double, 3> extents{};
    double top_height = 0.0;
  };

  /// The same after the rotation of the body is taken out (meshes::rotation_of_body), for a body that is free but for its
  /// rigid motions: where an unsymmetric one is held turns it, and says nothing.
  [[nodiscard]] FreeSize free_size() const;

  /// Walls across an axis that face each other and have met.
  struct WallContact {
    std::size_t voxel = 0;  ///< behind the wall on the low side
    std::size_t axis = 0;
  };

  /// The first pair of facing walls of a chamber that have met in the mean over their areas, the thickness of both counted; as
  /// long as there is none every chamber has air between its walls. Their middles meet earlier where they bulge more.
  [[nodiscard]] std::optional<WallContact> wall_contact() const;

  /// Mean height of the faces on the x max side, m.
  [[nodiscard]] double tip_height() const;

  /// Volume of all chambers by that at rest, minus 1. The wall keeps its volume, so that the chambers change by what the voxels
  /// do: per voxel the product of its lengths, plus bulge times area of its walls.
  [[nodiscard]] double chamber_volume_change() const;

 private:
  [[nodiscard]] Vector3<double> mean_of_faces(meshes::Side side) const;
  [[nodiscard]] Vector3<double> middle_of_top() const;
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
