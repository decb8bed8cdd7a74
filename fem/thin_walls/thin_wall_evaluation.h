#pragma once

// The kernels of thin walls for one number type. Included only by the files thin_wall_kernel_<instruction set>.cpp, each compiled
// for its own, and instantiated with packs of that instruction set only.

#include <cmath>
#include <type_traits>

#include "fem/thin_walls/element_forces.h"
#include "fem/thin_walls/pack_gather.h"
#include "fem/thin_walls/pack_scatter.h"

namespace menger::fem::detail {

/// Any law, through a function.
template <class T>
class AnyLaw {
 public:
  explicit AnyLaw(const ThinWallTask<NumberOf<T>>& task) : law_(task.law), bulk_modulus_Pa_(task.bulk_modulus_Pa) {}
  MembraneResponse<T> operator()(const PlaneMetric<T>& metric) const {
    static constexpr auto functions = membrane_functions<T>(static_cast<const materials::HyperelasticLaw*>(nullptr));
    MembraneResponse<T> response;
    functions[law_.index](law_.parameters, bulk_modulus_Pa_, metric, response);
    return response;
  }
  BlockResponse<T> operator()(const BlockGradient<T>& F) const {
    static constexpr auto functions = block_functions<T>(static_cast<const materials::HyperelasticLaw*>(nullptr));
    BlockResponse<T> response;
    functions[law_.index](law_.parameters, F, response);
    return response;
  }

 private:
  LawReference law_;
  double bulk_modulus_Pa_;
};

// Sanitizers would make of one function so large what takes minutes to compile.
#ifdef __SANITIZE_ADDRESS__
#define MENGER_ALL_IN_ONE
#else
#define MENGER_ALL_IN_ONE [[gnu::flatten]]
#endif

/// All of an element in one function: its many small parts pass each other more numbers than there are registers.
template <class Element, class Law, bool is_damped>
MENGER_ALL_IN_ONE ThinWallOutcome thin_wall_forces_with(const ThinWallTask<typename Element::Number>& task,
                                                        typename Element::Number* slots_N) {
  using T = typename Element::Lane;
  const Law law(task);
  T smallest(1.0);
  LaneSums<T> dissipated;
  LaneSums<T> relaxed;
  for (std::size_t batch = 0; batch < task.batches.count; ++batch) {
    Element elements(task, batch);
    compute_element_forces<is_damped>(task, batch, law, elements);
    if (task.batches.pressed_faces != nullptr) elements.press_faces(batch);
    elements.store(slots_N + slot_numbers_per_lane * Element::width * batch);
    smallest = min(smallest, elements.smallest_square());
    if (task.batches.volume_changes_m3 != nullptr) {
      LaneSums<T> change;
      change.add(elements.volume_change());
      task.batches.volume_changes_m3[batch] = change.total();
    }
    if constexpr (is_damped) {
      if (task.viscosity_Pa_s > 0.0) dissipated.add(elements.dissipation());
      if (task.relaxing != nullptr) relaxed.add(elements.relaxed());
    }
  }
  ThinWallOutcome outcome;
  alignas(64) std::array<typename Element::Number, Element::width> lanes;
  Lanes<T>::store(smallest, lanes.data());
  for (const auto square : lanes) {
    const double ratio = square > 0 ? std::sqrt(static_cast<double>(square)) : -1.0;
    if (ratio < outcome.smallest_ratio) outcome.smallest_ratio = ratio;
  }
  outcome.dissipated_W = dissipated.total();
  outcome.relaxed_J = relaxed.total();
  return outcome;
}

template <class Element>
ThinWallOutcome element_forces(const ThinWallTask<typename Element::Number>& task, typename Element::Number* slots_N) {
  static_assert(std::is_same_v<std::variant_alternative_t<0, materials::HyperelasticLaw>, materials::NeoHookean>);
  using T = typename Element::Lane;
  const bool is_damped = task.branch != nullptr || task.viscosity_Pa_s > 0.0;
  if (task.law.index == 0) {
    if (is_damped) return thin_wall_forces_with<Element, InlineLaw<materials::NeoHookean>, true>(task, slots_N);
    return thin_wall_forces_with<Element, InlineLaw<materials::NeoHookean>, false>(task, slots_N);
  }
  if (is_damped) return thin_wall_forces_with<Element, AnyLaw<T>, true>(task, slots_N);
  return thin_wall_forces_with<Element, AnyLaw<T>, false>(task, slots_N);
}

template <class Element>
void element_energies(const ThinWallTask<typename Element::Number>& task, typename Element::Number* energies_J,
                      typename Element::Number* smallest_ratios) {
  using T = typename Element::Lane;
  const AnyLaw<T> law(task);
  for (std::size_t batch = 0; batch < task.batches.count; ++batch) {
    Element elements(task, batch);
    elements.place();
    Lanes<T>::store(elements.energy(law, branch_of<Element>(task.branch, batch)), energies_J + Element::width * batch);
    Lanes<T>::store(elements.smallest_ratio(), smallest_ratios + Element::width * batch);
  }
}

template <class Element>
void rest_element_branches(const ThinWallTask<typename Element::Number>& task, typename Element::Number* branch) {
  for (std::size_t batch = 0; batch < task.batches.count; ++batch) {
    Element elements(task, batch);
    elements.place();
    elements.rest().store(branch_of<Element>(branch, batch));
  }
}

template <class T>
ThinWallOutcome thin_wall_forces(const ThinWallTask<NumberOf<T>>& task, NumberOf<T>* slots_N) {
  if (task.batches.element == ThinWallElement::wall) return element_forces<WallElement<T>>(task, slots_N);
  return element_forces<BlockElement<T>>(task, slots_N);
}

template <class T>
void thin_wall_energies(const ThinWallTask<NumberOf<T>>& task, NumberOf<T>* energies_J, NumberOf<T>* smallest_ratios) {
  if (task.batches.element == ThinWallElement::wall) {
    element_energies<WallElement<T>>(task, energies_J, smallest_ratios);
  } else {
    element_energies<BlockElement<T>>(task, energies_J, smallest_ratios);
  }
}

template <class T>
void rest_thin_wall_branches(const ThinWallTask<NumberOf<T>>& task, NumberOf<T>* branch) {
  if (task.batches.element == ThinWallElement::wall) {
    rest_element_branches<WallElement<T>>(task, branch);
  } else {
    rest_element_branches<BlockElement<T>>(task, branch);
  }
}

template <class T>
const ThinWallTable<NumberOf<T>>& thin_wall_table(const char* instruction_set) {
  static const ThinWallTable<NumberOf<T>> table{instruction_set,     Lanes<T>::count,       lane_places<T>(),
                                                thin_wall_forces<T>, thin_wall_energies<T>, rest_thin_wall_branches<T>};
  return table;
}

}  // namespace menger::fem::detail
