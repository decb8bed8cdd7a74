#include "fem/walk/walk_silicone_file.h"

#include <algorithm>
#include <functional>

namespace menger::fem {
namespace {

void describe_stiffening(io::StudyVisitor& visitor, WalkSilicone& silicone) {
  const auto describe_factor = [&] {
    visitor.number({"modulus_factor", "All moduli of the law are multiplied by this factor."}, silicone.modulus_factor,
                   io::positive());
  };
  const auto describe_modulus = [&] {
    double modulus_Pa = silicone.youngs_modulus_Pa.value_or(0.0);
    visitor.number({"youngs_modulus_Pa", "Young's modulus at rest. All moduli of the law are scaled to reach it.", "1.5e5"},
                   modulus_Pa, io::positive());
    silicone.youngs_modulus_Pa = modulus_Pa;
  };
  const bool has_modulus = silicone.youngs_modulus_Pa.has_value();
  visitor.one_of({{"modulus_factor", !has_modulus, [&] { silicone.youngs_modulus_Pa.reset(); }, describe_factor},
                  {"youngs_modulus_Pa", has_modulus, [] {}, describe_modulus}});
}

}  // namespace

void describe(io::StudyVisitor& visitor, WalkSilicone& silicone) {
  describe(visitor, silicone.law);
  describe_stiffening(visitor, silicone);
  visitor.number({"bulk_modulus_ratio", "Bulk modulus divided by the shear modulus at rest."}, silicone.bulk_modulus_ratio,
                 io::at_least(1.0));
  visitor.optional_number(
      {"density_kg_per_m3", "Density. Needed with a law; with a silicone it replaces the silicone's density.", "1070"},
      silicone.density_kg_per_m3, io::positive());
  visitor.optional_number({"loss_factor", "Loss factor of small shear. It replaces the silicone's loss factor.", "0.1"},
                          silicone.loss_factor, io::non_negative());
  visitor.only_if(silicone.loss_factor.has_value(), "loss_factor", [&] {
    visitor.number({"loss_frequency_Hz", "Frequency of the loss factor.", "30"}, silicone.loss_frequency_Hz, io::positive());
  });
  visitor.optional_numbers({"loss_factors",
                            "Loss factors of small shear at several frequencies, which Maxwell branches follow. They replace the "
                            "silicone's.",
                            "[0.06, 0.11, 0.15]"},
                           silicone.loss_factors, io::positive(), {.fewest = 2});
  visitor.only_if(silicone.loss_factors.has_value(), "loss_factors", [&] {
    visitor.numbers({"loss_frequencies_Hz", "Frequencies of the loss factors, which ascend.", "[1, 10, 30]"},
                    silicone.loss_frequencies_Hz, io::positive(), {.fewest = 2});
    visitor.check(!silicone.loss_factors || silicone.loss_frequencies_Hz.size() == silicone.loss_factors->size(),
                  "loss_frequencies_Hz", "must have as many values as loss_factors");
    visitor.check(std::ranges::adjacent_find(silicone.loss_frequencies_Hz, std::ranges::greater_equal{}) ==
                      silicone.loss_frequencies_Hz.end(),
                  "loss_frequencies_Hz", "must ascend");
  });
  visitor.check(!silicone.loss_factor || !silicone.loss_factors, "loss_factors", "cannot stand beside loss_factor");
  visitor.optional_word({"damping_model",
                         "maxwell: a branch that damps most at one frequency, or branches that follow the loss factors; "
                         "kelvin_voigt: a viscosity that damps more the faster "
                         "the motion is. If not given: maxwell for explicit dynamics. Implicit dynamics has only kelvin_voigt.",
                         "\"kelvin_voigt\""},
                        silicone.damping_model,
                        {{"maxwell", DampingModel::maxwell}, {"kelvin_voigt", DampingModel::kelvin_voigt}});
  const io::TomlTable* table = visitor.source();
  if (table == nullptr) return;
  silicone.is_ratio_assumed = !table->has("bulk_modulus_ratio");
  if (!silicone.density_kg_per_m3 && !silicone.law.record)
    throw table->missing("density_kg_per_m3", "a law that is given in the study has no density");
}

}  // namespace menger::fem
