#include "voxel/engine/collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "voxel/engine/contact_search.h"
#include "voxel/engine/voxel_state.h"
#include "voxel/kernels/instruction_sets.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Beams between two voxels on the shortest way, by breadth-first search; -1 if there is no way.
int beams_between(const Lattice& lattice, std::int32_t from, std::int32_t to) {
  std::vector<int> distance(lattice.voxel_count(), -1);
  std::vector<std::int32_t> queue{from};
  distance[static_cast<std::size_t>(from)] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::int32_t next : lattice.neighbours[static_cast<std::size_t>(queue[i])]) {
      if (next < 0 || distance[static_cast<std::size_t>(next)] >= 0) continue;
      distance[static_cast<std::size_t>(next)] = distance[static_cast<std::size_t>(queue[i])] + 1;
      queue.push_back(next);
    }
  }
  return distance[static_cast<std::size_t>(to)];
}

Pairs all_close_pairs(const Lattice& lattice, const std::vector<double>& positions, double cutoff, int depth) {
  Pairs pairs;
  const std::vector<std::int32_t> surface = lattice.surface();
  for (const std::int32_t i : surface) {
    for (const std::int32_t j : surface) {
      if (j <= i) continue;
      double distance2 = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double apart =
            positions[3 * static_cast<std::size_t>(i) + axis] - positions[3 * static_cast<std::size_t>(j) + axis];
        distance2 += apart * apart;
      }
      if (distance2 >= cutoff * cutoff) continue;
      const int between = beams_between(lattice, i, j);
      if (between < 0 || between > depth) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

std::vector<double> shaken_positions(const Lattice& lattice, double amplitude) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> shake(-amplitude, amplitude);
  std::vector<double> positions;
  for (const meshes::CellIndex& cell : lattice.cells) {
    for (const int index : {cell.x, cell.y, cell.z}) positions.push_back(0.01 * index + shake(generator));
  }
  return positions;
}

TEST(VerletList, HoldsEveryClosePairThatMayCollide) {
  const Lattice lattice(meshes::fractal(meshes::menger_sponge(), 2));
  const std::vector<double> positions = shaken_positions(lattice, 0.006);
  for (const int depth : {1, 2, 5}) {
    VerletList list(CollisionRule(lattice, depth), 0.0143, 0.004);
    list.build(positions.data(), 3);
    EXPECT_EQ(list.pairs(), all_close_pairs(lattice, positions, 0.0183, depth)) << depth;
    EXPECT_FALSE(list.pairs().empty());
  }
}

TEST(VerletList, FindsPairsWhenAFragmentHasFlownFarAway) {
  meshes::Polycube body(6, 1, 1);
  for (const int x : {0, 2, 4, 5}) body.set({x, 0, 0}, 1);
  const Lattice lattice(body);
  const std::vector<double> positions{0.0, 0.0, 0.0, 0.012, 0.0, 0.0, 1e6, 0.0, -1e6, 1e6 + 0.01, 0.0, -1e6};
  VerletList list(CollisionRule(lattice, 1), 0.0143, 0.004);
  list.build(positions.data(), 3);
  EXPECT_EQ(list.pairs(), (Pairs{{0, 1}}));
}

TEST(VerletList, IsMadeAnewOnlyWhenDisplacementsCouldMatter) {
  const Lattice lattice(meshes::menger_sponge());
  std::vector<double> positions = shaken_positions(lattice, 0.0);
  VerletList list(CollisionRule(lattice, 1), 0.0143, 0.004);
  EXPECT_TRUE(list.refresh(positions.data(), 3));
  for (int i = 0; i < 100; ++i) {
    // Shakes back and forth: the sum of steps grows, the displacement does not.
    positions[0] += i % 2 == 0 ? 0.0005 : -0.0005;
    list.moved(0.0005);
    EXPECT_FALSE(list.refresh(positions.data(), 3)) << i;
  }
  positions[0] += 0.003;
  list.moved(0.003);
  EXPECT_FALSE(list.refresh(positions.data(), 3))
      << "nothing else moved: no pair came closer by more than three quarters of a skin";
  positions[0] += 0.0011;
  list.moved(0.0011);
  EXPECT_TRUE(list.refresh(positions.data(), 3));
}

/// How often a list is made while a body goes from where it stands along a way, per position and share of the way; at all times
/// it must hold every pair that may touch.
template <class Way>
std::uint64_t lists_made_on(const Lattice& lattice, const Way& way) {
  constexpr int steps = 300;
  constexpr double reach = 0.0143;
  VerletList list(CollisionRule(lattice, 1), reach, 0.004);
  const std::vector<double> start = shaken_positions(lattice, 0.001);
  std::vector<double> before = start;
  for (int step = 0; step <= steps; ++step) {
    std::vector<double> now = start;
    double largest = 0.0;
    for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
      way(static_cast<double>(step) / steps, now.data() + 3 * i);
      largest = std::max(largest, std::hypot(now[3 * i] - before[3 * i], now[3 * i + 1] - before[3 * i + 1],
                                             now[3 * i + 2] - before[3 * i + 2]));
    }
    list.moved(largest);
    static_cast<void>(list.refresh(now.data(), 3));
    if (step % 10 == 0) {
      const Pairs close = all_close_pairs(lattice, now, reach, 1);
      EXPECT_TRUE(std::includes(list.pairs().begin(), list.pairs().end(), close.begin(), close.end())) << step;
    }
    before = now;
  }
  return list.number();
}

