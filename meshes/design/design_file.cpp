#include "meshes/design/design_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/study/study_reader.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/fractal.h"

namespace menger::meshes {

namespace {

using Layers = std::vector<std::vector<std::string>>;

/// The largest number of cells along an axis. Bodies have 3 to 81; a larger number is a typing error and would only fill the
/// memory.
constexpr int largest_side = 1000;

void require_equal_size(const io::TomlTable& table, const Layers& layers) {
  if (layers.empty() || layers[0].empty() || layers[0][0].empty()) throw table.error("layers", "must hold at least one cell");
  const std::size_t ny = layers[0].size();
  const std::size_t nx = layers[0][0].size();
  if (std::max({nx, ny, layers.size()}) > static_cast<std::size_t>(largest_side)) {
    throw table.error("layers", "must not have more than " + std::to_string(largest_side) + " cells along an axis");
  }
  for (std::size_t z = 0; z < layers.size(); ++z) {
    if (layers[z].size() != ny) {
      const std::string counts = std::to_string(layers[z].size()) + " rows where the first layer has " + std::to_string(ny);
      throw table.error("layers", "has " + counts, std::array{z});
    }
    for (std::size_t y = 0; y < ny; ++y) {
      if (layers[z][y].size() == nx) continue;
      throw table.error("layers", "must have " + std::to_string(nx) + " digits, as in the first row", std::array{z, y});
    }
  }
}

/// Makes the body of layers. The layers must have equal size and contain only digits of materials.
Polycube filled(const Layers& layers) {
  Polycube body(static_cast<int>(layers[0][0].size()), static_cast<int>(layers[0].size()), static_cast<int>(layers.size()));
  for (std::size_t z = 0; z < layers.size(); ++z) {
    for (std::size_t y = 0; y < layers[z].size(); ++y) {
      for (std::size_t x = 0; x < layers[z][y].size(); ++x)
        body.set({static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)}, static_cast<Material>(layers[z][y][x] - '0'));
    }
  }
  return body;
}

bool is_material(char digit) { return digit >= '0' && digit <= '0' + largest_material; }

bool are_cells(const Layers& layers) {
  if (layers.empty() || layers[0].empty() || layers[0][0].empty()) return false;
  return std::ranges::all_of(layers, [&](const auto& rows) {
    const auto fits = [&](const std::string& row) {
      return row.size() == layers[0][0].size() && std::ranges::all_of(row, is_material);
    };
    return rows.size() == layers[0].size() && std::ranges::all_of(rows, fits);
  });
}

Polycube body_of(const io::TomlTable& table, const Layers& layers) {
  require_equal_size(table, layers);
  for (std::size_t z = 0; z < layers.size(); ++z) {
    for (std::size_t y = 0; y < layers[z].size(); ++y) {
      if (!std::ranges::all_of(layers[z][y], is_material))
        throw table.error("layers", "must hold only 0, 1 and 2", std::array{z, y});
    }
  }
  Polycube body = filled(layers);
  if (body.count() == 0) throw table.error("layers", "the body is empty: at least one digit must be 1 or 2");
  return body;
}

Layers layers_of(const Polycube& body) {
  const std::string digits = body.digits();
  const auto nx = static_cast<std::size_t>(body.nx());
  Layers layers(static_cast<std::size_t>(body.nz()));
  std::size_t next = 0;
  for (auto& rows : layers) {
    for (int y = 0; y < body.ny(); ++y, next += nx) rows.push_back(digits.substr(next, nx));
  }
  return layers;
}

void describe_layers(io::StudyVisitor& visitor, Design& design) {
  constexpr const char* example = R"([["111", "111", "111"], ["101", "000", "101"]])";
  Layers layers = layers_of(design.body);
  visitor.text_rows(
      {"layers",
       "The body in layers from the ground up: each layer has rows of constant y, the first at the lowest y, and each row has a "
       "digit for every cell along x, the first at the lowest x. 0 is empty, 1 and 2 are the two materials. A hollow body is "
       "cast of one silicone; there they may be filled apart (chambers = \"per-phase\").",
       example},
      layers);
  if (const io::TomlTable* table = visitor.source())
    design.body = body_of(*table, layers);
  else if (are_cells(layers))
    design.body = filled(layers);
}

void describe_digits(io::StudyVisitor& visitor, Design& design) {
  std::vector<int> cells{3, 3, 3};
  std::string digits = design.body.digits();
  visitor.integers({"cells", "Cells along x, y and z."}, cells, io::within(1, largest_side), {.fewest = 3, .most = 3});
  visitor.text({"digits", "One digit for each cell: x varies fastest, then y, then z.", R"("111111111000000000000000000")"},
               digits);
  const io::TomlTable* table = visitor.source();
  if (table == nullptr) {
    const int count = cells.size() == 3 ? cells[0] * cells[1] * cells[2] : 0;
    if (count == static_cast<int>(digits.size()) && digits.find_first_not_of("012") == std::string::npos)
      design.body = Polycube::from_digits(cells[0], cells[1], cells[2], digits);
    return;
  }
  try {
    design.body = Polycube::from_digits(cells[0], cells[1], cells[2], digits);
  } catch (const std::invalid_argument& fault) {
    throw table->error("digits", fault.what());
  }
  if (design.body.count() == 0) throw table->error("digits", "the body is empty");
}

}  // namespace

