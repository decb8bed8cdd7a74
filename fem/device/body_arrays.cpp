#include "fem/device/body_arrays.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <set>
#include <type_traits>
#include <variant>

#include "fem/explicit/chamber_faces.h"
#include "fem/explicit/explicit_contact.h"
#include "fem/explicit/face_pressure_kernel.h"

namespace menger::fem {
namespace {

constexpr std::size_t alignment = 64;

/// The numbers of the forces on a corner of the elements of a batch. A lone lane has a zero after the three, see CornerScatter.
constexpr std::size_t numbers_per_corner(std::size_t width) { return width == 1 ? 4 : 3 * width; }

std::size_t rounded_up(std::size_t count, std::size_t width) { return (count + width - 1) / width * width; }

/// The place of entry n of a lane in an array with `count` entries a lane.
std::size_t place_of(std::size_t count, std::size_t n, std::size_t lane, std::size_t width) {
  return (lane / width * count + n) * width + lane % width;
}

}  // namespace

std::string obstacle_to_blocks(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options) {
  if (!std::holds_alternative<ThinWallOptions>(options.elements)) return "its elements are not thin walls";
  if (!has_closed_plena(mesh)) return "its chambers are not closed";
  for (const ExplicitRegion& region : options.regions)
    if (region.material.law.index() != options.regions.front().material.law.index()) return "its materials have different laws";
  return "";
}

template <class Number>
BodyArrays<Number>::BodyArrays(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, const ExplicitBodyOptions& options,
                               const NodalLoads& loads, std::size_t width) {
  const ThinWallMesh walls(mesh, width, true);
  counts_.width = width;
  counts_.node_count = mesh.points.size();
  counts_.plenum_count = mesh.plenum_names.size();
  counts_.batch_count = walls.batch_count();
  counts_.is_viscous = body.is_viscous();
  counts_.component_apart = width;
  counts_.numbers_per_batch = 8 * numbers_per_corner(width);
  counts_.first_face_number = counts_.numbers_per_batch * counts_.batch_count;
  counts_.has_ground = loads.ground.has_value();
  if (loads.ground) counts_.ground = *loads.ground;
  counts_.gravity_m_per_s2 = loads.gravity_m_per_s2;
  counts_.mass_damping_per_s = loads.mass_damping_per_s;
  add_elements(walls);
  add_groups(walls, options);
  add_faces(mesh);
  add_slots(walls);
  add_given_branches(mesh, walls, body.elements().lane_count());
  std::vector<double> heights;
  for (const meshes::Point& point : mesh.points) heights.push_back(point[2]);
  const std::vector<double> areas = outer_node_areas_m2(mesh);
  inverse_masses_at_ = add(std::span(body.inverse_masses_per_kg()));
  masses_at_ = add(std::span(body.masses_kg()));
  areas_at_ = add(std::span(areas));
  heights_at_ = add(std::span<const double>(heights));
}

template <class Number>
template <class Entry>
std::size_t BodyArrays<Number>::add(std::span<const Entry> entries) {
  static_assert(std::is_trivially_copyable_v<Entry>);
  const std::size_t begin = rounded_up(bytes_.size(), alignment);
  bytes_.resize(begin + entries.size_bytes());
  if (!entries.empty()) std::memcpy(bytes_.data() + begin, entries.data(), entries.size_bytes());
  return begin;
}

template <class Number>
void BodyArrays<Number>::add_elements(const ThinWallMesh& walls) {
  const std::size_t width = walls.width();
  std::vector<std::uint32_t> components(8 * walls.lane_count());
  std::vector<Number> shapes(shape_numbers_per_lane * walls.lane_count());
  std::vector<Number> sides;
  std::vector<std::int16_t> plena(2 * walls.lane_count());
  std::vector<std::uint8_t> repeated;
  std::vector<std::uint8_t> normals;
  for (std::size_t lane = 0; lane < walls.lane_count(); ++lane) {
    for (std::size_t c = 0; c < 8; ++c) components[place_of(8, c, lane, width)] = walls.first_components(lane)[c];
    const auto shape = walls.shape(lane);
    for (std::size_t n = 0; n < shape.size(); ++n) shapes[place_of(shape.size(), n, lane, width)] = static_cast<Number>(shape[n]);
    for (std::size_t n = 0; n < 2; ++n)
      plena[place_of(2, n, lane, width)] = static_cast<std::int16_t>(walls.plena_of_lane(lane)[n]);
    sides.push_back(static_cast<Number>(walls.side(lane)));
    repeated.push_back(walls.is_repeated(lane) ? 1 : 0);
  }
  for (std::size_t batch = 0; batch < walls.batch_count(); ++batch)
    normals.push_back(static_cast<std::uint8_t>(walls.normal(batch)));
  components_at_ = add(std::span<const std::uint32_t>(components));
  shapes_at_ = add(std::span<const Number>(shapes));
  sides_at_ = add(std::span<const Number>(sides));
  plena_at_ = add(std::span<const std::int16_t>(plena));
  repeated_at_ = add(std::span<const std::uint8_t>(repeated));
  normals_at_ = add(std::span<const std::uint8_t>(normals));
}

template <class Number>
void BodyArrays<Number>::add_groups(const ThinWallMesh& walls, const ExplicitBodyOptions& options) {
  const ThinWallConstants constants = std::get<ThinWallOptions>(options.elements).constants;
  const ThinWallBranchLayout branches(walls);
  law_ = options.regions.front().material.law.index();
  for (std::size_t g = 0; g < walls.groups().size(); ++g) {
    const ThinWallGroup& group = walls.groups()[g];
    const ThinWallMaterial material = wall_material(options.regions[group.region].material, constants);
    Group added;
    added.law_offset = std::visit([&](const auto& law) { return add(std::span(&law, 1)); }, material.law);
    added.view.first_batch = group.first_batch;
    added.view.batch_count = group.batch_count;
    added.view.branch_position = branches.position(g);
    for (std::size_t n = 0; n < material.branches.size(); ++n)
      added.view.relaxation_times_s[n] = material.branches[n].relaxation_time_s;
    counts_.branch_set_count = std::max(counts_.branch_set_count, branch_set_count(material.branches.size()));
    const Number some_velocity(0);  // with it the task keeps the viscosity
    added.view.task =
        detail::task_of<Number>(material, {}, {.velocities_m_per_s = &some_velocity}, {nullptr, 0.0, branches.number_count()});
    added.view.task.batches.element = group.element;
    groups_.push_back(added);
  }
  counts_.group_count = groups_.size();
  counts_.sets_apart = branches.number_count();
  counts_.branch_number_count = counts_.branch_set_count * branches.number_count();
  const std::vector<GroupView<Number>> room(groups_.size());
  groups_at_ = add(std::span<const GroupView<Number>>(room));
}

template <class Number>
void BodyArrays<Number>::add_faces(const meshes::HexahedralMesh& mesh) {
  const std::set<meshes::FaceCorners> of_walls = chamber_faces_of_walls(mesh);
  const std::size_t width = counts_.width;
  std::vector<std::array<Number, half_edge_numbers_per_face>> edges;
  for (std::size_t chamber = 0; chamber < mesh.chambers.size(); ++chamber) {
    for (const meshes::BoundaryFace& face : faces_of_chamber(mesh, chamber)) {
      if (of_walls.contains(meshes::sorted(face.corners))) continue;
      faces_.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) faces_.back()[c] = static_cast<std::uint32_t>(face.corners[c]);
      face_plena_.push_back(static_cast<std::int16_t>(mesh.chambers[chamber].plenum));
      const auto at = [&](std::size_t corner) -> const meshes::Point& { return mesh.points[face.corners[corner]]; };
      edges.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        edges.back()[i] = static_cast<Number>(0.5 * (at(1)[i] - at(0)[i]));
        edges.back()[3 + i] = static_cast<Number>(0.5 * (at(3)[i] - at(0)[i]));
      }
    }
  }
  faces_.resize(rounded_up(faces_.size(), width));
  edges.resize(faces_.size());
  face_plena_.resize(faces_.size(), -1);
  counts_.face_batch_count = faces_.size() / width;
  std::vector<std::uint32_t> components(4 * faces_.size());
  std::vector<Number> half_edges(half_edge_numbers_per_face * faces_.size());
  for (std::size_t lane = 0; lane < faces_.size(); ++lane) {
    for (std::size_t c = 0; c < 4; ++c) components[place_of(4, c, lane, width)] = 3 * faces_[lane][c];
    for (std::size_t n = 0; n < half_edge_numbers_per_face; ++n)
      half_edges[place_of(half_edge_numbers_per_face, n, lane, width)] = edges[lane][n];
  }
  face_components_at_ = add(std::span<const std::uint32_t>(components));
  half_edges_at_ = add(std::span<const Number>(half_edges));
  face_plena_at_ = add(std::span<const std::int16_t>(face_plena_));
}

