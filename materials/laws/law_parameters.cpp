#include "materials/laws/law_parameters.h"

#include <cassert>

namespace menger::materials {

namespace {

/// A parameter of a law: its name and the address of its value.
struct Parameter {
  std::string name;
  double* value;
};

std::vector<Parameter> places_in(NeoHookean& law) { return {{"shear_modulus_Pa", &law.shear_modulus_Pa}}; }
std::vector<Parameter> places_in(MooneyRivlin& law) { return {{"c10_Pa", &law.c10_Pa}, {"c01_Pa", &law.c01_Pa}}; }
std::vector<Parameter> places_in(Yeoh& law) {
  return {{"c10_Pa", &law.c10_Pa}, {"c20_Pa", &law.c20_Pa}, {"c30_Pa", &law.c30_Pa}};
}
std::vector<Parameter> places_in(Gent& law) {
  return {{"shear_modulus_Pa", &law.shear_modulus_Pa}, {"locking_excess", &law.locking_excess}};
}
std::vector<Parameter> places_in(ArrudaBoyce& law) {
  return {{"shear_modulus_Pa", &law.shear_modulus_Pa}, {"locking_stretch", &law.locking_stretch}};
}
template <std::size_t n>
std::vector<Parameter> places_in(Ogden<n>& law) {
  std::vector<Parameter> places;
  for (std::size_t p = 0; p < n; ++p) {
    places.push_back({"modulus_" + std::to_string(p + 1) + "_Pa", &law.terms[p].modulus_Pa});
    places.push_back({"exponent_" + std::to_string(p + 1), &law.terms[p].exponent});
  }
  return places;
}

std::vector<Parameter> places_in(HyperelasticLaw& law) {
  return std::visit([](auto& any) { return places_in(any); }, law);
}

}  // namespace

std::vector<std::pair<std::string, double>> parameters_of(const HyperelasticLaw& law) {
  HyperelasticLaw copy = law;
  std::vector<std::pair<std::string, double>> result;
  for (const Parameter& parameter : places_in(copy)) result.emplace_back(parameter.name, *parameter.value);
  return result;
}

HyperelasticLaw with_parameters(const HyperelasticLaw& law, std::span<const double> values) {
  HyperelasticLaw result = law;
  const std::vector<Parameter> places = places_in(result);
  assert(places.size() == values.size());
  for (std::size_t i = 0; i < places.size(); ++i) *places[i].value = values[i];
  return result;
}

}  // namespace menger::materials
