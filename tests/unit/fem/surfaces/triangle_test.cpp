#include "fem/surfaces/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace menger::fem {
namespace {

double nearest_distance(const Triangle& first, const Triangle& second) {
  double nearest = 1e9;
  for_each_near_pair(first, second, [&](const Point& x, const Point& y) { nearest = std::min(nearest, norm(difference(x, y))); });
  return nearest;
}

TEST(Triangle, DistanceOfACornerToTheInsideOfAFace) {
  const Triangle face = triangle({0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0});
  const Triangle spike = triangle({1.0, 1.0, 0.5}, {1.0, 2.0, 3.0}, {2.0, 1.0, 3.0});
  EXPECT_DOUBLE_EQ(nearest_distance(face, spike), 0.5);
  EXPECT_DOUBLE_EQ(nearest_distance(spike, face), 0.5);
}

TEST(Triangle, DistanceOfCrossedEdges) {
  const Triangle below = triangle({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, -3.0});
  const Triangle above = triangle({0.0, -1.0, 0.7}, {0.0, 1.0, 0.7}, {1.0, 0.0, 4.0});
  EXPECT_DOUBLE_EQ(nearest_distance(below, above), 0.7);
  EXPECT_DOUBLE_EQ(nearest_distance(above, below), 0.7);
}

TEST(Triangle, DistanceOfCornersApart) {
  const Triangle left = triangle({0.0, 0.0, 0.0}, {-1.0, 0.5, 0.0}, {-1.0, -1.0, 0.0});
  const Triangle right = triangle({3.0, 4.0, 0.0}, {4.0, 4.0, 1.0}, {4.0, 5.0, 0.0});
  EXPECT_DOUBLE_EQ(nearest_distance(left, right), 5.0);
}

TEST(Triangle, NearestPointsOfParallelAndPointLikeSegments) {
  const auto parallel = nearest_points({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {1.0, 3.0, 0.0}, {5.0, 3.0, 0.0});
  EXPECT_DOUBLE_EQ(norm(difference(parallel[0], parallel[1])), 3.0);
  const auto apart = nearest_points({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {5.0, 4.0, 0.0}, {9.0, 4.0, 0.0});
  EXPECT_DOUBLE_EQ(norm(difference(apart[0], apart[1])), 5.0);
  const auto points = nearest_points({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 3.0, 4.0}, {0.0, 3.0, 4.0});
  EXPECT_DOUBLE_EQ(norm(difference(points[0], points[1])), 5.0);
}

TEST(Triangle, HasNoNormalWithoutArea) {
  EXPECT_EQ(triangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}).normal, (Point{}));
}

}  // namespace
}  // namespace menger::fem
