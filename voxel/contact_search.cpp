#include "voxel/contact_search.h"

#include <bit>

namespace menger::voxel {

template <class Real>
std::span<const std::int32_t> ContactSearch<Real>::touching(const VerletList& list, const Spheres<Real>& spheres,
                                                            const std::int32_t* first, const std::int32_t* second,
                                                            const std::array<double, 2>& size_m) {
  constexpr std::size_t bits = 64;
  marks_.assign(list.pairs().size() / bits + 1, 0);
  if (found_.size() < list.first().size()) found_.resize(list.first().size());
  for (const auto& [begin, end] : list.candidates(size_m)) {
    const std::size_t count = kernels_.touching(spheres, first + begin, second + begin, end - begin, found_.data());
    for (std::size_t i = 0; i < count; ++i) {
      const auto pair = static_cast<std::size_t>(list.order()[begin + static_cast<std::size_t>(found_[i])]);
      marks_[pair / bits] |= std::uint64_t{1} << (pair % bits);
    }
  }
  touching_.clear();
  for (std::size_t word = 0; word < marks_.size(); ++word) {
    for (std::uint64_t left = marks_[word]; left != 0; left &= left - 1)
      touching_.push_back(static_cast<std::int32_t>(bits * word + static_cast<std::size_t>(std::countr_zero(left))));
  }
  return touching_;
}

template class ContactSearch<double>;
template class ContactSearch<float>;

}  // namespace menger::voxel