template <class Number>
void BodyArrays<Number>::add_slots(const ThinWallMesh& walls) {
  const std::size_t width = counts_.width;
  std::vector<std::vector<std::uint32_t>> of_node(counts_.node_count);
  const std::size_t per_corner = numbers_per_corner(width);
  for (std::size_t lane = 0; lane < walls.lane_count(); ++lane) {
    if (walls.is_repeated(lane)) continue;
    for (std::size_t c = 0; c < 8; ++c)
      of_node[walls.first_components(lane)[c] / 3].push_back(
          static_cast<std::uint32_t>((lane / width * 8 + c) * per_corner + lane % width));
  }
  for (std::size_t lane = 0; lane < faces_.size(); ++lane) {
    if (face_plena_[lane] < 0) continue;
    for (std::size_t c = 0; c < 4; ++c)
      of_node[faces_[lane][c]].push_back(
          static_cast<std::uint32_t>(counts_.first_face_number + (lane / width * 4 + c) * 3 * width + lane % width));
  }
  counts_.force_number_count = counts_.first_face_number + 12 * faces_.size();
  std::vector<std::uint8_t> slot_counts;
  std::size_t most = 0;
  for (const auto& own : of_node) {
    slot_counts.push_back(static_cast<std::uint8_t>(own.size()));
    most = std::max(most, own.size());
  }
  std::vector<std::uint32_t> slots(most * counts_.node_count);
  for (std::size_t node = 0; node < of_node.size(); ++node)
    for (std::size_t n = 0; n < of_node[node].size(); ++n) slots[n * counts_.node_count + node] = of_node[node][n];
  slot_counts_at_ = add(std::span<const std::uint8_t>(slot_counts));
  slots_at_ = add(std::span<const std::uint32_t>(slots));
}

