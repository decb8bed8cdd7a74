#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "materials/laws/silicone_record.h"
#include "materials/laws/study_law.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"

namespace menger::meshes {

/// When the chambers of a robot are driven.
enum class RobotDrive {
  in_phase,   ///< all at the same time
  antiphase,  ///< those of material 2 half a period after those of material 1
  hold        ///< all have the highest pressure, all the time
};

/// How finely the walls of a robot are cut into finite elements.
enum class RobotFidelity { draft, standard, fine };

/// What moves the robots of a search.
enum class RobotSearchModel { finite_elements, voxels, both };

/// What a search rewards.
enum class RobotMeasure {
  last_periods,     ///< the displacement in one period, from the last five: walking
  net_displacement  ///< the displacement from start to end, which a fall may win
};

std::string_view to_string(RobotDrive drive);
std::string_view to_string(RobotFidelity fidelity);
std::string_view to_string(RobotSearchModel model);
std::string_view to_string(RobotMeasure measure);

/// A search for a body that walks, of the same cells, walls, silicone, drive and ground as the robot.
struct RobotSearch {
  RobotSearchModel model = RobotSearchModel::finite_elements;
  RobotMeasure measure = RobotMeasure::last_periods;
  bool robust = false;     ///< whether a robot counts as much as in the worst of several frictions and losses
  int generations = 6;     ///< after the first, >= 0
  int survivors = 12;      ///< of each generation, >= 1
  int mutants = 12;        ///< children in each generation, >= 0
  int evaluated_best = 3;  ///< robots that walk again on finer elements, >= 1
  std::uint64_t seed = 1;
};

/// A robot of silicone and what a person wants to know of it: the content of robot.toml. All studies of its loop follow from it.
struct Robot {
  std::filesystem::path file;  ///< from which it was read, for messages
  std::optional<std::filesystem::path> design_file{};
  Design design;         ///< without a cell if a search finds the body
  bool evolves = false;  ///< whether the body is that of the search's best robot
  double wall_thickness_m = 0.002;
  ChamberLayout chambers = ChamberLayout::single;
  std::string silicone;                                   ///< as robot.toml names it
  std::filesystem::path silicone_file;                    ///< the record that this means
  materials::SiliconeRecord record;                       ///< its content
  std::string law_name{materials::recommended_law_name};  ///< of a law in the record
  std::size_t law_variant = 1;                            ///< its number among laws of this name, from 1
  materials::SourcedLaw law;                              ///< the law that these mean
  std::optional<std::array<double, 2>> pressure_Pa{};     ///< lowest and highest gauge pressure; nothing: see drive_pressure_Pa
  double frequency_Hz = 3.0;
  RobotDrive drive = RobotDrive::in_phase;
  double static_friction = 1.0;
  double kinetic_friction = 0.5;
  bool walks = true;  ///< whether it is put on the ground and driven
  double duration_s = 5.0;
  RobotFidelity fidelity = RobotFidelity::standard;
  std::optional<std::filesystem::path> parameters{};  ///< of voxels, given by the user
  bool fits_anew = false;                             ///< whether parameters that come with menger are left aside
  std::optional<RobotSearch> search{};
  std::vector<std::string> notes{};  ///< what its file says in vain, or may not mean, for people

  [[nodiscard]] bool has_body() const { return design.body.count() > 0; }
  /// Distance between the walls of a cell, m.
  [[nodiscard]] double span_m() const { return design.cell_edge_m - 2.0 * wall_thickness_m; }
};

/// Returns the pressure that loads the walls of the robot as 6 kPa loads cells of 10 mm with walls of 2 mm in Dragon Skin 10, in
/// two digits. Limit pressures grow as shear modulus times wall thickness over span, and so does this one.
double usual_pressure_Pa(const Robot& robot);

/// Returns the lowest and highest pressure of the drive: those of the robot, or 0 and the usual pressure.
std::array<double, 2> drive_pressure_Pa(const Robot& robot);

/// Returns a pressure of cells of 10 mm with walls of 2 mm in Dragon Skin 10 as that of the robot which loads its walls likewise.
/// Vacuum bends walls inwards, so that it counts with the square of thickness over span.
double scaled_pressure_Pa(const Robot& robot, double pressure_Pa);

/// Returns a number rounded to two significant digits, so that it reads well in a study.
double two_digits(double value);

/// Returns the number of chambers of a robot that has a body.
std::size_t chamber_count(const Robot& robot);

/// Returns the robot in one sentence for people: body, cells, walls, silicone, chambers and drive.
std::string summary_of(const Robot& robot);

/// Returns the laws of the record of the robot's silicone but for its own.
std::vector<materials::SourcedLaw> other_laws_of(const Robot& robot);

/// Returns a law of a record for people, so that it is told from others of its name: with the beginning of its source, and its
/// number where there are several: "ogden1, Soft Robotics Materials Database, law_variant = 2".
std::string law_text(const materials::SourcedLaw& law, const materials::SiliconeRecord& record);

/// Returns the law of the robot's silicone in one sentence for people: its initial shear modulus and source, and how much softer
/// and stiffer the other laws of the record are. What a body bears goes nearly with this modulus.
std::string law_summary_of(const Robot& robot);

}  // namespace menger::meshes
