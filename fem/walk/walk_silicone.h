#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/explicit/material_damping.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/silicone_record.h"
#include "materials/laws/study_law.h"

namespace menger::fem {

/// The material of a moving body, with everything that its dynamics needs.
struct WalkMaterial {
  materials::HyperelasticLaw law;
  double bulk_modulus_Pa = 0.0;    ///< of the volumetric energy of Simo and Taylor
  double density_kg_per_m3 = 0.0;  ///< > 0
  DampingModel damping_model = DampingModel::maxwell;
  std::vector<MaxwellBranch> branches{};  ///< see maxwell_branches; none with the model of Kelvin and Voigt
  double viscosity_Pa_s = 0.0;            ///< see viscosity_Pa_s of material_damping.h; 0 with Maxwell's model
  materials::LossData loss;               ///< data of the branches or the viscosity
  bool is_damping_measured = false;       ///< false: stated by the caller, or assumed_silicone_loss
  std::string name;                       ///< of the record and the law, for messages
};

/// Returns a law with all its moduli multiplied by a factor > 0. At equal stretches, stresses are multiplied by the same factor.
materials::HyperelasticLaw stiffened(const materials::HyperelasticLaw& law, double factor);

/// The silicone of a body as a caller states it.
struct WalkSilicone {
  materials::StudyLaw law;
  double modulus_factor = 1.0;                ///< > 0; multiplies all moduli of the law
  std::optional<double> youngs_modulus_Pa{};  ///< > 0, three times the shear modulus at rest; instead of the factor
  double bulk_modulus_ratio = 50.0;           ///< >= 1, bulk modulus over shear modulus; the default is that of inflation
  bool is_ratio_assumed = false;              ///< whether the caller does not state it
  std::optional<double> density_kg_per_m3{};  ///< > 0; empty: that of the record
  std::optional<double> loss_factor{};        ///< >= 0; empty: that of the record
  double loss_frequency_Hz = 30.0;            ///< > 0, of that loss factor
  /// Loss factors > 0 at several frequencies, which ascend, in place of that one.
  std::optional<std::vector<double>> loss_factors{};
  std::vector<double> loss_frequencies_Hz{};
  std::optional<DampingModel> damping_model{};  ///< empty: the usual one of the dynamics
};

/// Gives a silicone one loss factor at its loss_frequency_Hz, in place of what it had.
void set_loss_factor(WalkSilicone& silicone, double loss_factor);

/// Returns the loss factor of a silicone at the highest frequency that it states; 0 if it states none.
double stated_loss_factor(const WalkSilicone& silicone);

/// Makes a material from what the caller states, and fills in there what the caller does not state.
/// @param usual damping model if the caller names none
/// @param notes assumptions are added to it
/// @throws WalkInputError for a law without a record and without a density
WalkMaterial material_of(WalkSilicone& given, DampingModel usual, std::vector<std::string>& notes);

}  // namespace menger::fem
