#include "materials/laws/law_file.h"

#include <array>
#include <vector>

#include "io/text/number_text.h"
#include "materials/laws/law_parameters.h"

namespace menger::materials {

namespace {

enum class LawName { neo_hookean, mooney_rivlin, yeoh, ogden1, ogden2, ogden3, gent, arruda_boyce };
enum class Convention { ogden, abaqus };

const io::Words<LawName>& law_names() {
  static const io::Words<LawName> names{{"neo_hookean", LawName::neo_hookean},
                                        {"mooney_rivlin", LawName::mooney_rivlin},
                                        {"yeoh", LawName::yeoh},
                                        {"ogden1", LawName::ogden1},
                                        {"ogden2", LawName::ogden2},
                                        {"ogden3", LawName::ogden3},
                                        {"gent", LawName::gent},
                                        {"arruda_boyce", LawName::arruda_boyce}};
  return names;
}

template <std::size_t n>
Ogden<n> read_ogden(const io::TomlTable& table) {
  const std::vector<double> moduli = table.numbers("moduli_Pa");
  const std::vector<double> exponents = table.numbers("exponents");
  const io::Words<Convention> conventions{{"ogden", Convention::ogden}, {"abaqus", Convention::abaqus}};
  const Convention convention = table.word_or("convention", Convention::ogden, conventions);
  const std::string demand = "must hold " + std::to_string(n) + (n == 1 ? " number" : " numbers");
  if (moduli.size() != n) throw table.error("moduli_Pa", demand);
  if (exponents.size() != n) throw table.error("exponents", demand);
  Ogden<n> law;
  for (std::size_t p = 0; p < n; ++p) {
    if (exponents[p] == 0.0) throw table.error("exponents", "must not be 0", std::array{p});
    law.terms[p] = convention == Convention::ogden ? OgdenTerm{moduli[p], exponents[p]}
                                                   : OgdenTerm::from_shear_modulus(moduli[p], exponents[p]);
  }
  return law;
}

HyperelasticLaw read_parameters(const io::TomlTable& table, LawName name) {
  switch (name) {
    case LawName::neo_hookean:
      return NeoHookean{table.number("shear_modulus_Pa", io::positive())};
    case LawName::mooney_rivlin:
      return MooneyRivlin{table.number("c10_Pa"), table.number("c01_Pa")};
    case LawName::yeoh:
      return Yeoh{table.number("c10_Pa"), table.number("c20_Pa"), table.number("c30_Pa")};
    case LawName::ogden1:
      return read_ogden<1>(table);
    case LawName::ogden2:
      return read_ogden<2>(table);
    case LawName::ogden3:
      return read_ogden<3>(table);
    case LawName::gent:
      return Gent{table.number("shear_modulus_Pa", io::positive()), table.number("locking_excess", io::positive())};
    case LawName::arruda_boyce:
      break;
  }
  return ArrudaBoyce{table.number("shear_modulus_Pa", io::positive()), table.number("locking_stretch", io::positive())};
}

template <class Law>
std::string lines_of(const Law& law) {
  std::string text;
  for (const auto& [name, value] : parameters_of(law)) text += name + " = " + io::number_text(value) + "\n";
  return text;
}

template <std::size_t n>
std::string lines_of(const Ogden<n>& law) {
  std::string moduli;
  std::string exponents;
  for (const OgdenTerm& term : law.terms) {
    const std::string separator = moduli.empty() ? "" : ", ";
    moduli += separator + io::number_text(term.modulus_Pa);
    exponents += separator + io::number_text(term.exponent);
  }
  return "convention = \"ogden\"\nmoduli_Pa = [" + moduli + "]\nexponents = [" + exponents + "]\n";
}

}  // namespace

HyperelasticLaw read_law(const io::TomlTable& table) {
  const HyperelasticLaw law = read_parameters(table, table.word("name", law_names()));
  const double modulus_Pa = shear_modulus_at_rest_Pa(law);
  if (!(modulus_Pa > 0.0)) {
    throw table.error("name", "the shear modulus at rest is " + io::number_text(modulus_Pa) + " Pa, it must be > 0");
  }
  return law;
}

std::string law_text(const HyperelasticLaw& law) {
  const std::string name = "name = " + io::toml_quoted(name_of(law)) + "\n";
  return name + std::visit([](const auto& any) { return lines_of(any); }, law);
}

std::string law_line(const HyperelasticLaw& law) {
  std::string text = law_text(law);
  text.pop_back();  // the end of the last line
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) text.replace(at, 1, ", ");
  return text;
}

}  // namespace menger::materials
