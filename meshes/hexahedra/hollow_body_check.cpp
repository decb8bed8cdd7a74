#include "meshes/hexahedra/hollow_body_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "meshes/design/connectivity.h"
#include "meshes/design/weak_contacts.h"

namespace menger::meshes {
namespace {

/// The largest number of elements through a wall, far more than can be computed. Without a limit, grid lines could fill the
/// memory before they are counted.
constexpr int most_elements_through_wall = 1000;

/// The smallest wall and chamber as parts of the cell edge. Thinner ones cannot be cast, and elements that thin have no accurate
/// volume.
constexpr double smallest_part = 1e-4;

/// The smallest edge of a hole as a part of the cell edge.
constexpr double smallest_hole_part = 1e-3;

/// The largest number of elements along a cell; see most_elements_through_wall.
constexpr double most_elements_along_cell = 20'000.0;

[[noreturn]] void refuse(const Design& design, const std::string& reason) {
  throw io::InputError("design " + design.name + ": " + reason);
}

[[noreturn]] void refuse(const Design& design, const std::string& option, double value, const std::string& demand) {
  refuse(design, option + " = " + io::number_text(value) + ": " + demand);
}

/// Returns a limit for a message, rounded to a few digits.
std::string limit_text(double value) { return io::shown(value, 6); }

bool is_length(double value) { return std::isfinite(value) && value > 0.0; }

void check_lengths(const Design& design, const HollowBodyOptions& options) {
  const double wall = options.wall_thickness_m;
  if (!is_length(wall)) refuse(design, "wall_thickness_m", wall, "must be > 0");
  if (!is_length(design.cell_edge_m)) refuse(design, "cell_edge_m", design.cell_edge_m, "must be > 0");
  if (!(wall < 0.5 * design.cell_edge_m)) {
    refuse(design, "wall_thickness_m", wall,
           "must be smaller than half a cell (" + limit_text(0.5 * design.cell_edge_m) + "), so that a chamber remains");
  }
  const double smallest = smallest_part * design.cell_edge_m;
  if (wall < smallest || design.cell_edge_m - 2.0 * wall < smallest) {
    refuse(design, "wall_thickness_m", wall,
           "wall and chamber must each be at least " + limit_text(smallest) + " thick, 1/10000 of the cell edge");
  }
  if (options.elements_through_wall < 1 || options.elements_through_wall > most_elements_through_wall) {
    refuse(design, "elements_through_wall", options.elements_through_wall,
           "must be in 1 .. " + std::to_string(most_elements_through_wall));
  }
  if (options.largest_element_m &&
      !(is_length(*options.largest_element_m) && *options.largest_element_m * most_elements_through_wall >= wall)) {
    refuse(design, "largest_element_m", *options.largest_element_m,
           "must be > 0 and at least " + limit_text(wall / most_elements_through_wall));
  }
  const double wall_edge = wall / options.elements_through_wall;
  if (const double edge = std::min(wall_edge, options.largest_element_m.value_or(wall_edge));
      design.cell_edge_m > most_elements_along_cell * edge) {
    refuse(design, "elements_through_wall = " + std::to_string(options.elements_through_wall) + ": elements of " +
                       limit_text(edge) + " m are too small for cells of " + limit_text(design.cell_edge_m) + " m: at most " +
                       limit_text(most_elements_along_cell) + " may lie along a cell");
  }
  if (!(std::isfinite(options.growth) && options.growth >= 1.0)) refuse(design, "growth", options.growth, "must be at least 1");
  if (options.level < 1) refuse(design, "level", options.level, "must be at least 1");
  if (options.hole_edge_m && options.level == 1)
    refuse(design, "hole_edge_m", *options.hole_edge_m, "holes join modules, but level 1 has only one module");
}

void check_hole_edge(const Design& design, const HollowBodyOptions& options, const std::string& option, double edge) {
  const double span = design.cell_edge_m - 2.0 * options.wall_thickness_m;
  // Rounding of this difference must not refuse a hole as wide as the chamber.
  const double smallest = smallest_hole_part * design.cell_edge_m;
  if (is_length(edge) && edge >= smallest && edge <= span * (1.0 + 1e-9)) return;
  refuse(design, option, edge,
         "must be at least 1/1000 of the cell edge = " + limit_text(smallest) +
             " and at most cell edge - 2 wall thicknesses = " + limit_text(span));
}

}  // namespace

void check_design(const Design& design, const HollowBodyOptions& options) {
  check_lengths(design, options);
  if (options.hole_edge_m) check_hole_edge(design, options, "hole_edge_m", *options.hole_edge_m);
  for (const TubeHole& tube : options.tubes) check_hole_edge(design, options, "tubes.edge_m", tube.edge_m);
  if (design.body.count() == 0) refuse(design, "the body is empty");
  if (const std::size_t parts = count_components(design.body); parts > 1)
    refuse(design, "the body consists of " + std::to_string(parts) + " parts that are not joined by a side of a cell");
  if (const auto contact = first_weak_contact(design.body)) {
    refuse(design, "cells " + cell_text(contact->first) + " and " + cell_text(contact->second) +
                       " touch only along an edge or at a corner: a cast body would break there");
  }
}

void check_body(const Design& design, const HollowBodyOptions& options, const ModularBody& body) {
  if (const std::size_t parts = count_components(body.cells()); parts > 1) {
    refuse(design, "at level " + std::to_string(options.level) + " the body consists of " + std::to_string(parts) +
                       " parts that are not joined by a side of a cell");
  }
  for (std::size_t i = 0; i < options.tubes.size(); ++i) {
    const TubeHole& tube = options.tubes[i];
    const std::string name = "tube hole at side " + std::string(to_string(tube.side)) + " of cell " + cell_text(tube.cell) + ": ";
    if (body.cells().at_or_empty(tube.cell) == empty) refuse(design, name + "there is no such cell");
    if (body.cells().at_or_empty(neighbour(tube.cell, tube.side)) != empty)
      refuse(design, name + "another cell lies at that side, so that no tube can reach it");
    const auto same_place = [&](const TubeHole& other) { return other.cell == tube.cell && other.side == tube.side; };
    if (std::any_of(options.tubes.begin(), options.tubes.begin() + static_cast<std::ptrdiff_t>(i), same_place))
      refuse(design, name + "is given twice");
  }
}

}  // namespace menger::meshes
