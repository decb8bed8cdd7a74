#include "evolution/report/refusal_table.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "evolution/study/walk_evaluator.h"

namespace menger::evolution {
namespace {

/// Returns a reason with one mark in place of each number.
std::string without_numbers(const std::string& reason) {
  std::string kind;
  for (const char letter : reason) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(letter)) != 0;
    if (!is_digit) kind += letter;
    if (is_digit && !kind.ends_with('#')) kind += '#';
  }
  return kind;
}

}  // namespace

Refusals refusals_of(const RunView& run) {
  Refusals all;
  std::set<std::string> seen;
  const int last_generation = run.archive->last_generation().value_or(-1);
  for (std::uint64_t id = 0; id < run.archive->next_id(); ++id) {
    const Individual individual = run.archive->individual(id);
    if (individual.generation > last_generation) break;
    Phenotype simulated = as_simulated(run.plan, individual.phenotype);
    if (!seen.insert(phenotype_key(simulated)).second) continue;
    const KnownResults results = archived_results_or_half(run, simulated);
    if (results.empty()) continue;
    ++all.bodies;
    // Which bodies are refused does not depend on the scenario.
    if (auto reason = refusal_of(results.begin()->second))
      all.refused.push_back({id, individual.generation, std::move(simulated), *std::move(reason)});
  }
  return all;
}

io::CsvTable refusal_table(const Refusals& refusals) {
  io::CsvTable table({"individual", "generation", "cells", "phenotype", "reason"});
  for (const RefusedBody& body : refusals.refused)
    table.add_row(body.individual, body.generation, std::uint64_t{body.simulated.body.count()}, phenotype_key(body.simulated),
                  body.reason);
  return table;
}

std::string refusal_text(const Refusals& refusals) {
  const std::size_t count = refusals.refused.size();
  if (count == 0) return "";
  std::map<std::string, std::size_t> counts;
  for (const RefusedBody& body : refusals.refused) ++counts[without_numbers(body.reason)];
  const auto most = std::ranges::max_element(counts, {}, [](const auto& kind) { return kind.second; });
  const auto example =
      std::ranges::find(refusals.refused, most->first, [](const RefusedBody& body) { return without_numbers(body.reason); });
  std::string text = "finite elements refused " + std::to_string(count) + " of " + std::to_string(refusals.bodies) + " bodies";
  if (most->second < count) text += ", " + std::to_string(most->second) + " of them";
  if (most->second > 1) text += " for reasons like this";
  return text + ": " + example->reason;
}

}  // namespace menger::evolution
