#include "fem/explicit/thin_wall_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

#include "fem/explicit/chamber_faces.h"
#include "fem/explicit/wide_loops.h"
#include "fem/thin_walls/thin_wall_mesh.h"
#include "io/text/input_error.h"

namespace menger::fem {
namespace {

constexpr std::size_t nodes_at_once = 2048;

/// Converts nodal vectors relative to the first node's: forces do not change with a common displacement, and single precision
/// would otherwise round the more the further a body has gone.
/// @param first the first node's vector
template <class Number>
[[gnu::always_inline]] inline void convert_relative(const double* from, std::size_t count, const double* first, Number* to) {
  constexpr std::size_t period = 24;
  std::array<double, period> origin;
  for (std::size_t n = 0; n < period; ++n) origin[n] = first[n % 3];
  const std::size_t whole = count / period * period;
  for (std::size_t n = 0; n < whole; n += period)
    for (std::size_t k = 0; k < period; ++k) to[n + k] = static_cast<Number>(from[n + k] - origin[k]);
  for (std::size_t n = whole; n < count; ++n) to[n] = static_cast<Number>(from[n] - origin[n - whole]);
}

MENGER_WIDE_LOOPS void convert(const double* from, std::size_t count, const double* first, float* to) {
  convert_relative(from, count, first, to);
}

MENGER_WIDE_LOOPS void convert(const double* from, std::size_t count, const double* first, double* to) {
  convert_relative(from, count, first, to);
}

template <class Number>
class ThinWallElements final : public ExplicitElements {
 public:
  ThinWallElements(const meshes::HexahedralMesh& mesh, const std::vector<ExplicitRegion>& regions, const ThinWallOptions& options,
                   const ThinWallKernels<Number>& kernels)
      : kernels_(kernels),
        walls_(mesh, kernels.width),
        faces_(mesh, FaceValues::displacements, face_kernels(options), chamber_faces_of_walls(mesh)),
        take_pressure_(has_closed_plena(mesh)),
        points_(mesh.points),
        plenum_count_(mesh.plenum_names.size()),
        slots_(sorted_slots()),
        branches_(walls_) {
    for (const meshes::Chamber& chamber : mesh.chambers) chamber_plena_.push_back(chamber.plenum);
    for (const ExplicitRegion& region : regions) materials_.push_back(wall_material(region.material, options.constants));
    set_shapes();
  }

  [[nodiscard]] std::string text() const override {
    return "thin walls, " + std::string(sizeof(Number) == 4 ? "single" : "double") + " precision, " +
           std::string(kernels_.instruction_set);
  }

  [[nodiscard]] double contact_modulus_Pa() const override {
    double largest = 0.0;
    for (const ThinWallMaterial& material : materials_)
      largest = std::max(largest, fem::contact_modulus_Pa(materials::shear_modulus_at_rest_Pa(material.law)));
    return largest;
  }

  [[nodiscard]] bool take_pressure() const override { return take_pressure_; }
  [[nodiscard]] std::size_t lane_count() const override { return kernels_.width; }

  [[nodiscard]] std::unique_ptr<ElementForces> make_forces() const override { return std::make_unique<Forces>(*this); }

  [[nodiscard]] BranchNumbers branches_at_rest(std::span<const double> displacements_m) const override {
    std::size_t sets = 0;
    for (const ThinWallMaterial& material : materials_) sets = std::max(sets, branch_set_count(material.branches.size()));
    if (sets == 0) return AlignedVector<Number>{};
    AlignedVector<Number> branches(sets * branches_.number_count(), Number(0));
    const AlignedVector<Number> u = converted(displacements_m);
    for (std::size_t g = 0; g < walls_.groups().size(); ++g) {
      const ThinWallGroup& group = walls_.groups()[g];
      kernels_.rest_branches(batches(group, {group.first_batch, group.first_batch + group.batch_count}), {u.data()},
                             branches.data() + branches_.position(g));
    }
    for (std::size_t set = 1; set < sets; ++set)
      std::copy_n(branches.begin(), branches_.number_count(),
                  branches.begin() + static_cast<std::ptrdiff_t>(set * branches_.number_count()));
    return branches;
  }

  [[nodiscard]] double strain_energy_J(std::span<const double> displacements_m, const BranchNumbers& branches) const override {
    const auto energies = lane_energies(displacements_m, std::get<AlignedVector<Number>>(branches)).energies_J;
    return std::accumulate(energies.begin(), energies.end(), 0.0,
                           [](double sum, Number energy) { return sum + static_cast<double>(energy); });
  }

