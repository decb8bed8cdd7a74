#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fem/inflation/inflation_study.h"
#include "meshes/load_cases/body_top.h"
#include "meshes/load_cases/load_case.h"

namespace menger::fem {

/// The elements of a body, and how finely three-field elements cut its walls.
struct LoadCaseElements {
  ElementChoice choice{.kind = ElementKind::three_field};
  int degree = 2;        ///< 1: Q1/P0, 2: Q2/P1; of three-field elements, as are the next three; see space_degree
  int through_wall = 1;  ///< elements, at least
  /// Edge up to which elements grow away from walls; empty: see meant_elements.
  std::optional<double> largest_element_m{};
  double growth = 4.0;  ///< largest ratio of neighbouring edges

  [[nodiscard]] bool has_thin_walls() const { return choice.kind == ElementKind::thin_wall; }
  /// Degree of the displacements.
  [[nodiscard]] int space_degree() const { return has_thin_walls() ? 1 : degree; }
};

/// The dimensions that the bodies of a set have in common where they state no others; 0: not given.
struct CaseBody {
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
  int level = 1;
  bool per_phase = false;
};

/// Returns a text on the elements, for users and provenance: "finite elements, Q2/P1, 1 through the wall, largest 0.003 m" or
/// "finite elements, thin walls, standard".
std::string elements_text(const LoadCaseElements& elements);

/// A requested load case, whose pressures may still have to be found.
struct CaseRequest {
  /// Pressures and imposed values are ascending. Without pressures, the members below determine them.
  meshes::LoadCase load_case;
  /// Fractions of pressures of the same body and law, ascending. Negative ones are fractions of the pressure at which walls first
  /// touch under vacuum, or buckle before they do. Positive ones are fractions of `safe_share` of the limit pressure.
  std::vector<double> pressure_fractions;
  int state_count = 12;  ///< number of states of an inflation without pressures
  /// Pressure up to which a limit point is searched for. Bodies of laws that stiffen have no limit point.
  std::optional<double> largest_pressure_Pa;
  LoadCaseElements elements;
  std::optional<std::filesystem::path> design_file;  ///< file of the body, if there is one
};

/// Returns the elements of a case as its study means them where it names no largest edge. Quadratic elements with one through the
/// wall may then grow to the span between two walls, where that takes as many elements as equal ones: small ones at the walls,
/// where the shape bends, and a large one in the middle. Other elements stay as in the wall.
LoadCaseElements meant_elements(const CaseRequest& request);

/// Where the height of the top of a case's body is measured.
meshes::BodyTop top_of(const meshes::LoadCase& load_case);

/// The part of the limit pressure up to which bodies are driven.
inline constexpr double safe_share = 0.8;

/// A study of `menger load-cases`: everything that its results depend on.
struct LoadCaseStudy {
  std::filesystem::path file;  ///< from which it was read, for messages
  StudyMaterial material;      ///< with a density
  /// Uncertainty of every ordinate over its largest magnitude. It is the estimate for the discretisation and the idealised shape
  /// (walls of even thickness, sharp edges) where nothing better is known.
  double relative_uncertainty = 0.05;
  std::optional<CaseBody> body;  ///< for cases that state none of their own
  LoadCaseElements elements;     ///< for cases that state none of their own
  std::vector<CaseRequest> cases;
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read, with the study's own
  std::vector<std::string> notes;
};

/// Describes the keys of a set of load cases, which `menger load-cases --keys` lists.
void describe(io::StudyVisitor& visitor, LoadCaseStudy& study);

/// Returns everything that the response to a case depends on, except for its name: equal texts give equal curves.
std::string case_text(const CaseRequest& request, const StudyMaterial& material);

}  // namespace menger::fem