template <class Number>
void BodyArrays<Number>::add_given_branches(const meshes::HexahedralMesh& mesh, const ThinWallMesh& walls,
                                            std::size_t given_width) {
  const ThinWallMesh given(mesh, given_width);
  const ThinWallBranchLayout layout(given);
  std::vector<std::uint32_t> of_element(mesh.elements.size());
  for (std::size_t g = 0; g < given.groups().size(); ++g) {
    const ThinWallGroup& group = given.groups()[g];
    const std::size_t end = given_width * (group.first_batch + group.batch_count);
    for (std::size_t lane = given_width * group.first_batch; lane < end; ++lane)
      if (!given.is_repeated(lane)) of_element[given.element(lane)] = static_cast<std::uint32_t>(layout.first(g, lane));
  }
  std::vector<std::uint32_t> of_lane;
  for (std::size_t lane = 0; lane < walls.lane_count(); ++lane) of_lane.push_back(of_element[walls.element(lane)]);
  counts_.given_apart = given_width;
  counts_.given_sets_apart = layout.number_count();
  given_branch_count_ = counts_.branch_set_count * layout.number_count();
  given_at_ = add(std::span<const std::uint32_t>(of_lane));
}

template <class Number>
BodyView<Number> BodyArrays<Number>::place(const std::byte* address) {
  // Addresses of memory that need not be this process's.
  const auto at = [&](std::size_t offset) { return reinterpret_cast<const void*>(address + offset); };
  const auto numbers = [&](std::size_t offset) { return static_cast<const Number*>(at(offset)); };
  const auto indices = [&](std::size_t offset) { return static_cast<const std::uint32_t*>(at(offset)); };
  const auto plena = [&](std::size_t offset) { return static_cast<const std::int16_t*>(at(offset)); };
  const auto reals = [&](std::size_t offset) { return static_cast<const double*>(at(offset)); };
  const std::size_t width = counts_.width;
  std::vector<GroupView<Number>> placed;
  for (const Group& group : groups_) {
    GroupView<Number> view = group.view;
    const std::size_t first = view.first_batch;
    view.task.law = {law_, at(group.law_offset)};
    view.task.batches.count = view.batch_count;
    view.task.batches.first_components = indices(components_at_) + 8 * width * first;
    view.task.batches.shapes = numbers(shapes_at_) + shape_numbers_per_lane * width * first;
    view.task.batches.normals = static_cast<const std::uint8_t*>(at(normals_at_)) + first;
    view.task.motion = {};
    placed.push_back(view);
  }
  std::memcpy(bytes_.data() + groups_at_, placed.data(), placed.size() * sizeof(placed[0]));
  BodyView<Number> view = counts_;
  view.groups = static_cast<const GroupView<Number>*>(at(groups_at_));
  view.sides = numbers(sides_at_);
  view.plena = plena(plena_at_);
  view.face_components = indices(face_components_at_);
  view.half_edges_m = numbers(half_edges_at_);
  view.face_plena = plena(face_plena_at_);
  view.slot_counts = static_cast<const std::uint8_t*>(at(slot_counts_at_));
  view.slots = indices(slots_at_);
  view.inverse_masses_per_kg = reals(inverse_masses_at_);
  view.masses_kg = reals(masses_at_);
  view.outer_areas_m2 = reals(areas_at_);
  view.heights_m = reals(heights_at_);
  view.given_branches = indices(given_at_);
  view.is_repeated = static_cast<const std::uint8_t*>(at(repeated_at_));
  return view;
}

template class BodyArrays<float>;
template class BodyArrays<double>;

}  // namespace menger::fem
