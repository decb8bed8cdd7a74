#pragma once

#include <string>
#include <vector>

#include "evolution/genome/decoder.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// Returns the body moved down until its lowest cells are in the lowest layer of its grid. It then stands on the ground from the
/// start; as it grew, it may begin with a fall.
meshes::Polycube standing(const meshes::Polycube& body);

/// Returns the phenotype with all its arrays standing. Its aggregates are those of `phenotype`, moved down until they stand.
Phenotype standing(const Phenotype& phenotype);

/// What makes two bodies different robots, besides their shape.
struct Distinction {
  bool materials = true;  ///< the two materials are driven differently, or differ otherwise
  bool place = false;     ///< the drive depends on the place of a cell in the grid and on how the body is turned
};

/// Returns the digits of a body in each of its poses: moved to the corner of its grid, turned about the vertical and mirrored.
/// All poses are the same robot. There are eight, with all cells 1 unless `materials`; if its place matters there is one, the
/// standing body where it is. Precondition: the grid is as wide along x as along y.
std::vector<std::string> robot_poses(const meshes::Polycube& body, const Distinction& distinction);

/// Returns a text that is equal for two bodies exactly if they are the same robot: the least of its poses. Unless its place
/// matters, a robot stays the same when it is moved on the ground, turned about the vertical or mirrored. Precondition: as for
/// robot_poses.
std::string robot_form(const meshes::Polycube& body, const Distinction& distinction);

}  // namespace menger::evolution
