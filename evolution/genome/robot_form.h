#pragma once

#include <string>
#include <vector>

#include "evolution/genome/decoder.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// The body with its lowest cells in the lowest layer of its grid, where it stands on the ground from the start. As it grew, it
/// may begin with a fall.
meshes::Polycube standing(const meshes::Polycube& body);

/// The phenotype all of whose arrays stand. Its aggregates are those of `phenotype`, moved down until they stand.
Phenotype standing(const Phenotype& phenotype);

/// What makes two bodies different robots.
struct Distinction {
  bool materials = true;  ///< the two materials are driven apart, or differ otherwise
  bool place = false;     ///< the drive depends on where in the grid a cell is and how the body is turned
};

/// The digits of a body in the corner of its grid, in each way that it may be turned about the vertical and mirrored without
/// becoming another robot: eight, or one (standing, where it is) if its place matters. Without `materials` all cells are 1.
/// Precondition: the grid is as wide along x as along y.
std::vector<std::string> robot_poses(const meshes::Polycube& body, const Distinction& distinction);

/// Equal for two bodies exactly if they are the same robot, up to where it stands on the ground, how it is turned about the
/// vertical, and its mirror image: the least of its poses. Precondition: as robot_poses.
std::string robot_form(const meshes::Polycube& body, const Distinction& distinction);

}  // namespace menger::evolution
