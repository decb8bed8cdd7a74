#include "evolution/genome/decoder.h"

#include <array>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <vector>

#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "meshes/design/connectivity.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {

namespace {

constexpr char key_separator = '|';

meshes::CellIndex cell_at(std::size_t offset) {
  const int number = static_cast<int>(offset);
  return {number % 3, number / 3 % 3, number / 9};
}

/// Returns the largest connected component of the cells where the first output is positive, with material 2 where the second is.
meshes::Polycube grow(const Cppn& network, const ExpressionOptions& options) {
  const std::vector<GridValues> outputs = express(network, options);
  meshes::Polycube body(3, 3, 3);
  for (std::size_t cell = 0; cell < basal_cells; ++cell) {
    if (!(outputs[0][cell] > 0.0)) continue;
    const bool second = outputs.size() > 1 && outputs[1][cell] > 0.0;
    body.set(cell_at(cell), second ? meshes::Material{2} : meshes::Material{1});
  }
  return meshes::largest_component(body);
}

void require_level(const Phenotype& phenotype, int level) {
  if (level < 1) throw std::invalid_argument("level " + std::to_string(level) + " of a body: must be at least 1");
  if (phenotype.has_arrangements() && level > largest_arranged_level) {
    throw std::invalid_argument("level " + std::to_string(level) + " of a body with arrangements: must be at most " +
                                std::to_string(largest_arranged_level));
  }
}

std::size_t saturating_product(std::size_t a, std::size_t b) {
  constexpr std::size_t largest = std::numeric_limits<std::size_t>::max();
  return b != 0 && a > largest / b ? largest : a * b;
}

}  // namespace

void decode_network(const Genome& genome, std::size_t network, const DecoderOptions& options, Phenotype& phenotype) {
  assert(fits(genome, options.plan) && network < genome.networks.size());
  const std::array arrays{&phenotype.body, &phenotype.arrangement, &phenotype.arrangement_of_arrangements};
  *arrays[network] = grow(genome.networks[network], options.expression);
}

Phenotype decode(const Genome& genome, const DecoderOptions& options) {
  Phenotype phenotype;
  for (std::size_t network = 0; network < genome.networks.size(); ++network) decode_network(genome, network, options, phenotype);
  if (options.plan == BodyPlan::nonfractal_two_scales) {
    phenotype.arrangement_of_arrangements = meshes::Polycube(3, 3, 3);
    phenotype.arrangement_of_arrangements.set({1, 1, 1}, meshes::Material{1});
  }
  return phenotype;
}

int largest_level(BodyPlan plan) {
  switch (plan) {
    case BodyPlan::nonfractal:
      return largest_arranged_level;
    case BodyPlan::nonfractal_two_scales:
      return 2;
    case BodyPlan::fractal:
    case BodyPlan::single_actuator:
      break;
  }
  return std::numeric_limits<int>::max();
}

meshes::Polycube aggregate(const Phenotype& phenotype, int level) {
  require_level(phenotype, level);
  if (!phenotype.has_arrangements()) return meshes::fractal(phenotype.body, level);
  if (level == 1) return phenotype.body;
  const meshes::Polycube second = meshes::replace_cells(phenotype.arrangement, phenotype.body);
  return level == 2 ? second : meshes::replace_cells(phenotype.arrangement_of_arrangements, second);
}

std::size_t aggregate_cell_count(const Phenotype& phenotype, int level) {
  require_level(phenotype, level);
  const std::size_t basal = phenotype.body.count();
  std::size_t cells = basal;
  if (phenotype.has_arrangements()) {
    if (level > 1) cells = saturating_product(cells, phenotype.arrangement.count());
    if (level > 2) cells = saturating_product(cells, phenotype.arrangement_of_arrangements.count());
    return cells;
  }
  for (int above = 1; above < level; ++above) cells = saturating_product(cells, basal);
  return cells;
}

std::string phenotype_key(const Phenotype& phenotype) {
  std::string key = phenotype.body.digits();
  if (!phenotype.has_arrangements()) return key;
  (key += key_separator) += phenotype.arrangement.digits();
  (key += key_separator) += phenotype.arrangement_of_arrangements.digits();
  return key;
}

Phenotype phenotype_from_key(std::string_view key) {
  const auto refuse = [key] { return io::InputError("not the key of a phenotype: \"" + std::string(key) + "\""); };
  Phenotype phenotype;
  const std::array arrays{&phenotype.body, &phenotype.arrangement, &phenotype.arrangement_of_arrangements};
  const std::size_t count = key.size() == basal_cells ? 1 : arrays.size();
  if (key.size() != count * (basal_cells + 1) - 1) throw refuse();
  for (std::size_t index = 0; index < count; ++index) {
    const std::size_t begin = index * (basal_cells + 1);
    if (index > 0 && key[begin - 1] != key_separator) throw refuse();
    try {
      *arrays[index] = meshes::Polycube::from_digits(3, 3, 3, std::string(key.substr(begin, basal_cells)));
    } catch (const std::invalid_argument&) {
      throw refuse();
    }
  }
  return phenotype;
}

std::string phenotype_hash(const Phenotype& phenotype) { return io::content_hash(phenotype_key(phenotype)); }

}  // namespace menger::evolution
