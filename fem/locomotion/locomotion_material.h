#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fem/explicit/material_damping.h"
#include "io/text/toml_document.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/silicone_record.h"

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

/// Reads a silicone: `record` with `law` ("recommended", or one of the others of the record, `law_variant` if it has several), or
/// a table `law` (see materials::read_law) and `density_kg_per_m3`; `modulus_factor` or `youngs_modulus_Pa` (three times the
/// shear modulus at rest) to stiffen it; `bulk_modulus_ratio` (50) of bulk by shear modulus; `density_kg_per_m3` in place of the
/// record's; `loss_factor` and `loss_frequency_Hz` in place of the record's damping; `damping_model` ("maxwell", "kelvin_voigt").
/// @param usual model where none is named @param read_input is called with the file of the record @param notes what was assumed
/// is added to it
/// @throws io::InputError with file, key and value
LocomotionMaterial read_locomotion_material(const io::TomlTable& table, DampingModel usual,
                                            const std::function<void(const std::filesystem::path&)>& read_input,
                                            std::vector<std::string>& notes);

}  // namespace menger::fem