  [[nodiscard]] std::optional<FailedElement> failed_element(std::span<const double> displacements_m) const override {
    const AlignedVector<Number> ratios = lane_energies(displacements_m, {}).smallest_ratios;
    for (std::size_t lane = 0; lane < ratios.size(); ++lane) {
      if (!ThinWallOutcome{.smallest_ratio = static_cast<double>(ratios[lane])}.is_inverted()) continue;
      FailedElement failed{walls_.element(lane), points_[walls_.first_components(lane)[0] / 3], true};
      for (const std::uint32_t component : walls_.first_components(lane))
        for (std::size_t i = 0; i < 3; ++i) failed.is_finite = failed.is_finite && std::isfinite(displacements_m[component + i]);
      return failed;
    }
    return std::nullopt;
  }

 private:
  class Forces;

  struct LaneEnergies {
    AlignedVector<Number> energies_J;  ///< per lane
    AlignedVector<Number> smallest_ratios;
  };

  void set_shapes() {
    const std::size_t width = walls_.width();
    for (std::size_t lane = 0; lane < walls_.lane_count(); ++lane) sides_.push_back(static_cast<Number>(walls_.side(lane)));
    for (std::size_t batch = 0; batch < walls_.batch_count(); ++batch)
      pressed_faces_.push_back(static_cast<std::uint8_t>(walls_.plenum_count(batch)));
    shapes_.resize(shape_numbers_per_lane * walls_.lane_count());
    for (std::size_t lane = 0; lane < walls_.lane_count(); ++lane) {
      const auto shape = walls_.shape(lane);
      for (std::size_t n = 0; n < shape.size(); ++n)
        shapes_[(lane / width * shape.size() + n) * width + lane % width] = static_cast<Number>(shape[n]);
    }
  }

  static FacePressureKernels<Number> face_kernels(const ThinWallOptions& options) {
    for (const FacePressureKernels<Number>& kernels : available_face_pressure_kernels<Number>())
      if (kernels.instruction_set == options.instruction_set) return kernels;
    if (options.instruction_set == "scalar") return available_face_pressure_kernels<Number>().front();
    return best_face_pressure_kernels<Number>();
  }

  [[nodiscard]] std::size_t face_batch_count() const { return take_pressure_ ? faces_.batch_count() : 0; }
  /// Numbers of the forces of all elements, which precede those of the faces.
  [[nodiscard]] std::size_t element_number_count() const { return slot_numbers_per_lane * walls_.lane_count(); }
  [[nodiscard]] std::size_t number_count() const { return element_number_count() + (take_pressure_ ? faces_.number_count() : 0); }

  /// Slots of elements come before those of faces; the empty one follows them all.
  [[nodiscard]] FourfoldSlots sorted_slots() const {
    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> slots;
    for (std::size_t lane = 0; lane < walls_.lane_count(); ++lane) {
      if (walls_.is_repeated(lane)) continue;
      for (std::size_t c = 0; c < 8; ++c) {
        nodes.push_back(walls_.first_components(lane)[c] / 3);
        slots.push_back(static_cast<std::uint32_t>(kernels_.slot(lane, c)));
      }
    }
    if (take_pressure_) faces_.add_slots(static_cast<std::uint32_t>(element_number_count() / 4), nodes, slots);
    return {nodes, slots, points_.size(), static_cast<std::uint32_t>(number_count() / 4)};
  }

  [[nodiscard]] ThinWallBatches<Number> batches(const ThinWallGroup& group, IndexRange range) const {
    auto result = walls_.template batches<Number>(group.element, range.begin, range.end - range.begin);
    result.shapes = shapes_.data() + shape_numbers_per_lane * walls_.width() * range.begin;
    return result;
  }

  /// Kernels read one number beyond the last component.
  [[nodiscard]] AlignedVector<Number> converted(std::span<const double> values) const {
    AlignedVector<Number> result(values.size() + 1, Number(0));
    convert(values.data(), values.size(), values.data(), result.data());
    return result;
  }

  [[nodiscard]] LaneEnergies lane_energies(std::span<const double> displacements_m, const AlignedVector<Number>& branches) const {
    const std::size_t width = walls_.width();
    LaneEnergies result{AlignedVector<Number>(walls_.lane_count()), AlignedVector<Number>(walls_.lane_count())};
    const AlignedVector<Number> u = converted(displacements_m);
    for (std::size_t g = 0; g < walls_.groups().size(); ++g) {
      const ThinWallGroup& group = walls_.groups()[g];
      kernels_.energies(
          materials_[group.region], batches(group, {group.first_batch, group.first_batch + group.batch_count}), {u.data()},
          {branches.empty() ? nullptr : branches.data() + branches_.position(g), 0.0, branches_.number_count()},
          result.energies_J.data() + width * group.first_batch, result.smallest_ratios.data() + width * group.first_batch);
    }
    return result;
  }

