#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/explicit/material_damping.h"
#include "io/study/study_visitor.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/silicone_record.h"
#include "materials/laws/study_law.h"

namespace menger::fem {

/// The silicone of a body that moves.
struct LocomotionMaterial {
  materials::HyperelasticLaw law;
  double bulk_modulus_Pa = 0.0;    ///< of the energy of Simo and Taylor
  double density_kg_per_m3 = 0.0;  ///< > 0
  DampingModel damping_model = DampingModel::maxwell;
  MaxwellBranch branch;              ///< see maxwell_branch; none by the model of Kelvin and Voigt
  double viscosity_Pa_s = 0.0;       ///< see viscosity_Pa_s of material_damping.h; 0 by Maxwell's model
  materials::LossData loss;          ///< what either comes from
  bool is_damping_measured = false;  ///< false: assumed_silicone_loss
  std::string name;                  ///< for messages: of the record and the law
};

/// The same law with all its moduli times a factor > 0, so that at equal stretches stresses are those times the factor.
materials::HyperelasticLaw stiffened(const materials::HyperelasticLaw& law, double factor);

/// The silicone of a body as a study gives it.
struct StudySilicone {
  materials::StudyLaw law;
  double modulus_factor = 1.0;                  ///< > 0, of all moduli of the law
  std::optional<double> youngs_modulus_Pa{};    ///< > 0, three times the shear modulus at rest; in place of the factor
  double bulk_modulus_ratio = 50.0;             ///< >= 1, of bulk by shear modulus; the default is that of inflation
  bool is_ratio_assumed = false;                ///< whether a study that was read leaves it open
  std::optional<double> density_kg_per_m3{};    ///< > 0; nothing: that of the record
  std::optional<double> loss_factor{};          ///< >= 0; nothing: as the record has it
  double loss_frequency_Hz = 30.0;              ///< > 0, of that factor
  std::optional<DampingModel> damping_model{};  ///< nothing: what the dynamics usually have
};

/// The keys of a silicone.
void describe(io::StudyVisitor& visitor, StudySilicone& silicone);

/// Makes a material of what was given, and states there what it leaves open.
/// @param usual model where none is named @param notes what was assumed is added to it
LocomotionMaterial material_of(StudySilicone& given, DampingModel usual, std::vector<std::string>& notes);

}  // namespace menger::fem
