#include "evolution/page/body_frames.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "evolution/posture/frame_grid.h"
#include "evolution/posture/near_end.h"
#include "io/process/child_reading.h"
#include "io/text/input_error.h"
#include "voxel/picture/vtk_output.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Place = std::array<double, 3>;
using FaceIds = std::array<vtkIdType, 4>;

/// A face as quadrilaterals: one of its corners, or four where it has a middle.
std::vector<FaceIds> quadrilaterals(vtkIdList& ids) {
  const auto id = [&](vtkIdType n) { return ids.GetId(n); };
  switch (ids.GetNumberOfIds()) {
    case 3:
    case 6:
      return {{id(0), id(1), id(2), id(2)}};
    case 4:
    case 8:
      return {{id(0), id(1), id(2), id(3)}};
    case 9:
      return {
          {id(0), id(4), id(8), id(7)}, {id(4), id(1), id(5), id(8)}, {id(8), id(5), id(2), id(6)}, {id(7), id(8), id(6), id(3)}};
    default:
      return {};
  }
}

/// What tells two faces apart: their sorted corners.
FaceIds key_of(vtkIdList& ids) {
  FaceIds key{-1, -1, -1, -1};
  const bool is_triangle = ids.GetNumberOfIds() == 3 || ids.GetNumberOfIds() == 6;
  for (vtkIdType n = 0; n < (is_triangle ? 3 : std::min<vtkIdType>(4, ids.GetNumberOfIds())); ++n)
    key.at(static_cast<std::size_t>(n)) = ids.GetId(n);
  std::ranges::sort(key);
  return key;
}

/// The surface of a grid.
struct GridSurface {
  std::vector<FaceIds> faces;
  std::vector<vtkIdType> cells;          ///< per face, the cell that it belongs to
  std::vector<vtkIdType> chamber_cells;  ///< cells of the grid that are walls of chambers
  std::vector<std::size_t> chambers;     ///< the chamber of each of these
};

/// A face that belongs to one volume only, so far.
struct OpenFace {
  std::vector<FaceIds> parts;
  vtkIdType cell = 0;
  int count = 0;
};

GridSurface whole_surface(vtkUnstructuredGrid& grid) {
  GridSurface surface;
  vtkDataArray* chambers = grid.GetCellData()->GetArray("chamber");
  std::map<FaceIds, OpenFace> open;
  std::vector<FaceIds> walls;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    vtkCell* cell = grid.GetCell(c);
    if (cell->GetCellDimension() == 3) {
      for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
        vtkIdList& ids = *cell->GetFace(f)->GetPointIds();
        OpenFace& face = open[key_of(ids)];
        if (++face.count == 1) face = {quadrilaterals(ids), c, 1};
      }
    } else if (cell->GetCellDimension() == 2) {
      if (chambers != nullptr && chambers->GetComponent(c, 0) >= 0.0) {
        surface.chamber_cells.push_back(c);
        surface.chambers.push_back(static_cast<std::size_t>(chambers->GetComponent(c, 0)));
        walls.push_back(key_of(*cell->GetPointIds()));
        continue;
      }
      for (const FaceIds& part : quadrilaterals(*cell->GetPointIds())) {
        surface.faces.push_back(part);
        surface.cells.push_back(c);
      }
    }
  }
  for (const FaceIds& wall : walls) open.erase(wall);
  for (const auto& [key, face] : open) {
    if (face.count != 1) continue;
    for (const FaceIds& part : face.parts) {
      surface.faces.push_back(part);
      surface.cells.push_back(face.cell);
    }
  }
  return surface;
}

Place point_of(vtkUnstructuredGrid& grid, vtkIdType id) {
  Place place{};
  grid.GetPoint(id, place.data());
  return place;
}

/// The box around a piece of a surface.
struct PieceBox {
  Place low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Place high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  void add(const Place& place) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
    }
  }
  [[nodiscard]] double diagonal() const { return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
  [[nodiscard]] bool is_inside(const PieceBox& other) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (low[axis] <= other.low[axis] || high[axis] >= other.high[axis]) return false;
    return true;
  }
};