TEST(VerletList, IsKeptWhileAPartGoesWithAllThatIsNearIt) {
  const Lattice lattice(meshes::fractal(meshes::Polycube::from_digits(3, 3, 3, "102000201111211112000000000"), 2));
  const auto walks = [](double share, double* at) {
    at[0] += 0.1 * share;  // 25 skins, which alone would make 50 lists
    at[1] += 0.001 * std::sin(6.28 * share) * at[2] / 0.1;
  };
  EXPECT_EQ(lists_made_on(lattice, walks), 1U);
  const auto is_squashed = [](double share, double* at) { at[2] *= 1.0 - 0.6 * share; };
  EXPECT_GT(lists_made_on(lattice, is_squashed), 4U);
  const auto is_folded = [](double share, double* at) {  // one half moves onto the other
    if (at[0] > 0.05) at[0] -= 0.05 * share;
  };
  EXPECT_GT(lists_made_on(lattice, is_folded), 4U);
}

// Neither piece moves against what is near it: what makes the list anew is how far they moved against each other.
TEST(VerletList, IsMadeAnewWherePiecesMeetThatWereFarApart) {
  std::string digits;
  for (int row = 0; row < 9; ++row) digits += "111000000000111";
  const Lattice lattice(meshes::Polycube::from_digits(15, 3, 3, digits));
  const auto meet = [](double share, double* at) {
    if (at[0] > 0.06) at[0] -= 0.1 * share;
  };
  const std::uint64_t lists = lists_made_on(lattice, meet);
  EXPECT_GT(lists, 1U);
  EXPECT_LT(lists, 20U) << "of 300 steps";
}

/// Positions in `pairs` of those whose spheres overlap, by looking at every one.
template <class Real>
std::vector<std::int32_t> overlapping(const Pairs& pairs, const AlignedArray<Real>& spheres) {
  std::vector<std::int32_t> touching;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Real* a = spheres.data() + 4 * pairs[i].first;
    const Real* b = spheres.data() + 4 * pairs[i].second;
    const Vector3<Real> apart = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Real reach = static_cast<Real>(collision_radius_fraction) * (a[3] + b[3]);
    if (spheres_overlap(dot(apart, apart), reach)) touching.push_back(static_cast<std::int32_t>(i));
  }
  return touching;
}

/// A search per instruction set of this machine.
template <class Real>
std::vector<ContactSearch<Real>> searches() {
  std::vector<ContactSearch<Real>> all;
  for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    try {
      all.emplace_back(kernels_for<Real>(resolve(set)));
    } catch (const std::invalid_argument&) {
    }
  }
  return all;
}

/// Voxels of two kinds swell and shrink while they move as far as the list allows; what searches find that remember which pairs
/// were near, and what one finds that does not, is compared with a look at every pair.
template <class Real>
void expect_all_touching_pairs(bool two_kinds) {
  const Lattice lattice(meshes::fractal(meshes::menger_sponge(), 2));
  std::vector<double> positions = shaken_positions(lattice, 0.002);
  const double largest_size = 0.0115;
  VerletList list(CollisionRule(lattice, 1), 2.0 * collision_radius_fraction * largest_size, 0.004);
  std::vector<std::uint8_t> kind;
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) kind.push_back(i % 3 == 0 ? 1 : 0);
  if (two_kinds) list.set_kinds(kind);
  list.build(positions.data(), 3);
  std::vector<ContactSearch<Real>> all = searches<Real>();
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  std::vector<double> direction;
  for (std::size_t i = 0; i < positions.size(); ++i) direction.push_back(component(generator) / std::sqrt(3.0));
  std::size_t most = 0;
  std::size_t fewest = list.pairs().size();
  std::size_t looked_at = 0;
  constexpr int steps = 200;
  const double way = 0.002 / steps;  // together half of the skin
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += way * direction[i];
    list.moved(way);
    const double swelling = 0.0015 * std::sin(0.09 * step);
    const std::array<double, 2> size_m{0.01 + swelling, 0.01 - swelling};
    AlignedArray<Real> spheres;
    for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) spheres.push_back(static_cast<Real>(positions[3 * i + axis]));
      spheres.push_back(static_cast<Real>(size_m[kind[i]]));
    }
    const std::vector<std::int32_t> expected = overlapping(list.pairs(), spheres);
    most = std::max(most, expected.size());
    fewest = std::min(fewest, expected.size());
    const std::array<double, 2> told = two_kinds ? size_m : std::array<double, 2>{largest_size, largest_size};
    for (const auto& [begin, end] : list.candidates(told)) looked_at += end - begin;
    const auto expect_found_by = [&](ContactSearch<Real>& search) {
      const Spheres<Real> now{spheres.data(), 4};
      search.prepare(list, now, list.first().data(), list.second().data(), told);
      std::vector<std::int32_t> in_parts;
      std::vector<std::int32_t> room;
      const std::size_t half = search.near_count() / 2;
      for (const auto& [begin, end] : {std::pair(std::size_t{0}, half), std::pair(half, search.near_count())}) {
        const auto found = search.touching(now, begin, end, room);
        in_parts.insert(in_parts.end(), found.begin(), found.end());
      }
      EXPECT_EQ(in_parts, expected) << step;
    };
    for (ContactSearch<Real>& search : all) expect_found_by(search);
    ContactSearch<Real> forgetful(kernels_for<Real>(InstructionSet::scalar));
    expect_found_by(forgetful);
  }
  EXPECT_GT(fewest, 0U);
  EXPECT_GT(most, 2 * fewest) << "sizes matter";
  EXPECT_LT(looked_at, steps * list.pairs().size()) << "some pairs are left out";
}

