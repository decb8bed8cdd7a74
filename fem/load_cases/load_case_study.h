#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fem/inflation/inflation_study.h"
#include "meshes/load_cases/load_case.h"

namespace menger::fem {

/// How finely the walls of a body are meshed.
struct LoadCaseElements {
  int degree = 2;                           ///< 1: Q1/P0, 2: Q2/P1
  int through_wall = 1;                     ///< elements, at least
  std::optional<double> largest_element_m;  ///< edge to which elements grow away from walls; none: as in the wall
  double growth = 1.5;                      ///< largest ratio of neighbouring edges
};

/// What the bodies of a set have in common, where they say nothing else; 0: not given.
struct CaseBody {
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
  int level = 1;
  bool per_phase = false;
};

/// For people and provenance: "finite elements, Q2/P1, 1 through the wall, largest 0.003 m".
std::string elements_text(const LoadCaseElements& elements);

/// A load case as it is asked for: its pressures may still have to be found.
struct CaseRequest {
  meshes::LoadCase load_case;  ///< pressures and imposed values ascending; no pressures: those below say which
  /// Negative: of the pressure at which walls first touch under vacuum, or buckle before they do; positive: of `safe_share` of
  /// the limit pressure; of the same body and law. Ascending.
  std::vector<double> pressure_fractions;
  int state_count = 12;  ///< of an inflation without pressures
  /// Under which a limit point is looked for; laws that stiffen have none.
  std::optional<double> largest_pressure_Pa;
  LoadCaseElements elements;
  std::optional<std::filesystem::path> design_file;  ///< that gave the body, if one did
};

/// Part of the limit pressure that bodies are driven with.
inline constexpr double safe_share = 0.8;

/// Everything that decides what `menger load-cases` computes.
struct LoadCaseStudy {
  std::filesystem::path file;  ///< that it came from, for messages
  StudyMaterial material;      ///< with a density
  /// Of every ordinate by its largest magnitude: what the discretisation and the idealised shape (walls of even thickness, sharp
  /// edges) are taken to be worth where nothing better is known.
  double relative_uncertainty = 0.05;
  std::optional<CaseBody> body;  ///< of cases that give none of their own
  LoadCaseElements elements;     ///< the same
  std::vector<CaseRequest> cases;
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read, the study's included
  std::vector<std::string> notes;
};

/// The keys of a set of load cases; `menger load-cases --keys` lists them.
void describe(io::StudyVisitor& visitor, LoadCaseStudy& study);

/// All that decides the answer to a case, but for its name: equal texts give equal curves.
std::string case_text(const CaseRequest& request, const StudyMaterial& material);

}  // namespace menger::fem
