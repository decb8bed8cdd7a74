#include "meshes/design/design_file.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::meshes {

namespace {

using Layers = std::vector<std::vector<std::string>>;

/// Largest number of cells along an axis. Bodies have 3 to 81; more is a slip of the pen and would only fill the memory.
constexpr std::size_t largest_side = 1000;

void require_equal_size(const io::TomlTable& table, const Layers& layers) {
  if (layers.empty() || layers[0].empty() || layers[0][0].empty()) throw table.error("layers", "must hold at least one cell");
  const std::size_t ny = layers[0].size();
  const std::size_t nx = layers[0][0].size();
  if (nx > largest_side || ny > largest_side || layers.size() > largest_side) {
    throw table.error("layers", "must not have more than " + std::to_string(largest_side) + " cells along an axis");
  }
  for (std::size_t z = 0; z < layers.size(); ++z) {
    if (layers[z].size() != ny) {
      const std::string counts = std::to_string(layers[z].size()) + " rows where the first layer has " + std::to_string(ny);
      throw table.error("layers", "has " + counts, std::array{z});
    }
    for (std::size_t y = 0; y < ny; ++y) {
      if (layers[z][y].size() == nx) continue;
      throw table.error("layers", "must have " + std::to_string(nx) + " digits as the first row has", std::array{z, y});
    }
  }
}

Polycube read_layers(const io::TomlTable& table) {
  const Layers layers = table.text_rows("layers");
  require_equal_size(table, layers);
  Polycube body(static_cast<int>(layers[0][0].size()), static_cast<int>(layers[0].size()), static_cast<int>(layers.size()));
  for (std::size_t z = 0; z < layers.size(); ++z) {
    for (std::size_t y = 0; y < layers[z].size(); ++y) {
      for (std::size_t x = 0; x < layers[z][y].size(); ++x) {
        const char digit = layers[z][y][x];
        if (digit < '0' || digit > '0' + largest_material)
          throw table.error("layers", "must hold only 0, 1 and 2", std::array{z, y});
        body.set({static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)}, static_cast<Material>(digit - '0'));
      }
    }
  }
  if (body.count() == 0) throw table.error("layers", "the body is empty: at least one digit must be 1 or 2");
  return body;
}

}  // namespace

Design read_design(const std::filesystem::path& file) {
  const io::TomlTable table = io::read_toml(file);
  Design design;
  design.name = table.text("name");
  design.cell_edge_m = table.number("cell_edge_m", io::positive());
  design.body = read_layers(table);
  table.finish();
  return design;
}

Design read_drawn_design(const io::TomlTable& table) {
  Design design;
  design.name = table.text_or("name", "robot");
  std::array<int, 3> cells{3, 3, 3};
  if (table.has("cells")) {
    const std::vector<double> sizes = table.numbers("cells", io::within(1, 1000));
    if (sizes.size() != 3) throw table.error("cells", "must be three integers, not " + std::to_string(sizes.size()));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (sizes[axis] != std::floor(sizes[axis])) throw table.error("cells", "must be an integer", std::array{axis});
      cells[axis] = static_cast<int>(sizes[axis]);
    }
  }
  const std::string digits = table.text("digits");
  try {
    design.body = Polycube::from_digits(cells[0], cells[1], cells[2], digits);
  } catch (const std::invalid_argument& fault) {
    throw table.error("digits", fault.what());
  }
  return design;
}

void write_design(const std::filesystem::path& file, const Design& design) { io::write_whole(file, design_text(design)); }

std::string design_text(const Design& design) {
  const Polycube& body = design.body;
  const std::string digits = body.digits();
  const auto nx = static_cast<std::size_t>(body.nx());
  std::string text = "name = " + io::toml_quoted(design.name) + "\n";
  text += "cell_edge_m = " + io::number_text(design.cell_edge_m) + "\n";
  text += "# from the ground up; rows of constant y, x along the row; 0 empty, 1 and 2 materials\n";
  text += "layers = [\n";
  std::size_t next = 0;
  for (int z = 0; z < body.nz(); ++z) {
    text += "  [";
    for (int y = 0; y < body.ny(); ++y, next += nx)
      text.append(y == 0 ? "" : ", ").append(io::toml_quoted(digits.substr(next, nx)));
    text += "],\n";
  }
  return text + "]\n";
}

}  // namespace menger::meshes
