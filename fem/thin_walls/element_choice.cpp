#include "fem/thin_walls/element_choice.h"

#include <algorithm>
#include <string>

#include "io/text/number_text.h"

namespace menger::fem {
namespace {

/// 2, 3, 4.
int elements_per_span(Fidelity fidelity) { return 2 + static_cast<int>(fidelity); }

}  // namespace

const io::Words<Fidelity>& fidelity_words() {
  static const io::Words<Fidelity> words{{"draft", Fidelity::draft}, {"standard", Fidelity::standard}, {"fine", Fidelity::fine}};
  return words;
}

std::string_view to_string(Fidelity fidelity) {
  return std::ranges::find(fidelity_words(), fidelity, [](const auto& word) { return word.second; })->first;
}

std::string text_of(const ThinWallConstants& constants) {
  return "wall_penalty_ratio = " + io::number_text(constants.wall_penalty_ratio) +
         ", block_stiffness_ratio = " + io::number_text(constants.block_stiffness_ratio);
}

void describe(io::StudyVisitor& visitor, ElementChoice& choice, bool has_precision, std::string_view kind_key) {
  visitor.word({kind_key,
                "thin_wall: one layer through every wall, for hollow bodies; three_field: elements with mean dilatation, in any "
                "number of layers. Slower, and with one layer less accurate where walls bend."},
               choice.kind, {{"thin_wall", ElementKind::thin_wall}, {"three_field", ElementKind::three_field}});
  visitor.only_if(choice.kind == ElementKind::thin_wall, std::string(kind_key) + " = \"thin_wall\"", [&] {
    visitor.word(
        {"fidelity",
         "How finely walls are cut: the span between the walls of a cell into 2 (draft), 3 (standard) or 4 (fine) elements."},
        choice.fidelity, fidelity_words());
    if (!has_precision) return;
    visitor.word({"precision", "Numbers of the elements' forces; results differ by rounding."}, choice.precision,
                 {{"single", Precision::single_precision}, {"double", Precision::double_precision}});
  });
}

void set_elements(const ElementChoice& choice, meshes::HollowBodyOptions& options) {
  if (choice.kind != ElementKind::thin_wall) return;
  options.elements_through_wall = 1;
  options.elements_per_span = elements_per_span(choice.fidelity);
}

}  // namespace menger::fem