TEST(ContactSearch, FindsAllPairsThatTouch) {
  expect_all_touching_pairs<double>(true);
  expect_all_touching_pairs<double>(false);
  expect_all_touching_pairs<float>(true);
  expect_all_touching_pairs<float>(false);
}

TEST(CollisionRule, KnowsWhenNoPairIsLeft) {
  EXPECT_TRUE(CollisionRule(Lattice(meshes::bar(3)), 2).excludes_every_pair());
  EXPECT_FALSE(CollisionRule(Lattice(meshes::bar(4)), 2).excludes_every_pair());
  meshes::Polycube apart(3, 1, 1);
  apart.set({0, 0, 0}, 1);
  apart.set({2, 0, 0}, 1);
  EXPECT_FALSE(CollisionRule(Lattice(apart), 1000).excludes_every_pair()) << "voxels that no beam joins may always collide";
}

TEST(Collisions, KeepAFoldedBodyApart) {
  // Two bars pressed against each other: without collisions they pass through, with them they stay apart.
  meshes::Polycube body(3, 3, 1);
  for (int x = 0; x < 3; ++x) {
    body.set({x, 0, 0}, 1);
    body.set({x, 2, 0}, 1);
  }
  Physics physics;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.actuation.mode = ActuationMode::none;
  VoxelLoads loads;
  for (int i = 0; i < 6; ++i) loads.force_N.push_back({0.0, i < 3 ? 0.002 : -0.002, 0.0});
  const auto gap = [&] {
    Simulation simulation(body, 0.01, physics, loads);
    EXPECT_EQ(simulation.advance_to(0.5), io::RunStatus::completed);
    return simulation.position_m(3)[1] - simulation.position_m(0)[1];
  };
  // At rest the force is carried by the overlap with the opposite voxel and its two neighbours; the gap is close to the diameter
  // of a sphere.
  EXPECT_NEAR(gap(), 0.0125, 5e-5);
  physics.collisions.exclusion_depth.reset();
  EXPECT_LT(gap(), 0.0);
}

TEST(Collisions, ShowInTheFrame) {
  meshes::Polycube body(2, 1, 2);
  body.set({0, 0, 0}, 1);
  body.set({0, 0, 1}, 1);
  body.set({1, 0, 0}, 1);
  Physics physics;
  physics.actuation.mode = ActuationMode::none;
  Simulation simulation(body, 0.01, physics);
  ASSERT_EQ(simulation.advance(10), io::RunStatus::completed);
  const Frame frame = simulation.frame();
  // The two ends of the corner are 1.41 edges apart, spheres reach 1.25 edges: no contact at rest, but the floor carries two
  // voxels.
  EXPECT_EQ(frame.contact[0] & contact::other_voxel, 0);
  EXPECT_NE(frame.contact[0] & contact::floor_static, 0);
  EXPECT_EQ(frame.contact[2], contact::none);

  // Moved 2 mm towards each other the ends overlap.
  VoxelLoads loads;
  loads.initial_displacement_m = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.002, 0.0, -0.002}};
  Simulation bent(body, 0.01, physics, loads);
  ASSERT_EQ(bent.advance(1), io::RunStatus::completed);
  EXPECT_NE(bent.frame().contact[1] & contact::other_voxel, 0);
  EXPECT_NE(bent.frame().contact[2] & contact::other_voxel, 0);
  EXPECT_EQ(bent.frame().contact[0] & contact::other_voxel, 0);
}

}  // namespace
}  // namespace menger::voxel
