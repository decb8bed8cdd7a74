#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "evolution/findings/loop_verdict.h"
#include "evolution/findings/stage_finding.h"
#include "io/text/joined_text.h"
#include "io/text/whole_file.h"
#include "meshes/robot/robot_file.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {

/// A folder of results of a robot, a row of three cells, which tests write as the stages of a loop would.
class RobotResults : public testing::Test {
 protected:
  RobotResults() {
    io::write_whole(
        folder_ / "robot.toml",
        "[robot]\nlayers = [[\"111\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n[drive]\npressure_Pa = [0, 3000]\n");
    robot_ = meshes::read_robot(folder_ / "robot.toml");
  }

  void write_walk(const std::string& file, double x_m, double y_m, const std::string& lengths = "0.5") const {
    io::write_whole(folder_ / file, "status = \"completed\"\ntime_s = 5.0\ndisplacement_m = [" + std::to_string(x_m) + ", " +
                                        std::to_string(y_m) + ", 0.001]\nhorizontal_displacement_body_lengths = " + lengths +
                                        "\n");
  }

  /// Writes the frames of a walk: a cell that leans by some angle at the end of each stroke of a third of a second.
  void leave_frames(const std::string& stage, const std::vector<double>& leans_deg) const {
    std::string collection = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (std::size_t n = 0; n <= 2 * leans_deg.size(); ++n) {
      const double lean = (n == 0 ? 0.0 : leans_deg[(n - 1) / 2]) * std::numbers::pi / 180.0;
      std::string points;
      std::string moved;
      for (const double z : {0.0, 1.0}) {
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
          points += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " ";
          moved += std::to_string(x * std::cos(lean) + z * std::sin(lean) - x) + " 0 " +
                   std::to_string(z * std::cos(lean) - x * std::sin(lean) - z) + " ";
        }
      }
      const std::string name = "frame_" + std::to_string(n) + ".vtu";
      io::write_whole(
          folder_ / stage / name,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n<Piece "
          "NumberOfPoints=\"8\" NumberOfCells=\"1\">\n<PointData>\n<DataArray type=\"Float64\" "
          "Name=\"displacement_m\" NumberOfComponents=\"3\" format=\"ascii\">" +
              moved +
              "</DataArray>\n</PointData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
              "format=\"ascii\">" +
              points +
              "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 "
              "2 3 4 5 6 7</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" "
              "format=\"ascii\">8</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" "
              "format=\"ascii\">12</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
      collection +=
          "<DataSet timestep=\"" + std::to_string(static_cast<double>(n) / 6.0) + "\" part=\"0\" file=\"" + name + "\"/>\n";
    }
    io::write_whole(folder_ / stage / "frames.pvd", collection + "</Collection>\n</VTKFile>\n");
  }

  void write_early_walk(const std::string& file, double x_m) const {
    io::write_whole(folder_ / file, "status = \"diverged\"\nreason = \"too fast\"\ntime_s = 0.4\ndisplacement_m = [" +
                                        std::to_string(x_m) + ", 0, 0]\nhorizontal_displacement_body_lengths = 0.5\n");
  }

  /// Makes the robot a row of cells. @param more keys that follow those of its cells
  void take_robot(const std::string& row, const std::string& more) {
    io::write_whole(folder_ / "robot.toml",
                    "[robot]\nlayers = [[\"" + row + "\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n" + more);
    robot_ = meshes::read_robot(folder_ / "robot.toml");
  }
  void write_inflation(const std::string& status) const {
    io::write_whole(folder_ / "inflate/result.toml", "status = \"" + status + "\"\n");
  }

  void write_limit(const std::string& pressure_Pa) const {
    io::write_whole(folder_ / "limit/result.toml",
                    "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = " + pressure_Pa + "\n");
  }

  /// Writes the inflation of the stage validate, in which each number is a pressure.
  void write_validated(const std::string& status, const std::string& planned, const std::string& compared_rows) const {
    io::write_whole(folder_ / "validate/curves/robot_inflation.toml",
                    "status = \"" + status + "\"\n[case]\npressures_Pa = " + planned + "\n");
    io::write_whole(folder_ / "validate/curves/robot_inflation.csv", "pressure_Pa\n" + compared_rows);
  }

  /// Writes how far the surrogate is off in the shape of the robot, in the median of its displacements.
  void write_shape_error(const std::string& median) const {
    io::write_whole(folder_ / "validate/summary.csv", "body,kind,range,median\nall,displacement,inside," + median + "\n");
    io::write_whole(folder_ / "validate/signs.csv", "body,observable,count,wrong\nrobot,extent_x_m,5,0\n");
  }

  [[nodiscard]] std::string found(const std::string& stage) const { return stage_finding(stage, folder_, robot_); }
  [[nodiscard]] std::string verdict() const { return io::joined(loop_verdict(folder_, robot_, stages_), "\n"); }

  tests::TestFolder folder_;
  meshes::Robot robot_;
  std::set<std::string> stages_{"inflate", "limit", "validate", "simulate", "locomote", "locomote_finer"};
};

inline void expect_has(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// What follows a limit pressure in the finding of the stage limit.
inline const std::string too_high = " by these elements, which put it 1 to 12 % too high; the drive of 3 kPa is ";

}  // namespace menger::evolution