  ThinWallKernels<Number> kernels_;
  ThinWallMesh walls_;
  ChamberFaces<Number> faces_;
  bool take_pressure_;
  std::vector<std::size_t> chamber_plena_;
  std::vector<meshes::Point> points_;
  std::size_t plenum_count_;
  std::vector<ThinWallMaterial> materials_;  ///< per region
  AlignedVector<Number> shapes_;
  AlignedVector<Number> sides_;              ///< per lane
  std::vector<std::uint8_t> pressed_faces_;  ///< per batch
  FourfoldSlots slots_;
  ThinWallBranchLayout branches_;
};

template <class Number>
class ThinWallElements<Number>::Forces final : public ElementForces {
 public:
  explicit Forces(const ThinWallElements& elements)
      : elements_(elements),
        displacements_(3 * elements.points_.size() + 1, Number(0)),
        slots_N_(elements.number_count() + 4, Number(0)),
        mean_pressures_Pa_(elements.walls_.batch_count(), 0.0),
        side_pressures_Pa_(2 * elements.walls_.batch_count(), 0.0),
        face_pressures_Pa_(elements.chamber_plena_.size(), 0.0),
        wall_volumes_m3_(elements.walls_.batch_count(), 0.0),
        side_volumes_m3_(2 * elements.walls_.batch_count(), 0.0),
        face_volumes_m3_(elements.face_batch_count(), 0.0) {
    const auto is_viscous = [](const ThinWallMaterial& material) { return material.viscosity_Pa_s > 0.0; };
    if (std::any_of(elements.materials_.begin(), elements.materials_.end(), is_viscous)) velocities_ = displacements_;
  }

  void place(const NodalMotion& motion, const BlockLoop& loop) override {
    motion_ = motion;
    has_velocities_ = !velocities_.empty() && motion.velocities_m_per_s != nullptr;
    for (std::size_t i = 0; i < 3; ++i) {
      first_displacement_[i] = motion.displacements_m[i];
      if (has_velocities_) first_velocity_[i] = motion.velocities_m_per_s[i];
    }
    loop.run(displacements_.size() / 3, nodes_at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
      follow({begin, end});
    });
  }

  void follow(IndexRange nodes) override {
    const std::size_t first = 3 * nodes.begin;
    const std::size_t count = 3 * (nodes.end - nodes.begin);
    convert(motion_.displacements_m + first, count, first_displacement_.data(), displacements_.data() + first);
    if (has_velocities_) convert(motion_.velocities_m_per_s + first, count, first_velocity_.data(), velocities_.data() + first);
  }

  void press(std::span<const double> pressures_Pa) override {
    for (std::size_t batch = 0; batch < mean_pressures_Pa_.size(); ++batch) {
      double sum = 0.0;
      for (std::size_t n = 0; n < 2; ++n) {
        const int plenum = elements_.walls_.plena(batch)[n];
        const double pressure_Pa = plenum >= 0 ? pressures_Pa[static_cast<std::size_t>(plenum)] : 0.0;
        side_pressures_Pa_[2 * batch + n] = pressure_Pa;
        sum += pressure_Pa;
      }
      mean_pressures_Pa_[batch] = 0.5 * sum;
    }
    // The forces of elements are subtracted from what accelerates the nodes.
    for (std::size_t chamber = 0; chamber < face_pressures_Pa_.size(); ++chamber)
      face_pressures_Pa_[chamber] = -pressures_Pa[elements_.chamber_plena_[chamber]];
  }

  /// Faces follow the elements.
  [[nodiscard]] std::size_t batch_count() const override { return elements_.walls_.batch_count() + elements_.face_batch_count(); }

  ForcesOutcome compute(IndexRange range, BranchNumbers& branches, double relaxed_s) override {
    AlignedVector<Number>& numbers = std::get<AlignedVector<Number>>(branches);
    const std::size_t width = elements_.walls_.width();
    ForcesOutcome outcome;
    for (std::size_t g = 0; g < elements_.walls_.groups().size(); ++g) {
      const ThinWallGroup& group = elements_.walls_.groups()[g];
      const std::size_t first = std::max(range.begin, group.first_batch);
      const std::size_t end = std::min(range.end, group.first_batch + group.batch_count);
      if (first >= end) continue;
      ThinWallBatches<Number> batches = elements_.batches(group, {first, end});
      batches.mean_pressures_Pa = mean_pressures_Pa_.data() + first;
      batches.volume_changes_m3 = wall_volumes_m3_.data() + first;
      if (elements_.take_pressure_) {
        batches.pressed_faces = elements_.pressed_faces_.data() + first;
        batches.sides = elements_.sides_.data() + width * first;
        batches.face_pressures_Pa = side_pressures_Pa_.data() + 2 * first;
        batches.face_volumes_m3 = side_volumes_m3_.data() + 2 * first;
      }
      ThinWallBranches<Number> own{nullptr, relaxed_s, elements_.branches_.number_count()};
      if (!numbers.empty())
        own.values = numbers.data() + elements_.branches_.position(g) +
                     thin_wall_branch_numbers(group.element) * width * (first - group.first_batch);
      const ThinWallOutcome part = elements_.kernels_.forces(
          elements_.materials_[group.region], batches, {displacements_.data(), has_velocities_ ? velocities_.data() : nullptr},
          own, slots_N_.data() + slot_numbers_per_lane * width * first);
      outcome.has_failed = outcome.has_failed || part.is_inverted();
      outcome.dissipated_W += part.dissipated_W;
      outcome.relaxed_J += part.relaxed_J;
    }
    const std::size_t before = elements_.walls_.batch_count();
    if (range.end > before)
      elements_.faces_.compute({std::max(range.begin, before) - before, range.end - before}, displacements_.data(),
                               face_pressures_Pa_, slots_N_.data() + elements_.element_number_count(), face_volumes_m3_.data());
    return outcome;
  }

