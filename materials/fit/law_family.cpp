#include "materials/fit/law_family.h"

#include <algorithm>
#include <cmath>

namespace menger::materials {

namespace {

using Numbers = std::span<const double>;

constexpr double largest_exponent = 25.0;

LawFamily neo_hookean_family() {
  LawFamily family;
  family.name = "neo_hookean";
  family.starts = {{}};
  family.basis = [](Numbers) { return std::vector<HyperelasticLaw>{NeoHookean{1.0}}; };
  family.compose = [](Numbers, Numbers moduli) { return NeoHookean{moduli[0]}; };
  return family;
}

LawFamily mooney_rivlin_family() {
  LawFamily family;
  family.name = "mooney_rivlin";
  family.starts = {{}};
  family.basis = [](Numbers) { return std::vector<HyperelasticLaw>{MooneyRivlin{1.0, 0.0}, MooneyRivlin{0.0, 1.0}}; };
  family.compose = [](Numbers, Numbers moduli) { return MooneyRivlin{moduli[0], moduli[1]}; };
  return family;
}

LawFamily yeoh_family() {
  LawFamily family;
  family.name = "yeoh";
  family.starts = {{}};
  family.basis = [](Numbers) {
    return std::vector<HyperelasticLaw>{Yeoh{1.0, 0.0, 0.0}, Yeoh{0.0, 1.0, 0.0}, Yeoh{0.0, 0.0, 1.0}};
  };
  family.compose = [](Numbers, Numbers moduli) { return Yeoh{moduli[0], moduli[1], moduli[2]}; };
  return family;
}

LawFamily gent_family(double largest_excess) {
  const auto locking_excess = [largest_excess](double shape) { return largest_excess * (1.0 + std::exp(shape)); };
  LawFamily family;
  family.name = "gent";
  family.shape_names = {"locking_excess"};
  family.lowest_shape = {-9.0};
  family.highest_shape = {14.0};
  family.starts = {{-3.0}, {0.0}, {3.0}};
  family.basis = [=](Numbers shape) { return std::vector<HyperelasticLaw>{Gent{1.0, locking_excess(shape[0])}}; };
  family.compose = [=](Numbers shape, Numbers moduli) { return Gent{moduli[0], locking_excess(shape[0])}; };
  return family;
}

LawFamily arruda_boyce_family() {
  LawFamily family;
  family.name = "arruda_boyce";
  family.shape_names = {"locking_stretch"};
  family.lowest_shape = {-3.0};
  family.highest_shape = {7.0};
  family.starts = {{0.0}, {0.7}, {1.5}};
  family.basis = [](Numbers shape) { return std::vector<HyperelasticLaw>{ArrudaBoyce{1.0, std::exp(shape[0])}}; };
  family.compose = [](Numbers shape, Numbers moduli) { return ArrudaBoyce{moduli[0], std::exp(shape[0])}; };
  return family;
}

/// Returns an exponent that is not zero. At zero the modulus for a given part of the shear modulus would be infinite.
double usable(double exponent) { return std::abs(exponent) > 1e-6 ? exponent : std::copysign(1e-6, exponent); }

/// Returns all choices of n of the given exponents.
std::vector<std::vector<double>> choices(Numbers exponents, std::size_t n) {
  if (n == 0) return {{}};
  std::vector<std::vector<double>> result;
  for (std::size_t first = 0; first + n <= exponents.size(); ++first) {
    for (std::vector<double>& rest : choices(exponents.subspan(first + 1), n - 1)) {
      rest.insert(rest.begin(), exponents[first]);
      result.push_back(std::move(rest));
    }
  }
  return result;
}

/// Stress of one term with a part of 1 Pa in the shear modulus, 2/a (l^(a-1) - l^(-a/2-1)), and its derivative with respect to a.
void ogden_column(double shape, const Stretches& at, std::span<double> stress, std::span<double> slope) {
  const double exponent = usable(shape);
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const double factor = 2.0 / (exponent * at.stretch[i]);
    const double along = std::exp(exponent * at.logarithm[i]);
    const double across = std::exp(-0.5 * exponent * at.logarithm[i]);
    stress[i] = factor * (along - across);
    slope[i] = factor * at.logarithm[i] * (along + 0.5 * across) - stress[i] / exponent;
  }
}

/// Exponents that are as dense as tensile curves tell terms apart: by less where they are small.
std::vector<double> exponents_of_grid() {
  std::vector<double> exponents;
  for (const double exponent : {0.7, 1.4, 2.1, 2.8, 3.5, 4.3, 5.2, 6.3, 7.6, 9.1, 10.9, 13.1, 15.7, 18.8, 22.5}) {
    exponents.push_back(exponent);
    exponents.push_back(-exponent);
  }
  std::sort(exponents.begin(), exponents.end());
  return exponents;
}

template <std::size_t n>
LawFamily ogden_family() {
  LawFamily family;
  family.name = "ogden" + std::to_string(n);
  for (std::size_t p = 1; p <= n; ++p) family.shape_names.push_back("exponent_" + std::to_string(p));
  family.lowest_shape.assign(n, -largest_exponent);
  family.highest_shape.assign(n, largest_exponent);
  family.starts = choices(std::vector{-20.0, -8.0, -3.0, 0.9, 2.5, 5.0, 12.0}, n);
  if (n > 1) family.grid = exponents_of_grid();
  family.column = ogden_column;
  family.basis = [](Numbers shape) {
    std::vector<HyperelasticLaw> laws;
    for (const double exponent : shape) laws.emplace_back(Ogden<1>{{OgdenTerm::from_shear_modulus(1.0, usable(exponent))}});
    return laws;
  };
  family.compose = [](Numbers shape, Numbers moduli) {
    Ogden<n> law;
    for (std::size_t p = 0; p < n; ++p) {
      law.terms[p] = OgdenTerm::from_shear_modulus(moduli[p], usable(shape[p]));
      law.terms[p].modulus_Pa += 0.0;  // no modulus of -0
    }
    return law;
  };
  return family;
}

LawFamily without_negative_moduli(LawFamily family) {
  family.name += "_non_negative";
  family.non_negative = true;
  return family;
}

}  // namespace

std::vector<LawFamily> law_families(double largest_excess) {
  return {neo_hookean_family(),
          mooney_rivlin_family(),
          without_negative_moduli(mooney_rivlin_family()),
          yeoh_family(),
          without_negative_moduli(yeoh_family()),
          ogden_family<1>(),
          ogden_family<2>(),
          without_negative_moduli(ogden_family<2>()),
          ogden_family<3>(),
          without_negative_moduli(ogden_family<3>()),
          gent_family(largest_excess),
          arruda_boyce_family()};
}

}  // namespace menger::materials