/// Removes the pieces of a surface that lie within another piece: walls of closed chambers.
void remove_inner_pieces(vtkUnstructuredGrid& grid, GridSurface& surface) {
  std::vector<vtkIdType> root(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  std::iota(root.begin(), root.end(), vtkIdType{0});
  const auto find = [&](vtkIdType id) {
    while (root[static_cast<std::size_t>(id)] != id) {
      root[static_cast<std::size_t>(id)] = root[static_cast<std::size_t>(root[static_cast<std::size_t>(id)])];
      id = root[static_cast<std::size_t>(id)];
    }
    return id;
  };
  for (const FaceIds& face : surface.faces)
    for (const vtkIdType id : face) root[static_cast<std::size_t>(find(id))] = find(face[0]);
  std::map<vtkIdType, PieceBox> boxes;
  for (const FaceIds& face : surface.faces)
    for (const vtkIdType id : face) boxes[find(id)].add(point_of(grid, id));
  const auto largest = std::ranges::max_element(boxes, {}, [](const auto& piece) { return piece.second.diagonal(); });
  if (largest == boxes.end()) return;
  GridSurface outer{.faces = {}, .cells = {}, .chamber_cells = surface.chamber_cells, .chambers = surface.chambers};
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (boxes.at(find(surface.faces[f][0])).is_inside(largest->second)) continue;
    outer.faces.push_back(surface.faces[f]);
    outer.cells.push_back(surface.cells[f]);
  }
  surface = std::move(outer);
}

/// Whether the points of two files of one mesh are the same although it has moved: displacements are then to be added.
bool is_undeformed(vtkUnstructuredGrid& first, vtkUnstructuredGrid& last) {
  vtkDataArray* moved = last.GetPointData()->GetArray("displacement_m");
  if (moved == nullptr || first.GetNumberOfPoints() != last.GetNumberOfPoints()) return false;
  bool has_moved = false;
  for (vtkIdType n = 0; n < last.GetNumberOfPoints(); ++n) {
    if (point_of(first, n) != point_of(last, n)) return false;
    for (int axis = 0; axis < 3; ++axis) has_moved = has_moved || moved->GetComponent(n, axis) != 0.0;
  }
  return has_moved;
}

Place middle_of(vtkUnstructuredGrid& grid, const FaceIds& face) {
  Place middle{};
  for (const vtkIdType id : face) {
    const Place place = point_of(grid, id);
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += 0.25 * place[axis];
  }
  return middle;
}

constexpr double most_cells = 1e6;  ///< along an axis; no body has more

/// The digit of the cell behind a face: the cell whose middle is nearest to a point a quarter of a cell inside, along the normal.
int digit_behind(vtkUnstructuredGrid& rest, const FaceIds& face, const ManifestBody& body, const Place& lowest) {
  const Place a = point_of(rest, face[0]);
  const Place b = point_of(rest, face[1]);
  const Place c = point_of(rest, face[2]);
  const Place u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Place v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  Place normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (!(length > 0.0)) return 0;
  const Place middle = middle_of(rest, face);
  for (const double side : {-0.25, 0.25}) {  // outward normals are usual, not certain
    Place cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double inside = middle[axis] + side * body.cell_edge_m * normal[axis] / length - lowest[axis];
      cell[axis] = std::floor(inside / body.cell_edge_m);
    }
    if (!std::ranges::all_of(cell, [](double number) { return number >= 0.0 && number < most_cells; })) continue;
    const auto x = static_cast<std::size_t>(cell[0]), y = static_cast<std::size_t>(cell[1]),
               z = static_cast<std::size_t>(cell[2]);
    if (z >= body.layers.size() || y >= body.layers[z].size() || x >= body.layers[z][y].size()) continue;
    if (const char digit = body.layers[z][y][x]; digit == '1' || digit == '2') return digit - '0';
  }
  return 0;
}

