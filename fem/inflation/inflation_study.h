#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fem/elements/element_kernel.h"
#include "fem/statics/equilibrium.h"
#include "fem/statics/inflation_path.h"
#include "fem/surfaces/point.h"
#include "fem/thin_walls/element_choice.h"
#include "io/study/study_visitor.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/design/side.h"

namespace menger::fem {

/// A silicone in a study: a law with its range, a volumetric energy and a density.
struct StudyMaterial {
  materials::HyperelasticLaw law;
  VolumetricLaw volume = materials::SimoTaylorVolume{};
  std::optional<double> density_kg_per_m3;  ///< gravity needs one
  double smallest_stretch = 0.0;            ///< 1: the law was fitted to stretch alone; 0: no range is stated
  double largest_stretch = std::numeric_limits<double>::infinity();
  std::string name;                           ///< of the record and the law, for messages
  std::string silicone = "unnamed silicone";  ///< name of the record
  std::optional<std::filesystem::path> file;  ///< of the record, if there is one
  std::vector<std::string> notes;             ///< assumptions, for users
};

/// Describes the keys of a silicone (see materials::StudyLaw) with its volumetric energy and its density.
void describe(io::StudyVisitor& visitor, StudyMaterial& material);

/// A body from a design.
struct DesignSource {
  std::optional<std::filesystem::path> file;  ///< empty for a design that is drawn in the study
  meshes::Design design;
  meshes::HollowBodyOptions options;
};

/// A body from a mesh file (.msh of Gmsh or .vtu of menger).
struct MeshSource {
  std::filesystem::path file;
  double length_unit_m = 1.0;  ///< of a .msh
};

/// The supports of a body.
enum class SupportKind {
  /// Faces on the ground are held in z; the body's other rigid motions are held at two points.
  ground_guided,
  ground_held,  ///< faces on the ground held in all directions
  /// Gravity presses the body on a plane that only pushes; horizontal rigid motions are held at two points.
  resting,
  /// Only the six rigid motions are held, at three points without any force (see free_supports).
  free,
  labels  ///< only the label supports and planes of symmetry hold the body
};

/// Displacement components held at zero on the faces with a label.
struct LabelSupport {
  std::string label;
  std::array<bool, 3> held{};
};

/// The supports of a study's body.
struct StudySupports {
  SupportKind kind = SupportKind::ground_guided;
  std::vector<LabelSupport> labels;  ///< in addition to `kind`
  double ground_stiffness_Pa_per_m = 1e7;
};

/// A rigid plate on faces of the body: on all faces on a side of its bounding box, or on all faces with a label.
struct StudyPlate {
  std::string name;                  ///< in the columns of curves.csv
  std::optional<meshes::Side> side;  ///< or `label`
  std::string label;
  /// Only for plates on a side: the faces slide on the plate, and it moves along the side's normal.
  bool slides = false;
  PlateDrive drive;
};

/// A named point at which displacement and stretch are recorded.
struct NamedPoint {
  std::string name;
  Point position{};  ///< in the reference configuration, m
};

/// The output of a study.
struct StudyOutput {
  std::vector<NamedPoint> points;
  bool fields = true;
  /// Number of points of the path per file of fields; the last point always has a file.
  int fields_every = 1;
  bool pictures = true;
};

/// A study of `menger inflate`: everything that its results depend on. The physics takes parts of it and does not read the file.
struct InflationStudy {
  std::filesystem::path file;  ///< from which it was read, for messages
  std::variant<DesignSource, MeshSource> source;
  StudyMaterial material;
  std::map<std::string, StudyMaterial> region_materials;  ///< by region, where the material is not `material`
  ElementChoice elements{.kind = ElementKind::three_field};
  int degree = 2;  ///< of three-field elements, as are the next two; see space_degree
  Formulation formulation = Formulation::three_field;
  int refinements = 0;
  StudySupports supports;
  double gravity_m_per_s2 = 0.0;  ///< downwards, >= 0
  std::vector<StudyPlate> plates;
  /// Drives by plenum; the drive under the empty name is that of all plena.
  std::map<std::string, PlenumDrive> drives;
  PathOptions path;
  EquilibriumOptions solver;
  StudyOutput output;
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read, with the study's own
  std::vector<std::string> notes;             ///< assumptions and doubts, for users

  [[nodiscard]] bool has_thin_walls() const { return elements.kind == ElementKind::thin_wall; }
  /// Degree of the displacements.
  [[nodiscard]] int space_degree() const { return has_thin_walls() ? 1 : degree; }
};

/// Describes the keys of a study of `menger inflate`, which `menger inflate --keys` lists.
void describe(io::StudyVisitor& visitor, InflationStudy& study);

/// Returns as text everything that the states of a path depend on: settings with defaults filled in, the design, and the hash of
/// a mesh. Equal texts give equal paths. Output settings are not part of it.
std::string path_text(const InflationStudy& study);

/// Returns the text of the study, from which it can be read back: the resolved parameters for the manifest.
std::string resolved_text(const InflationStudy& study);

}  // namespace menger::fem
