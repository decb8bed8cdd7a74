#pragma once

#include <cstddef>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "fem/elements/element_kernel.h"
#include "fem/space/space.h"
#include "fem/statics/body.h"
#include "fem/statics/element_results.h"
#include "fem/statics/thin_wall_groups.h"

namespace menger::fem {

/// An allocator whose memory is aligned to 64 bytes, as the packs of the element kernels need.
template <class T>
struct PackAllocator {
  using value_type = T;  // NOLINT(readability-identifier-naming): the name that containers ask for
  static constexpr std::align_val_t alignment{64};
  PackAllocator() = default;
  template <class Other>
  explicit PackAllocator(const PackAllocator<Other>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  void deallocate(T* data, std::size_t) { ::operator delete(data, alignment); }
  bool operator==(const PackAllocator&) const = default;
};
using PackedDoubles = std::vector<double, PackAllocator<double>>;

/// The elements of a rank, in batches of one material each, as the kernels need them. Thin walls predict no pressures.
class ElementGroups {
 public:
  using ElementResult = fem::ElementResult;
  using Receiver = ElementReceiver;
  using PointResult = fem::PointResult;

  ElementGroups(const Space& space, const Body& body, ElementKernels kernels = best_element_kernels());

  /// Computes the energy and smallest volume ratio and, where wanted, the residual and stiffness of every element. After
  /// predict_pressure the stiffness contains the predicted pressures (see ElementKernels).
  /// @param displacements 3 per local node @param receive called for each element unless nothing is wanted
  ElementSums evaluate(std::span<const double> displacements, const ElementWanted& wanted, const Receiver& receive);

  /// Predicts the pressures for the next stiffness: those expected at `displacements` + `step`.
  void predict_pressure(std::span<const double> displacements, std::span<const double> step);

  /// The pressures that predict_pressure has stored on this rank. Keep them with a state, and give them to
  /// set_predicted_pressures to restore it.
  [[nodiscard]] std::vector<double> predicted_pressures() const;
  void set_predicted_pressures(std::span<const double> pressures);  ///< pressure_count() of them (asserts)
  [[nodiscard]] std::size_t pressure_count() const;

  /// Discards the predicted pressures: the next stiffness is the exact one.
  void forget_prediction() { has_prediction_ = false; }

  /// Computes the fields at the quadrature points of every element.
  /// @param plenum_pressures_Pa stresses of thin walls contain those on their faces; not read for other elements
  void evaluate_points(std::span<const double> displacements, const PointReceiver& receive,
                       std::span<const double> plenum_pressures_Pa = {});

 private:
  struct Batch {
    std::size_t region;
    std::vector<std::size_t> elements;  ///< at most one per lane
    PackedDoubles positions;
    PackedDoubles predicted_pressure;
  };
  void gather(const Batch& batch, std::span<const double> values, PackedDoubles& packed) const;
  void hand_over(const Batch& batch, const ElementWanted& wanted, const Receiver& receive);
  [[nodiscard]] std::span<const Index> nodes_of(std::size_t element) const;

  const Space& space_;
  ElementKernels kernels_;
  std::vector<ElementMaterial> materials_;
  std::vector<Batch> batches_;
  std::optional<ThinWallGroups> thin_walls_;  ///< in place of batches
  bool has_prediction_ = false;
  PackedDoubles displacements_;
  PackedDoubles step_;
  PackedDoubles residual_;
  PackedDoubles stiffness_;
  PackedDoubles energy_;
  PackedDoubles ratio_;
  std::vector<double> element_residual_;
  std::vector<double> element_stiffness_;
};

}  // namespace menger::fem
