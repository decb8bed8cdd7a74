#include "meshes/hexahedra/hollow_body_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/text/input_error.h"
#include "meshes/design/reference_shapes.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::meshes {
namespace {

std::string refusal(const Design& design, const HollowBodyOptions& options) {
  try {
    static_cast<void>(hollow_polycube(design, options));
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HollowBodyCheck, RefusesWhatCannotBeCast) {
  const auto contains = [](const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; };
  HollowBodyOptions thick;
  thick.wall_thickness_m = 0.005;
  EXPECT_TRUE(contains(refusal({"bar", bar(3), 0.01}, thick), "design bar: wall_thickness_m = 0.005: must be smaller than half"));
  const std::string edge = refusal({"edge", Polycube::from_digits(2, 2, 2, "10111001"), 0.01}, {});
  EXPECT_TRUE(contains(edge, "only along an edge")) << edge;
  const std::string ring = refusal({"ring", Polycube::from_digits(2, 2, 2, "10011111"), 0.01}, {});
  EXPECT_TRUE(contains(ring, "cells (0, 0, 0) and (1, 1, 0) touch only along an edge")) << ring;
  EXPECT_TRUE(contains(refusal({"two", Polycube::from_digits(3, 1, 1, "101"), 0.01}, {}), "consists of 2 parts"));
  EXPECT_TRUE(contains(refusal({"none", Polycube(1, 1, 1), 0.01}, {}), "empty"));
}

TEST(HollowBodyCheck, RefusesOptionsThatMakeNoSense) {
  const auto with = [](const auto& change) {
    HollowBodyOptions options;
    change(options);
    return refusal(hollow_cube_design(0.02), options);
  };
  EXPECT_EQ(with([](HollowBodyOptions&) {}), "accepted");
  const std::string name = "design hollow cube: ";
  const auto refused = [&](const std::string& text, const std::string& option) { return text.starts_with(name + option); };
  EXPECT_TRUE(refused(with([](auto& o) { o.wall_thickness_m = -0.001; }), "wall_thickness_m = -0.001"));
  EXPECT_TRUE(refused(with([](auto& o) { o.wall_thickness_m = std::nan(""); }), "wall_thickness_m"));
  EXPECT_TRUE(refused(with([](auto& o) { o.elements_through_wall = 0; }), "elements_through_wall = 0"));
  EXPECT_TRUE(refused(with([](auto& o) { o.elements_through_wall = 1001; }), "elements_through_wall = 1001"));
  EXPECT_TRUE(refused(with([](auto& o) { o.largest_element_m = 1e-9; }), "largest_element_m = 1e-09"));
  EXPECT_TRUE(refused(with([](auto& o) { o.wall_thickness_m = 1e-6; }), "wall_thickness_m = 1e-06: wall and chamber"));
  EXPECT_TRUE(refused(with([](auto& o) { o.wall_thickness_m = 0.01 - 1e-7; }), "wall_thickness_m = 0.0099999: wall and chamber"));
  EXPECT_TRUE(refused(with([](auto& o) {
                        o.wall_thickness_m = 2e-5;
                        o.elements_through_wall = 1000;
                      }),
                      "elements_through_wall = 1000: elements of 2e-08 m are too small"));
  EXPECT_TRUE(refused(with([](auto& o) { o.tubes = {{{0, 0, 0}, Side::x_min, 1e-15}}; }), "tubes.edge_m = 1e-15"));
  EXPECT_TRUE(refused(with([](auto& o) { o.elements_through_wall = 1000; }), "the grid of the mesh would have 1"));
  EXPECT_TRUE(refused(with([](auto& o) { o.largest_element_m = 0.0; }), "largest_element_m = 0"));
  EXPECT_TRUE(refused(with([](auto& o) { o.growth = 0.9; }), "growth = 0.9"));
  EXPECT_TRUE(refused(with([](auto& o) { o.level = 0; }), "level = 0"));
  EXPECT_TRUE(refused(with([](auto& o) { o.hole_edge_m = 0.002; }), "hole_edge_m = 0.002: holes join modules"));
  EXPECT_TRUE(refused(with([](auto& o) { o.tubes = {{{0, 0, 0}, Side::x_min, 0.017}}; }), "tubes.edge_m = 0.017"));
  EXPECT_TRUE(refused(with([](auto& o) {
                        o.tubes = {{{1, 0, 0}, Side::x_min, 0.002}};
                      }),
                      "tube hole at side x min of cell (1, 0, 0): there is no such cell"));
  EXPECT_TRUE(refused(with([](auto& o) {
                        o.tubes = {{{}, Side::x_min, 0.002}, {{}, Side::x_min, 0.004}};
                      }),
                      "tube hole at side x min of cell (0, 0, 0): is given twice"));
  HollowBodyOptions inside;
  inside.tubes = {{{0, 0, 0}, Side::x_max, 0.002}};
  EXPECT_NE(refusal({"bar", bar(2), 0.01}, inside).find("another cell lies at that side"), std::string::npos);
}

}  // namespace
}  // namespace menger::meshes
