#include "materials/laws/silicone_record.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <string_view>
#include <utility>

#include "io/text/joined_text.h"
#include "io/text/toml_document.h"
#include "materials/laws/law_file.h"

namespace menger::materials {

namespace {

std::string read_filled(const io::TomlTable& table, std::string_view key) {
  std::string text = table.text(key);
  if (text.empty()) throw table.error(key, "must not be empty");
  return text;
}

/// Refuses a result of menger fit, and a file that lacks several keys, with all of them. One missing key is refused where it is
/// read, with its line.
void require_record(const io::TomlTable& table) {
  constexpr std::string_view advice = ": see \"Your own silicone\" in materials/README.md";
  if (table.has("fits") && !table.has("name")) {
    throw io::InputError(table.file().string() + ": is a result of menger fit, not a record of a silicone" + std::string(advice));
  }
  std::vector<std::string> missing;
  const auto look_for = [&](const char* name, const std::vector<const char*>& keys) {
    if (table.has(name) && !table.is_table(name)) return;  // refused where it is read
    const io::TomlTable inner = table.table_or_empty(name);
    for (const char* key : keys)
      if (!inner.has(key)) missing.push_back(std::string(name) + "." + key);
  };
  if (!table.has("name")) missing.emplace_back("name");
  look_for("data_sheet", {"source", "density_kg_per_m3"});
  look_for("recommended", {"source", "smallest_stretch", "largest_stretch", "law"});
  if (missing.size() < 2) return;
  throw io::InputError(table.file().string() + ": a record of a silicone must have " + io::joined(missing) +
                       ", which are missing" + std::string(advice));
}

DataSheet read_data_sheet(const io::TomlTable& table) {
  DataSheet sheet;
  sheet.source = read_filled(table, "source");
  sheet.density_kg_per_m3 = table.number("density_kg_per_m3", io::positive());
  if (table.asks_for("shore_hardness")) sheet.shore_hardness = read_filled(table, "shore_hardness");
  sheet.modulus_100_percent_Pa = table.optional_number("modulus_100_percent_Pa", io::positive());
  sheet.tensile_strength_Pa = table.optional_number("tensile_strength_Pa", io::positive());
  sheet.elongation_at_break = table.optional_number("elongation_at_break", io::positive());
  return sheet;
}

SourcedLaw read_sourced_law(const io::TomlTable& table) {
  SourcedLaw result;
  result.law = read_law(table.table("law"));
  result.source = read_filled(table, "source");
  result.smallest_stretch = table.number("smallest_stretch", io::Range{.lowest = 0.0, .highest = 1.0, .lowest_excluded = true});
  result.largest_stretch = table.number("largest_stretch", io::Range{.lowest = 1.0, .lowest_excluded = true});
  return result;
}

LossData read_loss(const io::TomlTable& table) {
  const auto one_or_more = [&](const char* key) {
    return table.is_array(key) ? table.numbers(key, io::positive()) : std::vector{table.number(key, io::positive())};
  };
  const std::vector<double> tan_deltas = one_or_more("tan_delta");
  const std::vector<double> frequencies_Hz = one_or_more("frequency_Hz");
  if (tan_deltas.empty()) throw table.error("tan_delta", "must have a value");
  if (frequencies_Hz.size() != tan_deltas.size())
    throw table.error("frequency_Hz", "must have as many values as tan_delta: " + std::to_string(tan_deltas.size()));
  if (std::ranges::adjacent_find(frequencies_Hz, std::ranges::greater_equal{}) != frequencies_Hz.end())
    throw table.error("frequency_Hz", "must ascend");
  std::vector<LossPoint> points;
  for (std::size_t n = 0; n < tan_deltas.size(); ++n) points.push_back({tan_deltas[n], frequencies_Hz[n]});
  return loss_data(read_filled(table, "source"), std::move(points));
}

PublishedFriction read_friction(const io::TomlTable& table) {
  PublishedFriction friction{.source = read_filled(table, "source"),
                             .lowest = table.number("lowest", io::non_negative()),
                             .highest = table.number("highest", io::non_negative())};
  if (friction.highest < friction.lowest) throw table.error("highest", "must not be less than lowest");
  return friction;
}

}  // namespace

std::vector<LossPoint> LossData::points() const {
  std::vector<LossPoint> all = at_lower;
  all.push_back({tan_delta, frequency_Hz});
  return all;
}

LossData loss_data(std::string source, std::vector<LossPoint> points) {
  assert(!points.empty());
  const LossPoint last = points.back();
  points.pop_back();
  return {
      .source = std::move(source), .tan_delta = last.tan_delta, .frequency_Hz = last.frequency_Hz, .at_lower = std::move(points)};
}

std::pair<SourcedLaw, SourcedLaw> softest_and_stiffest(std::span<const SourcedLaw> laws) {
  assert(!laws.empty());
  const auto [softest, stiffest] =
      std::ranges::minmax_element(laws, {}, [](const SourcedLaw& one) { return shear_modulus_at_rest_Pa(one.law); });
  return {*softest, *stiffest};
}

SiliconeRecord read_silicone(const std::filesystem::path& file) {
  const io::TomlTable table = io::read_toml(file);
  require_record(table);
  SiliconeRecord record;
  record.name = read_filled(table, "name");
  record.data_sheet = read_data_sheet(table.table("data_sheet"));
  record.recommended = read_sourced_law(table.table("recommended"));
  for (const io::TomlTable& other : table.optional_tables("others")) record.others.push_back(read_sourced_law(other));
  if (table.asks_for("not_measured")) record.not_measured = table.texts("not_measured");
  if (const auto loss = table.optional_table("loss")) record.loss = read_loss(*loss);
  if (const auto friction = table.optional_table("friction")) record.friction = read_friction(*friction);
  const bool is_missing =
      std::find(record.not_measured.begin(), record.not_measured.end(), "damping") != record.not_measured.end();
  if (record.loss && is_missing) throw table.error("not_measured", "contains damping, but there is a table [loss]");
  table.finish();
  return record;
}

}  // namespace menger::materials