void describe(io::StudyVisitor& visitor, Design& design) {
  visitor.text({"name", "Name of the design.", "\"robot\""}, design.name);
  visitor.number({"cell_edge_m", "Edge of a cell.", "0.01"}, design.cell_edge_m, io::positive());
  describe_layers(visitor, design);
}

void describe_design(io::StudyVisitor& visitor, Design& design, std::optional<std::filesystem::path>& file) {
  const bool is_drawn = design.body.count() > 0;
  const auto keep = [] {};
  std::filesystem::path named;
  const auto describe_file = [&] {
    visitor.path({"file", "A design file.", "\"design.toml\""}, named);
    if (visitor.source() == nullptr) return;
    file = named;
    design = visitor.source()->reading("file", [&] { return read_design(named); });
  };
  visitor.one_of({{"layers", is_drawn, keep, [&] { describe_layers(visitor, design); }},
                  {"digits", false, keep, [&] { describe_digits(visitor, design); }},
                  {"file", false, keep, describe_file}},
                 "give one of them");
  // A study may replace the cell edge of a design file. A design in the study has no other cell edge.
  const io::Key edge{.name = "cell_edge_m", .help = "Edge of a cell.", .example = file ? "" : "0.01", .may_be_elsewhere = true};
  visitor.number(edge, design.cell_edge_m, io::positive());
  if (design.name.empty()) design.name = "robot";
  visitor.text({"name", "Name of the design."}, design.name);
}

double body_length_m(const Design& design, int level) {
  return body_length_m(level, design.cell_edge_m, std::max({design.body.nx(), design.body.ny(), design.body.nz()}));
}

Design read_design(const std::filesystem::path& file) {
  Design design;
  io::read_described(io::read_toml(file), design);
  return design;
}

void write_design(const std::filesystem::path& file, const Design& design) { io::write_whole(file, design_text(design)); }

std::string design_text(const Design& design) {
  std::string text = "name = " + io::toml_quoted(design.name) + "\n";
  text += "cell_edge_m = " + io::number_text(design.cell_edge_m) + "\n";
  text += "# from the ground up; rows of constant y, x along the row; 0 empty, 1 and 2 materials\n";
  text += "layers = [\n";
  for (const std::vector<std::string>& rows : layers_of(design.body)) text += "  " + io::toml_value_text(rows) + ",\n";
  return text + "]\n";
}

}  // namespace menger::meshes