/// The lowest corner of the grid of cells: a body may leave its first cells empty.
Place lowest_corner(vtkUnstructuredGrid& rest, const ManifestBody& body) {
  std::array<std::size_t, 3> first{std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max(),
                                   std::numeric_limits<std::size_t>::max()};
  for (std::size_t z = 0; z < body.layers.size(); ++z) {
    for (std::size_t y = 0; y < body.layers[z].size(); ++y) {
      for (std::size_t x = 0; x < body.layers[z][y].size(); ++x)
        if (body.layers[z][y][x] != '0') first = {std::min(first[0], x), std::min(first[1], y), std::min(first[2], z)};
    }
  }
  std::array<double, 6> bounds{};
  rest.GetBounds(bounds.data());
  Place lowest{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    lowest[axis] = bounds.at(2 * axis) - body.cell_edge_m * static_cast<double>(first[axis] > 1000 ? 0 : first[axis]);
  return lowest;
}

/// The materials of the faces; empty if all are alike.
std::vector<std::uint8_t> materials_of(vtkUnstructuredGrid& rest, const GridSurface& surface,
                                       const std::optional<ManifestBody>& body) {
  std::vector<std::uint8_t> materials;
  if (vtkDataArray* material = rest.GetCellData()->GetArray("material")) {
    for (const vtkIdType cell : surface.cells) materials.push_back(static_cast<std::uint8_t>(material->GetComponent(cell, 0)));
  } else if (body) {
    const Place lowest = lowest_corner(rest, *body);
    for (const FaceIds& face : surface.faces)
      materials.push_back(static_cast<std::uint8_t>(digit_behind(rest, face, *body, lowest)));
  }
  const bool has_both = std::ranges::find(materials, 1) != materials.end() && std::ranges::find(materials, 2) != materials.end();
  return has_both ? materials : std::vector<std::uint8_t>();
}

/// The pressures of a file: of its chambers if it has their walls, otherwise of its only plenum or state.
std::vector<double> pressures_in(vtkUnstructuredGrid& grid, const GridSurface& surface, std::size_t chambers) {
  if (chambers > 0) {
    vtkDataArray* pressure = grid.GetCellData()->GetArray("chamber_pressure_Pa");
    if (pressure == nullptr) return {};
    std::vector<double> pressures_Pa(chambers, 0.0);
    for (std::size_t n = 0; n < surface.chamber_cells.size(); ++n)
      pressures_Pa[surface.chambers[n]] = pressure->GetComponent(surface.chamber_cells[n], 0);
    return pressures_Pa;
  }
  for (const char* name : {"plenum_pressures_Pa", "pressure_Pa"}) {
    vtkDataArray* pressure = grid.GetFieldData()->GetArray(name);
    if (pressure != nullptr && pressure->GetNumberOfValues() == 1 && std::isfinite(pressure->GetComponent(0, 0)))
      return {pressure->GetComponent(0, 0)};
  }
  return {};
}

/// The nearest chamber of every face.
std::vector<std::uint8_t> nearest_chambers(vtkUnstructuredGrid& rest, const GridSurface& surface, std::size_t chambers) {
  constexpr std::size_t most_comparisons = 400'000'000;
  if (chambers <= 1 || surface.faces.size() * surface.chamber_cells.size() > most_comparisons)
    return std::vector<std::uint8_t>(surface.faces.size());
  std::vector<std::pair<Place, std::uint8_t>> walls;
  for (std::size_t n = 0; n < surface.chamber_cells.size(); ++n)
    for (const FaceIds& part : quadrilaterals(*rest.GetCell(surface.chamber_cells[n])->GetPointIds()))
      walls.emplace_back(middle_of(rest, part), static_cast<std::uint8_t>(surface.chambers[n]));
  if (walls.empty()) return std::vector<std::uint8_t>(surface.faces.size());
  std::vector<std::uint8_t> nearest;
  for (const FaceIds& face : surface.faces) {
    const Place middle = middle_of(rest, face);
    const auto found = std::ranges::min_element(walls, {}, [&](const auto& wall) {
      return std::hypot(wall.first[0] - middle[0], wall.first[1] - middle[1], wall.first[2] - middle[2]);
    });
    nearest.push_back(found->second);
  }
  return nearest;
}

std::size_t chamber_count(const GridSurface& surface) {
  const std::size_t count = surface.chambers.empty() ? 0 : std::ranges::max(surface.chambers) + 1;
  return count > 255 ? 0 : count;
}

/// Positions of all frames before they are rounded.
class BodyMotion {
 public:
  BodyMotion(const BodyRequest& request) : request_(request) {}  // NOLINT(google-explicit-constructor): made once, below

  PageBody read() {
    const Grid first = read_frame_grid(request_.frames.front().file);
    surface_ = whole_surface(*first);
    if (surface_.chamber_cells.empty()) remove_inner_pieces(*first, surface_);
    if (surface_.faces.empty()) throw io::InputError(request_.frames.front().file.string() + ": has no surface");
    number_corners(*first);
    const std::vector<std::size_t> chosen = shown_frames(request_.frames.size(), frame_limit());
    const Grid last = read_frame_grid(request_.frames[chosen.back()].file);
    adds_displacements_ = is_undeformed(*first, *last);
    chambers_ = chamber_count(surface_);
    body_.name = request_.name;
    if (request_.has_phases) body_.materials = materials_of(*first, surface_, request_.body);
    for (const std::size_t n : chosen)
      add_frame(n == 0 ? *first : *(n == chosen.back() ? last : read_frame_grid(request_.frames[n].file)), request_.frames[n],
                *first);
    const bool has_all = std::ranges::all_of(body_.pressures_Pa, [&](const auto& one) { return one.size() == chosen.size(); });
    if (body_.pressures_Pa.empty() || !has_all)
      body_.pressures_Pa.clear();
    else
      body_.chambers = nearest_chambers(*first, surface_, chambers_);
    round_positions();
    return std::move(body_);
  }

 private:
  void number_corners(vtkUnstructuredGrid& grid) {
    std::vector<std::uint32_t> number(static_cast<std::size_t>(grid.GetNumberOfPoints()),
                                      std::numeric_limits<std::uint32_t>::max());
    for (const FaceIds& face : surface_.faces) {
      std::array<std::uint32_t, 4> corners{};
      for (std::size_t n = 0; n < 4; ++n) {
        std::uint32_t& known = number[static_cast<std::size_t>(face[n])];
        if (known == std::numeric_limits<std::uint32_t>::max()) {
          known = static_cast<std::uint32_t>(ids_.size());
          ids_.push_back(face[n]);
        }
        corners.at(n) = known;
      }
      body_.faces.push_back(corners);
    }
    body_.corners = ids_.size();
  }

  /// How many frames fit.
  [[nodiscard]] std::size_t frame_limit() const {
    const std::size_t of_surface = sizeof(std::array<std::uint32_t, 4>) * body_.faces.size();
    const std::size_t of_frame = 3 * sizeof(std::int16_t) * body_.corners;
    if (of_surface + 2 * of_frame > request_.most_bytes)
      throw io::InputError(request_.frames.front().file.parent_path().string() + ": too large for the page (" +
                           std::to_string(body_.faces.size()) + " faces)");
    return std::min(request_.most_frames, (request_.most_bytes - of_surface) / of_frame);
  }

  void add_frame(vtkUnstructuredGrid& grid, const BodyFrame& frame, vtkUnstructuredGrid& first) {
    vtkDataArray* moved = adds_displacements_ ? grid.GetPointData()->GetArray("displacement_m") : nullptr;
    if (grid.GetNumberOfPoints() != first.GetNumberOfPoints() || grid.GetNumberOfCells() != first.GetNumberOfCells() ||
        (adds_displacements_ && moved == nullptr))
      throw io::InputError(frame.file.string() + ": is of another mesh than the first frame");
    const auto now_m = [&](vtkIdType id) {
      Place place = point_of(grid, id);
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (moved != nullptr) place[axis] += moved->GetComponent(id, static_cast<int>(axis));
      return place;
    };
    std::optional<RigidMotion> of_near_end;
    if (request_.held_cell_m) {
      MovedPoints points;
      for (vtkIdType id = 0; id < grid.GetNumberOfPoints(); ++id) {
        points.rest_m.push_back(point_of(first, id));
        points.now_m.push_back(now_m(id));
      }
      of_near_end = motion_of_near_end(points, *request_.held_cell_m);
    }
    Place sum{};
    for (const vtkIdType id : ids_) {
      const Place place = of_near_end ? of_near_end->taken_out(now_m(id)) : now_m(id);
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += place[axis];
      positions_.push_back(place);
    }
    const auto count = static_cast<double>(ids_.size());
    body_.centres_m.push_back({sum[0] / count, sum[1] / count, sum[2] / count});
    body_.times.push_back(frame.time);
    const std::vector<double> pressures_Pa = pressures_in(grid, surface_, chambers_);
    body_.pressures_Pa.resize(std::max(body_.pressures_Pa.size(), pressures_Pa.size()));
    for (std::size_t c = 0; c < pressures_Pa.size(); ++c) body_.pressures_Pa[c].push_back(pressures_Pa[c]);
  }

  void round_positions() {
    PieceBox box;
    for (const Place& place : positions_) box.add(place);
    double extent = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, box.high[axis] - box.low[axis]);
    constexpr double steps = 65535.0;
    constexpr double middle = 32768.0;
    body_.origin_m = box.low;
    body_.scale_m = extent > 0.0 ? extent / steps : 1.0;
    for (const Place& place : positions_) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const long step = std::lround((place[axis] - box.low[axis]) / body_.scale_m) - std::lround(middle);
        body_.positions.push_back(static_cast<std::int16_t>(step));
      }
    }
  }

  const BodyRequest& request_;
  GridSurface surface_;
  std::vector<vtkIdType> ids_;  ///< points of the grid that are corners of the surface
  bool adds_displacements_ = false;
  std::size_t chambers_ = 0;
  std::vector<Place> positions_;
  PageBody body_;
};

