#pragma once

#include <array>
#include <string>
#include <string_view>

#include "fem/inflation/inflation_study.h"
#include "io/text/toml_document.h"

namespace menger::fem {

/// The words of a study file for the choices in it.
inline const io::Words<SupportKind>& support_words() {
  static const io::Words<SupportKind> words{{"ground_guided", SupportKind::ground_guided},
                                            {"ground_held", SupportKind::ground_held},
                                            {"resting", SupportKind::resting},
                                            {"free", SupportKind::free},
                                            {"labels", SupportKind::labels}};
  return words;
}

inline const io::Words<Formulation>& formulation_words() {
  static const io::Words<Formulation> words{{"three_field", Formulation::three_field},
                                            {"displacement", Formulation::displacement}};
  return words;
}

inline const io::Words<LinearMethod>& linear_words() {
  static const io::Words<LinearMethod> words{
      {"automatic", LinearMethod::automatic}, {"direct", LinearMethod::direct}, {"iterative", LinearMethod::iterative}};
  return words;
}

/// The words for whether the faces slide on a plate.
inline const io::Words<bool>& grip_words() {
  static const io::Words<bool> words{{"bonded", false}, {"sliding", true}};
  return words;
}

/// The words for volumetric energies, by their index in VolumetricLaw.
inline const io::Words<std::size_t>& volumetric_words() {
  static const io::Words<std::size_t> words{{"quadratic", 0}, {"log_squared", 1}, {"simo_taylor", 2}};
  return words;
}

inline std::string_view volumetric_word(const VolumetricLaw& law) { return volumetric_words()[law.index()].first; }

inline double bulk_modulus_of(const VolumetricLaw& law) {
  return std::visit([](const auto& any) { return any.bulk_modulus_Pa; }, law);
}

/// The words for axes, by their number.
inline const io::Words<std::size_t>& axis_words() {
  static const io::Words<std::size_t> words{{"x", 0}, {"y", 1}, {"z", 2}};
  return words;
}

/// Returns the key under which a study gives the values of a drive.
inline std::string_view drive_key(DriveKind kind) {
  constexpr std::array<std::string_view, 3> keys{"pressure_Pa", "volume_ratio", "gas_amount"};
  return keys[static_cast<std::size_t>(kind)];
}

}  // namespace menger::fem
