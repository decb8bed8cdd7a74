#include "fem/load_cases/load_case_study.h"

#include <algorithm>
#include <variant>

#include "fem/inflation/inflation_study_words.h"
#include "io/text/number_text.h"
#include "materials/laws/law_file.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::fem {

std::string elements_text(const LoadCaseElements& elements) {
  std::string text = std::string("finite elements, ") + (elements.degree == 1 ? "Q1/P0" : "Q2/P1") + ", " +
                     std::to_string(elements.through_wall) + " through the wall";
  if (elements.largest_element_m) text += ", largest " + io::number_text(*elements.largest_element_m) + " m";
  return text;
}

std::string case_text(const CaseRequest& request, const StudyMaterial& material) {
  meshes::LoadCase nameless = request.load_case;
  nameless.name = "case";
  std::string text = meshes::load_case_text(nameless);
  for (const double fraction : request.pressure_fractions) text += "pressure_fraction = " + io::number_text(fraction) + "\n";
  if (nameless.pressures_Pa.empty()) {
    text += "states = " + std::to_string(request.state_count) + "\n";
    if (request.largest_pressure_Pa) text += "largest_pressure_Pa = " + io::number_text(*request.largest_pressure_Pa) + "\n";
  }
  text += elements_text(request.elements) + ", growth " + io::number_text(request.elements.growth) + "\n";
  text += materials::law_line(material.law) + "\n";
  text += std::string(volumetric_word(material.volume)) + " " +
          io::number_text(std::visit([](const auto& volume) { return volume.bulk_modulus_Pa; }, material.volume)) + "\n";
  text += "density_kg_m3 = " + io::number_text(material.density_kg_per_m3.value_or(0.0)) + "\n";
  return text;
}

}  // namespace menger::fem
