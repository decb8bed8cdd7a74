#pragma once

// The forces of one batch of elements, walls or blocks.

#include <cstddef>
#include <type_traits>

#include "fem/thin_walls/block_element.h"
#include "fem/thin_walls/wall_element.h"

namespace menger::fem::detail {

/// A law of one type, inside of the element's code.
template <class Law>
class InlineLaw {
 public:
  template <class Number>
  MENGER_HOST_DEVICE explicit InlineLaw(const ThinWallTask<Number>& task)
      : law_(*static_cast<const Law*>(task.law.parameters)), bulk_modulus_Pa_(task.bulk_modulus_Pa) {}
  template <class T>
  MENGER_HOST_DEVICE MembraneResponse<T> operator()(const PlaneMetric<T>& metric) const {
    return membrane_answer(law_, bulk_modulus_Pa_, metric);
  }
  template <class T>
  MENGER_HOST_DEVICE BlockResponse<T> operator()(const BlockGradient<T>& F) const {
    return block_answer(law_, F);
  }

 private:
  Law law_;
  double bulk_modulus_Pa_;
};

template <class Element>
using BranchOf = std::conditional_t<Element::kind == ThinWallElement::wall, WallBranch<typename Element::Lane>,
                                    BlockBranch<typename Element::Lane>>;

/// Numbers of one batch's branches, if there are any.
template <class Element, class Number>
MENGER_HOST_DEVICE Number* branch_of(Number* numbers, std::size_t batch) {
  return numbers == nullptr ? nullptr : numbers + thin_wall_branch_numbers(Element::kind) * Element::width * batch;
}

/// Places the elements of a batch, lets their branches relax where they do, and computes the forces without those of the pressure
/// on faces.
template <bool is_damped, class Element, class Law>
MENGER_HOST_DEVICE void compute_element_forces(const ThinWallTask<typename Element::Number>& task, std::size_t batch,
                                               const Law& law, Element& elements) {
  elements.place();
  BranchOf<Element> branch;
  if constexpr (is_damped) {
    branch.is_there = task.branch != nullptr;
    if (task.relaxing != nullptr) {
      branch = elements.relax(branch_of<Element>(task.relaxing, batch));
    } else if (branch.is_there) {
      branch = elements.load_branch(branch_of<Element>(task.branch, batch));
    }
  }
  elements.template compute_forces<is_damped>(law, branch);
}

}  // namespace menger::fem::detail
