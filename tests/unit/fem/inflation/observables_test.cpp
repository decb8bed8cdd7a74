#include "fem/inflation/observables.h"

#include <gtest/gtest.h>

#include <string>

#include "io/text/input_error.h"
#include "tests/unit/fem/statics/hollow_cube_space.h"

namespace menger::fem {
namespace {

const std::vector<NamedPoint> places{{"corner", {0.0, 0.0, 0.0}},
                                     {"top centre", {0.01, 0.01, 0.02}},
                                     {"in the wall", {0.0017, 0.0113, 0.0031}},
                                     {"on the chamber", {0.004, 0.009, 0.0111}}};

TEST(Observables, ShapeFunctionsGiveThePlaceBack) {
  for (const int degree : {1, 2}) {
    const Space space = hollow_cube_space(degree);
    for (const LocatedPoint& point : locate_points(space, places)) {
      Point place{};
      double total = 0.0;
      for (std::size_t a = 0; a < point.nodes.size(); ++a) {
        place = sum(place, scaled(point.weights[a], space.positions[static_cast<std::size_t>(point.nodes[a])]));
        total += point.weights[a];
      }
      EXPECT_NEAR(total, 1.0, 1e-12) << point.point.name;
      EXPECT_NEAR(norm(difference(place, point.point.position)), 0.0, 1e-14) << point.point.name;
    }
  }
}

TEST(Observables, OfAnAffineDeformationAreItsOwn) {
  const Space space = hollow_cube_space(1);
  const auto move = [](const Point& X) { return Point{0.3 * X[0] + 0.1 * X[1], -0.1 * X[1], 0.2 * X[2]}; };
  const std::vector<double> displacements = at_nodes(space, move);
  NodalFields fields;
  const std::array<double, 9> F{1.3, 0.1, 0.0, 0.0, 0.9, 0.0, 0.0, 0.0, 1.2};
  fields.deformation_gradient.assign(space.positions.size(), F);
  const std::vector<PointObservation> observations = observe(space, locate_points(space, places), displacements, fields);
  for (std::size_t p = 0; p < places.size(); ++p) {
    EXPECT_NEAR(norm(difference(observations[p].displacement_m, move(places[p].position))), 0.0, 1e-14) << places[p].name;
    EXPECT_NEAR(observations[p].largest_stretch, principal_stretches(F)[0], 1e-13);
  }
}

TEST(Observables, RefuseAPointInTheChamberAndOneOutsideByName) {
  const Space space = hollow_cube_space(2);
  for (const Point& position : {Point{0.01, 0.01, 0.01}, Point{0.0, 0.0, 0.021}}) {
    try {
      static_cast<void>(locate_points(space, {{"nowhere", position}}));
      FAIL() << "accepted";
    } catch (const io::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("nowhere"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("position_m"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace menger::fem
