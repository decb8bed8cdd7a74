#include "voxel/engine/contact_search.h"

#include <algorithm>
#include <bit>

namespace menger::voxel {

namespace {

/// Pairs are near if the gap between their spheres is at most this share of the skin. It is the flat optimum between many near
/// pairs and frequent searches for them.
constexpr double near_share = 0.25;

/// Bound on rounding errors of distances, as a share of the skin.
constexpr double rounding_share = 1e-3;

}  // namespace

template <class Real>
bool ContactSearch<Real>::holds_all_near(const VerletList& list, const std::int32_t* first,
                                         const std::array<double, 2>& size_m) const {
  if (number_ != list.number() || numbered_as_ != first) return false;
  const double closer = 2.0 * (list.path_m() - path_m_) + rounding_share * list.skin_m();
  const std::array<double, 3> reaches = VerletList::reaches_m(size_m);
  for (std::size_t kinds = 0; kinds < reaches.size(); ++kinds) {
    if (reaches[kinds] + closer > limits_m_[kinds]) return false;
  }
  return true;
}

template <class Real>
void ContactSearch<Real>::find_near(const VerletList& list, const Spheres<Real>& spheres, const std::int32_t* first,
                                    const std::int32_t* second, const std::array<double, 2>& size_m) {
  constexpr std::size_t bits = 64;
  number_ = list.number();
  numbered_as_ = first;
  path_m_ = list.path_m();
  const double further_m = near_share * list.skin_m();
  limits_m_ = VerletList::reaches_m(size_m);
  for (double& limit : limits_m_) limit += further_m;
  marks_.assign(list.pairs().size() / bits + 1, 0);
  if (found_.size() < list.first().size()) found_.resize(list.first().size());
  const auto parts = list.candidates(size_m, further_m);
  for (std::size_t kinds = 0; kinds < parts.size(); ++kinds) {
    const auto& [begin, end] = parts[kinds];
    const std::size_t count =
        kernels_.closer(spheres, first + begin, second + begin, end - begin, static_cast<Real>(limits_m_[kinds]), found_.data());
    for (std::size_t i = 0; i < count; ++i) {
      const auto pair = static_cast<std::size_t>(list.order()[begin + static_cast<std::size_t>(found_[i])]);
      marks_[pair / bits] |= std::uint64_t{1} << (pair % bits);
    }
  }
  near_.clear();
  first_.clear();
  second_.clear();
  for (std::size_t word = 0; word < marks_.size(); ++word) {
    for (std::uint64_t left = marks_[word]; left != 0; left &= left - 1) {
      const std::size_t pair = bits * word + static_cast<std::size_t>(std::countr_zero(left));
      const auto place = static_cast<std::size_t>(list.place()[pair]);
      near_.push_back(static_cast<std::int32_t>(pair));
      first_.push_back(first[place]);
      second_.push_back(second[place]);
    }
  }
  first_.resize(near_.size() + widest_pack<float>, 0);
  second_.resize(near_.size() + widest_pack<float>, 0);
}

template <class Real>
void ContactSearch<Real>::prepare(const VerletList& list, const Spheres<Real>& spheres, const std::int32_t* first,
                                  const std::int32_t* second, const std::array<double, 2>& size_m) {
  if (!holds_all_near(list, first, size_m)) find_near(list, spheres, first, second, size_m);
}

template <class Real>
std::span<const std::int32_t> ContactSearch<Real>::touching(const Spheres<Real>& spheres, std::size_t begin, std::size_t end,
                                                            std::vector<std::int32_t>& room) const {
  if (room.size() < end - begin + widest_pack<float>) room.resize(end - begin + widest_pack<float>);
  const std::size_t count = kernels_.touching(spheres, first_.data() + begin, second_.data() + begin, end - begin, room.data());
  for (std::size_t i = 0; i < count; ++i) room[i] = near_[begin + static_cast<std::size_t>(room[i])];
  return {room.data(), count};
}

template class ContactSearch<double>;
template class ContactSearch<float>;

}  // namespace menger::voxel
