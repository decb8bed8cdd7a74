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
#include "io/study/study_visitor.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/design/side.h"

namespace menger::fem {

/// A silicone as a study names it: a law with its range, a volumetric energy and a density.
struct StudyMaterial {
  materials::HyperelasticLaw law;
  VolumetricLaw volume = materials::SimoTaylorVolume{};
  std::optional<double> density_kg_per_m3;  ///< gravity needs one
  double smallest_stretch = 0.0;            ///< 1: never compared with compression; 0: no range is stated
  double largest_stretch = std::numeric_limits<double>::infinity();
  std::string name;                           ///< for messages: of the record and the law
  std::string silicone = "unnamed silicone";  ///< name of the record
  std::optional<std::filesystem::path> file;  ///< of the record, if there is one
  std::vector<std::string> notes;             ///< what was assumed, for people
};

/// The keys of a silicone (see materials::StudyLaw) with its volumetric energy and its density.
void describe(io::StudyVisitor& visitor, StudyMaterial& material);

/// A body from a design.
struct DesignSource {
  std::optional<std::filesystem::path> file;  ///< nothing for one that is drawn in the study
  meshes::Design design;
  meshes::HollowBodyOptions options;
};

/// A body from a mesh file (.msh of Gmsh or .vtu of menger).
struct MeshSource {
  std::filesystem::path file;
  double length_unit_m = 1.0;  ///< of a .msh
};

/// How a body stands.
enum class SupportKind {
  ground_guided,  ///< faces on the ground held in z; the body's other rigid motions are held at two points
  ground_held,    ///< faces on the ground held in all directions
  resting,        ///< gravity presses the body on a plane that only pushes; horizontal rigid motions are held at two points
  free,           ///< nothing but the six rigid motions, held at three points without any force (see free_supports)
  labels          ///< nothing but what label supports and planes of symmetry hold
};

/// Components held at zero on the faces with a label.
struct LabelSupport {
  std::string label;
  std::array<bool, 3> held{};
};

struct StudySupports {
  SupportKind kind = SupportKind::ground_guided;
  std::vector<LabelSupport> labels;  ///< in addition
  double ground_stiffness_Pa_per_m = 1e7;
};

/// A rigid plate on faces of the body: all those on a side of its bounding box, or with a label.
struct StudyPlate {
  std::string name;                  ///< in the columns of curves.csv
  std::optional<meshes::Side> side;  ///< or `label`
  std::string label;
  bool slides = false;  ///< on a side only: the faces slide on it, and it moves along the side's normal
  PlateDrive drive;
};

/// A point whose displacement and stretch are followed.
struct NamedPoint {
  std::string name;
  Point position{};  ///< in the reference configuration, m
};

struct StudyOutput {
  std::vector<NamedPoint> points;
  bool fields = true;
  int fields_every = 1;  ///< points of the path per file of fields; the last point always gets one
  bool pictures = true;
};

/// Everything that decides what `menger inflate` computes. Physics takes parts of it and never sees the file.
struct InflationStudy {
  std::filesystem::path file;  ///< that it came from, for messages
  std::variant<DesignSource, MeshSource> source;
  StudyMaterial material;
  std::map<std::string, StudyMaterial> region_materials;  ///< by region where it is not `material`
  int degree = 2;
  Formulation formulation = Formulation::three_field;
  int refinements = 0;
  StudySupports supports;
  double gravity_m_per_s2 = 0.0;  ///< downwards, >= 0
  std::vector<StudyPlate> plates;
  /// By plenum; the drive under the empty name is that of all plena.
  std::map<std::string, PlenumDrive> drives;
  PathOptions path;
  EquilibriumOptions solver;
  StudyOutput output;
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read, the study's included
  std::vector<std::string> notes;             ///< what was assumed or is doubtful, for people
};

/// The keys of a study of `menger inflate`; `menger inflate --keys` lists them.
void describe(io::StudyVisitor& visitor, InflationStudy& study);

/// All that decides the states of a path as text: settings with defaults filled in, the design, and the hash of a mesh. Equal
/// texts give equal paths; what is written about them does not enter.
std::string path_text(const InflationStudy& study);

/// The text of the study, from which it is read back: the resolved parameters for the manifest.
std::string resolved_text(const InflationStudy& study);

}  // namespace menger::fem
