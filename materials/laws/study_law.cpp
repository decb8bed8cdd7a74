#include "materials/laws/study_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/text/joined_text.h"
#include "io/text/near_miss.h"
#include "io/text/number_text.h"
#include "materials/laws/law_file.h"
#include "materials/laws/silicone_library.h"

namespace menger::materials {
namespace {

enum class Convention { ogden, abaqus };

using EveryKind = std::make_index_sequence<std::variant_size_v<HyperelasticLaw>>;

/// Returns the kinds of laws (their indices) by name.
template <std::size_t... kinds>
io::Words<std::size_t> law_words(std::index_sequence<kinds...>) {
  return {{std::variant_alternative_t<kinds, HyperelasticLaw>::name, kinds}...};
}

void describe_parameters(io::StudyVisitor& visitor, NeoHookean& law) {
  visitor.number({"shear_modulus_Pa", "Shear modulus at rest.", "5e4"}, law.shear_modulus_Pa, io::positive());
}

void describe_parameters(io::StudyVisitor& visitor, MooneyRivlin& law) {
  visitor.number({"c10_Pa", "Coefficient of I1 - 3.", "2e4"}, law.c10_Pa);
  visitor.number({"c01_Pa", "Coefficient of I2 - 3.", "5e3"}, law.c01_Pa);
}

void describe_parameters(io::StudyVisitor& visitor, Yeoh& law) {
  visitor.number({"c10_Pa", "Coefficient of I1 - 3.", "2e4"}, law.c10_Pa);
  visitor.number({"c20_Pa", "Coefficient of (I1 - 3)^2.", "100"}, law.c20_Pa);
  visitor.number({"c30_Pa", "Coefficient of (I1 - 3)^3.", "1"}, law.c30_Pa);
}

template <std::size_t n>
void describe_parameters(io::StudyVisitor& visitor, Ogden<n>& law) {
  constexpr std::array<std::string_view, 3> moduli_examples{"[5e4]", "[4e4, 100]", "[4e4, 100, -50]"};
  constexpr std::array<std::string_view, 3> exponent_examples{"[2]", "[2, 6]", "[2, 6, -2]"};
  std::vector<double> moduli_Pa;
  std::vector<double> exponents;
  for (const OgdenTerm& term : law.terms) {
    moduli_Pa.push_back(term.modulus_Pa);
    exponents.push_back(term.exponent);
  }
  Convention convention = Convention::ogden;
  visitor.word({"convention", "Meaning of the moduli. ogden: W = sum mu/alpha (...); abaqus: W = sum 2 mu/alpha^2 (...)."},
               convention, io::Words<Convention>{{"ogden", Convention::ogden}, {"abaqus", Convention::abaqus}});
  visitor.numbers({"moduli_Pa", "Moduli of the terms, as many as the name of the law says.", moduli_examples.at(n - 1)},
                  moduli_Pa, io::any_number(), {.fewest = n, .most = n});
  visitor.numbers({"exponents", "Exponents of the terms, as many, none of them 0.", exponent_examples.at(n - 1)}, exponents,
                  io::any_number(), {.fewest = n, .most = n});
  for (std::size_t p = 0; p < std::min({n, moduli_Pa.size(), exponents.size()}); ++p) {
    visitor.check(exponents[p] != 0.0, "exponents", "must not be 0", {p});
    law.terms[p] = convention == Convention::ogden ? OgdenTerm{moduli_Pa[p], exponents[p]}
                                                   : OgdenTerm::from_shear_modulus(moduli_Pa[p], exponents[p]);
  }
}

void describe_parameters(io::StudyVisitor& visitor, Gent& law) {
  visitor.number({"shear_modulus_Pa", "Shear modulus at rest.", "5e4"}, law.shear_modulus_Pa, io::positive());
  visitor.number({"locking_excess", "Jm, the value of I1 - 3 at which the chains are fully stretched.", "50"}, law.locking_excess,
                 io::positive());
}

void describe_parameters(io::StudyVisitor& visitor, ArrudaBoyce& law) {
  visitor.number({"shear_modulus_Pa", "Coefficient mu of the law. The shear modulus at rest is larger.", "5e4"},
                 law.shear_modulus_Pa, io::positive());
  visitor.number({"locking_stretch", "Stretch at which the chains are fully stretched.", "4"}, law.locking_stretch,
                 io::positive());
}

/// Describes the keys of one kind of law, which have a meaning only if the law is of this kind.
template <std::size_t kind>
void describe_kind(io::StudyVisitor& visitor, HyperelasticLaw& law, std::size_t chosen) {
  using Law = std::variant_alternative_t<kind, HyperelasticLaw>;
  Law own = std::holds_alternative<Law>(law) ? std::get<Law>(law) : Law{};
  visitor.only_if(kind == chosen, "name = \"" + std::string(Law::name) + "\"", [&] { describe_parameters(visitor, own); });
  if (kind == chosen) law = own;
}

template <std::size_t... kinds>
void describe_kinds(io::StudyVisitor& visitor, HyperelasticLaw& law, std::size_t chosen, std::index_sequence<kinds...>) {
  (describe_kind<kinds>(visitor, law, chosen), ...);
}

void take(const SourcedLaw& chosen, StudyLaw& law) {
  law.law = chosen.law;
  law.smallest_stretch = chosen.smallest_stretch;
  law.largest_stretch = chosen.largest_stretch;
  law.source = chosen.source;
}

std::vector<const SourcedLaw*> laws_with_name(const SiliconeRecord& record, const std::string& law_name) {
  std::vector<const SourcedLaw*> matches;
  for (const SourcedLaw& other : record.others) {
    if (name_of(other.law) == law_name) matches.push_back(&other);
  }
  return matches;
}

/// Sets the law of the silicone that a template names, so that the study agrees with its text.
void take_example(const std::string& silicone, StudyLaw& law) {
  if (const auto file = silicone_of_menger(silicone)) law = recommended_law(*file);
}

void describe_silicone(io::StudyVisitor& visitor, StudyLaw& law) {
  std::string silicone;
  std::string law_name(recommended_law_name);
  visitor.text({.name = "silicone",
                .help = "Name of a silicone of menger, or a file of a silicone.",
                .example = "\"dragon_skin_10\"",
                .earlier = "record"},
               silicone);
  visitor.text({"law_name", "Law in the silicone's record: the recommended law, or the name of another law."}, law_name);
  visitor.integer({"law_variant", "Number of the law, if the record has several laws with this name."}, law.variant,
                  io::at_least(1));
  const io::TomlTable* table = visitor.source();
  if (table == nullptr) return take_example(silicone, law);
  const std::string_view key = table->has("silicone") ? "silicone" : "record";
  law.file = silicone_file(*table, key);
  law.record = table->reading(key, [&] { return read_silicone(law.file); });
  take(law_in_record(*table, *law.record, law_name, law.variant), law);
  law.count = law_name == recommended_law_name ? 0 : laws_with_name(*law.record, law_name).size();
}

void describe_in_place(io::StudyVisitor& visitor, StudyLaw& law) {
  visitor.table({.name = "law", .help = "A hyperelastic law.", .earlier_text = "law_name"}, [&] { describe(visitor, law.law); });
  std::optional<double> largest;
  if (std::isfinite(law.largest_stretch)) largest = law.largest_stretch;
  visitor.number(
      {"smallest_stretch", "Smallest stretch at which the law was compared with a test. 1: not in compression; 0: not stated."},
      law.smallest_stretch, io::within(0.0, 1.0));
  visitor.optional_number({"largest_stretch", "Largest stretch at which the law was compared with a test.", "4"}, largest,
                          io::at_least(1.0));
  law.largest_stretch = largest.value_or(std::numeric_limits<double>::infinity());
}

}  // namespace

std::string StudyLaw::name() const {
  const std::string of_law(name_of(law));
  return record ? record->name + ", " + of_law : "inline " + of_law;
}

SourcedLaw law_in_record(const io::TomlTable& table, const SiliconeRecord& record, const std::string& law_name,
                         std::size_t law_variant) {
  if (law_name == recommended_law_name) {
    if (law_variant != 1) throw table.error("law_variant", "there is only one recommended law");
    return record.recommended;
  }
  const std::vector<const SourcedLaw*> matches = laws_with_name(record, law_name);
  if (matches.empty()) {
    std::vector<std::string> names{std::string(recommended_law_name)};
    for (const SourcedLaw& other : record.others) {
      if (std::ranges::find(names, name_of(other.law)) == names.end()) names.emplace_back(name_of(other.law));
    }
    const std::optional<std::string> meant = io::near_miss(law_name, names);
    throw table.error("law_name", "the record has " + io::joined(names) + (meant ? ", did you mean " + *meant + "?" : ""));
  }
  if (law_variant > matches.size())
    throw table.error("law_variant", "the record has " + std::to_string(matches.size()) + " of " + law_name);
  return *matches[law_variant - 1];
}

StudyLaw recommended_law(const std::filesystem::path& file) {
  StudyLaw law;
  law.file = file;
  law.record = read_silicone(file);
  take(law.record->recommended, law);
  return law;
}

void describe(io::StudyVisitor& visitor, HyperelasticLaw& law) {
  std::size_t kind = law.index();
  visitor.word({"name", "Kind of law.", "\"neo_hookean\""}, kind, law_words(EveryKind()));
  describe_kinds(visitor, law, kind, EveryKind());
  const double modulus_Pa = visitor.source() == nullptr ? 1.0 : shear_modulus_at_rest_Pa(law);
  visitor.check(modulus_Pa > 0.0, "name", "the shear modulus at rest is " + io::number_text(modulus_Pa) + " Pa, it must be > 0");
}

void describe(io::StudyVisitor& visitor, StudyLaw& law) {
  const bool has_law = shear_modulus_at_rest_Pa(law.law) > 0.0;
  const auto keep = [] {};
  std::vector<io::Alternative> alternatives{
      {"silicone", false, keep, [&] { describe_silicone(visitor, law); }, "record"},
      {"law", has_law, [&] { law = StudyLaw{}; }, [&] { describe_in_place(visitor, law); }}};
  visitor.one_of(alternatives, "give a silicone or a law");
}

}  // namespace menger::materials
