#include "evolution/study.h"

#include <limits>

#include "io/number_text.h"
#include "io/toml_document.h"
#include "meshes/reference_shapes.h"
#include "voxel/physics_file.h"
#include "voxel/scene.h"

namespace menger::evolution {

namespace {

void add_line(std::string& text, std::string_view key, std::string_view value) {
  text.append(key).append(" = ").append(value).append("\n");
}
void add_number(std::string& text, std::string_view key, double value) { add_line(text, key, io::number_text(value)); }
void add_count(std::string& text, std::string_view key, std::uint64_t value) { add_line(text, key, std::to_string(value)); }
void add_word(std::string& text, std::string_view key, std::string_view word) { add_line(text, key, io::toml_quoted(word)); }

std::string levels_text(const std::vector<int>& levels) {
  std::string text = "[";
  for (const int level : levels) text.append(text.size() > 1 ? ", " : "").append(std::to_string(level));
  return text + "]";
}

void add_genome(std::string& text, const OffspringOptions& options) {
  text += "[genome]\n";
  add_word(text, "encoding", to_string(options.decoder.plan));
  add_word(text, "activations", to_string(options.variation.activations));
  add_word(text, "output_function", to_string(options.variation.output_function));
  add_word(text, "expression", to_string(options.decoder.expression.expression));
  add_word(text, "axes", to_string(options.decoder.expression.axes));
  add_count(text, "largest_tries", options.largest_tries);
}

void add_body(std::string& text, const SearchPlan& plan) {
  const ConstraintOptions& constraints = plan.offspring.constraints;
  text += "[body]\n";
  add_number(text, "cell_edge_m", plan.cell_edge_m);
  add_line(text, "levels", levels_text(plan.levels()));
  add_count(text, "smallest_body_cells", constraints.smallest_body);
  add_count(text, "smallest_arranged_body_cells", constraints.smallest_arranged_body);
  add_word(text, "disconnected", to_string(constraints.disconnected));
}

}  // namespace

std::string identity_text(const Study& study) {
  const SearchPlan& plan = study.search;
  std::string text;
  add_count(text, "seed", plan.seed);
  text += "[population]\n";
  add_line(text, "survivors", std::to_string(plan.survivors));
  add_line(text, "mutants", std::to_string(plan.mutants));
  add_line(text, "newcomers", std::to_string(plan.newcomers));
  add_genome(text, plan.offspring);
  add_body(text, plan);
  text += "[evaluation]\n";
  add_number(text, "duration_s", study.duration_s);
  add_word(text, "objective", to_string(plan.objective));
  add_word(text, "duplicates", to_string(plan.duplicates));
  add_line(text, "pruning", plan.pruning ? "true" : "false");
  text += "[materials]\npoissons_ratio = 0\n";
  return text + voxel::physics_text(study.physics);
}

std::string resolved_text(const Study& study) {
  return "generations = " + std::to_string(study.search.generations) + "\n" + identity_text(study);
}

std::vector<std::string> study_notes(const Study& study) {
  std::vector<std::string> notes{
      "Poisson's ratio is 0: the paper states 0.5, but its released files switch volume effects off, so that 0 was simulated"};
  if (study.search.offspring.constraints.disconnected == DisconnectedPolicy::allow) {
    notes.emplace_back("bodies that fall apart at some level are simulated in pieces");
  }
  return notes;
}

std::size_t estimated_memory_bytes(const Study& study, int threads) {
  constexpr auto largest = std::numeric_limits<std::size_t>::max();
  const std::size_t one = voxel::estimated_memory_bytes(meshes::full_cube(3), study.search.levels().back());
  const auto count = static_cast<std::size_t>(threads);
  return one > largest / count ? largest : one * count;
}

}  // namespace menger::evolution