  void sum(IndexRange nodes, double* forces_N) const override {
    for (std::size_t node = nodes.begin; node < nodes.end; ++node) {
      const std::array<Number, 4> force = elements_.slots_.sum(slots_N_.data(), node);
      for (std::size_t i = 0; i < 3; ++i) *forces_N++ = static_cast<double>(force[i]);
    }
  }

  [[nodiscard]] PressedVolumes pressed_volumes() const override {
    const std::vector<double> none(elements_.plenum_count_, 0.0);
    PressedVolumes changes{none, none};
    for (std::size_t batch = 0; batch < wall_volumes_m3_.size(); ++batch) {
      for (std::size_t n = 0; n < elements_.pressed_faces_[batch]; ++n) {
        const auto plenum = static_cast<std::size_t>(elements_.walls_.plena(batch)[n]);
        changes.walls_m3[plenum] += 0.5 * wall_volumes_m3_[batch];
        changes.chambers_m3[plenum] += side_volumes_m3_[2 * batch + n];
      }
    }
    for (std::size_t batch = 0; batch < face_volumes_m3_.size(); ++batch)
      changes.chambers_m3[elements_.chamber_plena_[elements_.faces_.chamber(batch)]] += face_volumes_m3_[batch];
    return changes;
  }

 private:
  const ThinWallElements& elements_;
  NodalMotion motion_{};
  Point first_displacement_{};
  Point first_velocity_{};
  bool has_velocities_ = false;
  AlignedVector<Number> displacements_;
  AlignedVector<Number> velocities_;  ///< empty without a viscosity
  AlignedVector<Number> slots_N_;
  std::vector<double> mean_pressures_Pa_;  ///< of both faces, per batch
  std::vector<double> side_pressures_Pa_;  ///< of each face, two per batch
  std::vector<double> face_pressures_Pa_;  ///< minus the gauge pressure, per chamber
  std::vector<double> wall_volumes_m3_;    ///< changes, per batch
  std::vector<double>
      side_volumes_m3_;  ///< changes of volume behind faces of walls, two per batch; zeros where plena are not closed
  std::vector<double> face_volumes_m3_;  ///< changes of chambers, per batch of faces; empty where plena are not closed
};

template <class Number>
std::unique_ptr<ExplicitElements> make(const meshes::HexahedralMesh& mesh, const std::vector<ExplicitRegion>& regions,
                                       const ThinWallOptions& options) {
  if (options.instruction_set.empty())
    return std::make_unique<ThinWallElements<Number>>(mesh, regions, options, best_thin_wall_kernels<Number>());
  for (const ThinWallKernels<Number>& kernels : available_thin_wall_kernels<Number>())
    if (kernels.instruction_set == options.instruction_set)
      return std::make_unique<ThinWallElements<Number>>(mesh, regions, options, kernels);
  throw io::InputError("thin walls: this machine has no instruction set " + std::string(options.instruction_set));
}

}  // namespace

ThinWallMaterial wall_material(const ExplicitMaterial& material, const ThinWallConstants& constants) {
  return {.law = material.law,
          .bulk_modulus_Pa = std::visit([](const auto& law) { return law.bulk_modulus_Pa; }, material.volume),
          .wall_penalty_ratio = constants.wall_penalty_ratio,
          .block_stiffness_ratio = constants.block_stiffness_ratio,
          .viscosity_Pa_s = material.viscosity_Pa_s,
          .branches = acting(material.branches)};
}

std::unique_ptr<ExplicitElements> thin_wall_elements(const meshes::HexahedralMesh& mesh,
                                                     const std::vector<ExplicitRegion>& regions, const ThinWallOptions& options) {
  if (options.precision == Precision::double_precision) return make<double>(mesh, regions, options);
  return make<float>(mesh, regions, options);
}

}  // namespace menger::fem
