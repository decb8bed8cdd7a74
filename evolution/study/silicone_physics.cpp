#include "evolution/study/silicone_physics.h"

#include <string>
#include <vector>

#include "fem/walk/walk_silicone_file.h"
#include "io/study/study_text.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::evolution {

bool SiliconePhysics::operator==(const SiliconePhysics& other) const {
  return module == other.module && elements == other.elements && elements_through_wall == other.elements_through_wall &&
         step_safety == other.step_safety && io::described_text(silicone) == io::described_text(other.silicone);
}

void describe_elements(io::StudyVisitor& visitor, fem::ElementChoice& elements, int& elements_through_wall) {
  fem::describe(visitor, elements, true);
  visitor.only_if(elements.kind == fem::ElementKind::three_field, "kind = \"three_field\"", [&] {
    visitor.integer({"elements_through_wall", "Elements through a wall."}, elements_through_wall, io::within(1, 16));
  });
}

void describe_step_safety(io::StudyVisitor& visitor, double& step_safety) {
  visitor.number({"step_safety", "Time step as a fraction of the stable one."}, step_safety,
                 {.lowest = 0.0, .highest = 1.0, .lowest_excluded = true});
}

void describe_module(io::StudyVisitor& visitor, HollowModule& module) {
  visitor.number({"wall_thickness_m", "Thickness of every outer wall, and of walls between chambers."}, module.wall_thickness_m,
                 io::positive());
  visitor.word(
      {"chambers", "Cells that share one chamber: all cells of a module, or each connected region of cells of one phase."},
      module.chambers, meshes::chamber_layout_words());
}

void state_what_the_record_has(fem::WalkSilicone& silicone) {
  std::vector<std::string> notes;
  (void)fem::material_of(silicone, fem::DampingModel::maxwell, notes);
}

}  // namespace menger::evolution