/// A body as bytes for a process on the same machine, and back.
json parts_of(const PageBody& body) {
  const auto binary = [](const auto& values) {
    std::vector<std::uint8_t> bytes(values.size() * sizeof(values[0]));
    if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return json::binary(std::move(bytes));
  };
  return {{"name", body.name},
          {"faces", binary(body.faces)},
          {"corners", body.corners},
          {"times", body.times},
          {"positions", binary(body.positions)},
          {"origin_m", body.origin_m},
          {"scale_m", body.scale_m},
          {"materials", binary(body.materials)},
          {"chambers", binary(body.chambers)},
          {"pressures_Pa", body.pressures_Pa},
          {"centres_m", body.centres_m}};
}

PageBody joined_body(const json& parts) {
  PageBody body;
  const auto fill = [&](const char* name, auto& values) {
    const std::vector<std::uint8_t>& bytes = parts.at(name).get_binary();
    values.resize(bytes.size() / sizeof(values[0]));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  };
  parts.at("name").get_to(body.name);
  fill("faces", body.faces);
  parts.at("corners").get_to(body.corners);
  parts.at("times").get_to(body.times);
  fill("positions", body.positions);
  parts.at("origin_m").get_to(body.origin_m);
  parts.at("scale_m").get_to(body.scale_m);
  fill("materials", body.materials);
  fill("chambers", body.chambers);
  parts.at("pressures_Pa").get_to(body.pressures_Pa);
  parts.at("centres_m").get_to(body.centres_m);
  return body;
}

