#pragma once

#include <string>
#include <string_view>

#include "io/study/study_visitor.h"
#include "meshes/design/hollow_body_options.h"

namespace menger::fem {

/// The elements of hollow bodies.
enum class ElementKind {
  thin_wall,   ///< walls of one layer and blocks where they meet: fast; see ThinWallKernels
  three_field  ///< trilinear or quadratic elements with mean dilatation, in any number of layers
};

/// How finely the walls of a cell are cut for thin-wall elements.
enum class Fidelity {
  draft,     ///< two elements between the walls of a cell
  standard,  ///< three elements
  fine       ///< four elements
};

/// The number type of the elements' forces. Positions and velocities are always kept in double precision.
enum class Precision { single_precision, double_precision };

/// The elements of a study.
struct ElementChoice {
  ElementKind kind = ElementKind::thin_wall;
  Fidelity fidelity = Fidelity::standard;
  Precision precision = Precision::single_precision;

  bool operator==(const ElementChoice&) const = default;
};

/// The constants of thin-wall elements, see ThinWallMaterial. The defaults are those of explicit dynamics. They were chosen by
/// static errors against quadratic elements with two and three layers, on bars, plates and bodies with legs with walls of 0.1 to
/// 0.3 of a cell: the softer, the longer are the steps; kappa' = 4 mu and lambda = 5 mu are no truer of inflated bodies, and
/// their steps a fifth shorter.
struct ThinWallConstants {
  double wall_penalty_ratio = 2.0;     ///< kappa' / mu
  double block_stiffness_ratio = 2.0;  ///< lambda / mu
};

/// The constants where equilibria and small vibrations are computed. No step there becomes shorter by stiffer blocks. Edges carry
/// the load of bars between plates, and lambda = 2 mu leaves them 11 % too soft along themselves: forces are then 3 to 10 % too
/// small, with 5 mu 1 to 3 %. Inflated bodies are up to a per cent farther off: from 2 to 6 kPa every body stiffens by 1 to 3 %
/// too much, whatever its blocks, which soft ones hide. 3 mu and 10 mu lie in line with both.
inline constexpr ThinWallConstants constants_of_equilibria{.wall_penalty_ratio = 2.0, .block_stiffness_ratio = 5.0};

/// Returns the constants as text, on which cached results depend: "wall_penalty_ratio = 2, block_stiffness_ratio = 5".
std::string text_of(const ThinWallConstants& constants);

/// Returns the modulus by which the default stiffness of contact is chosen for thin-wall elements, 20 mu. Mean-dilatation
/// elements take their bulk modulus, some 50 mu; thin walls are softer across, and their steps longer.
constexpr double contact_modulus_Pa(double shear_modulus_Pa) { return 20.0 * shear_modulus_Pa; }

/// Describes the keys of the table [elements]. @param has_precision false: the method always computes in double precision, and
/// the key is not offered @param kind_key name of the key of the kind, where the table has another "kind"
void describe(io::StudyVisitor& visitor, ElementChoice& choice, bool has_precision, std::string_view kind_key = "kind");

/// The words of fidelities in files.
const io::Words<Fidelity>& fidelity_words();
std::string_view to_string(Fidelity fidelity);

/// Cuts a hollow body as the fidelity of thin walls says: one layer through every wall, and 2, 3 or 4 elements for the span
/// between the walls of a cell. Does nothing for other elements.
void set_elements(const ElementChoice& choice, meshes::HollowBodyOptions& options);

}  // namespace menger::fem