// The first byte of an answer says what follows.
constexpr char body_follows = 'b';
constexpr char refusal_follows = 'r';

/// What the child process that reads a body answers. Files that are refused are told apart from those that end it.
std::string answer_to(const BodyRequest& request) {
  try {
    const std::vector<std::uint8_t> bytes = json::to_cbor(parts_of(BodyMotion(request).read()));
    return body_follows + std::string(bytes.begin(), bytes.end());
  } catch (const io::InputError& error) {
    return refusal_follows + std::string(error.what());
  }
}

/// @throws io::InputError if the answer is a refusal
PageBody body_in(const std::string& answer) {
  if (answer.front() == refusal_follows) throw io::InputError(answer.substr(1));
  return joined_body(json::from_cbor(answer.begin() + 1, answer.end()));
}

}  // namespace

std::vector<BodyFrames> read_body_frames(const fs::path& collection, const fs::path& folder) {
  std::map<int, BodyFrames> parts;
  for (const voxel::CollectionEntry& entry : voxel::read_collection(collection)) {
    const fs::path file = collection.parent_path() / entry.file;
    if (!std::isfinite(entry.time_s)) throw io::InputError(collection.string() + ": a timestep is not finite");
    if (!is_within(file, folder))
      throw io::InputError(collection.string() + ": names " + entry.file.string() + ", which leads out of " + folder.string());
    BodyFrames& part = parts[entry.part];
    part.part = entry.part;
    part.frames.push_back({entry.time_s, file});
  }
  std::vector<BodyFrames> bodies;
  for (auto& [number, part] : parts) {
    std::ranges::stable_sort(part.frames, {}, &BodyFrame::time);
    bodies.push_back(std::move(part));
  }
  return bodies;
}

PageBody read_page_body(const BodyRequest& request) {
  if (request.frames.empty()) throw io::InputError(request.name + ": has no frames");
  std::string answer;
  try {
    answer = io::read_in_child(request.frames.front().file, "VTK", [&] { return answer_to(request); });
  } catch (const io::InputError&) {
    // VTK ended on one of the files: find out on which.
    for (const BodyFrame& frame : request.frames) {
      (void)io::read_in_child(frame.file, "VTK", [&] {
        (void)read_frame_grid(frame.file);
        return std::string();
      });
    }
    throw;
  }
  return body_in(answer);
}

std::vector<std::size_t> shown_frames(std::size_t count, std::size_t most) {
  std::vector<std::size_t> shown;
  if (count <= most || most < 2) {
    for (std::size_t n = 0; n < count; ++n) shown.push_back(n);
    return shown;
  }
  for (std::size_t n = 0; n < most; ++n) shown.push_back(n * (count - 1) / (most - 1));
  return shown;
}

std::array<double, 3> corner_m(const PageBody& body, std::size_t frame, std::size_t corner) {
  std::array<double, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    place.at(axis) =
        body.origin_m.at(axis) + body.scale_m * (32768.0 + body.positions[3 * (frame * body.corners + corner) + axis]);
  return place;
}

std::pair<std::array<double, 3>, std::array<double, 3>> box_of(const PageBody& body, std::size_t frame) {
  PieceBox box;
  for (std::size_t c = 0; c < body.corners; ++c) box.add(corner_m(body, frame, c));
  return {box.low, box.high};
}

}  // namespace menger::evolution
