#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fem/thin_walls/element_choice.h"
#include "io/study/study_visitor.h"
#include "meshes/design/design_file.h"

namespace menger::evolution {

/// A quantity that is compared between the models: its change from rest to the stated pressure in all chambers, for a free body
/// without weight.
enum class TradeObservable {
  volume_change,  ///< volume of all chambers together / their volume at rest - 1
  /// Growth (m) of the distance between the mean positions of the end faces along x, without the rotation of the body
  /// (meshes::extents_without_rotation).
  extent_x,
  extent_y,  ///< likewise along y
  extent_z   ///< likewise along z: growth of the distance from bottom to top
};
std::string column_of(TradeObservable observable);  ///< "volume_change", "extent_change_x_m", ...
std::size_t axis_of(TradeObservable observable);    ///< axis of an extent: 0, 1 or 2. Precondition: not volume_change

/// Finite-element fidelities: every combination is run, of thin-wall elements and of three-field elements.
struct ElementChoice {
  std::vector<fem::Fidelity> thin_walls{fem::Fidelity::draft, fem::Fidelity::standard, fem::Fidelity::fine};
  std::vector<int> degrees{1, 2};  ///< of three-field elements, as are the next: Q1/P0, Q2/P1
  std::vector<int> elements_through_wall{1, 2, 4};
  std::vector<double> bulk_ratios{50.0};       ///< bulk modulus / shear modulus
  std::vector<double> force_tolerances{1e-7};  ///< of Newton's method, relative
  double largest_unknowns = 200'000.0;         ///< fidelities with more unknowns are skipped
  double time_limit_s = 600.0;                 ///< of a run
};

/// Fidelities of the voxel engine: every combination is run, except float32 with damping from increments, which does not exist.
struct VoxelChoice {
  std::vector<std::string> numbers{"float64", "float32"};
  std::vector<std::string> dampings{"increments", "velocity"};
  std::vector<double> time_step_fractions{0.9, 0.45, 0.09};
  std::vector<std::string> exclusion_depths{"off", "1", "5"};  ///< of collisions
  double time_limit_s = 600.0;
};

/// Runs in which the calibrated body is brought to the pressure by a ramp and settles, one per parameters file.
struct SettlingChoice {
  std::vector<std::filesystem::path> parameters{};  ///< one per number of voxels per cell
  double ramp_s = 0.5;
  double settle_s = 1.0;        ///< after the ramp
  double global_damping = 0.1;  ///< damping ratio; changes the path to the equilibrium only
};

/// Runs in which the body walks, on the voxel engine alone.
struct GaitChoice {
  std::optional<std::filesystem::path> scene{};  ///< its physics is used; none: the default physics of the engine, from the paper
  double duration_s = 2.0;
};

/// Searches of equal cost, one for each surrogate fidelity and seed.
struct SearchChoice {
  std::filesystem::path study{};  ///< of `menger evolve`
  std::vector<int> seeds{1, 2, 3};
  double voxel_steps = 1e8;  ///< budget of a search: steps times voxels, over all evaluations
  int largest_generations = 1000;
  int threads = 1;
  double time_limit_s = 3600.0;  ///< of one call of a search
};

/// Everything that decides the results of a trade-off study.
struct TradeStudy {
  std::filesystem::path file;
  meshes::Design design;
  double wall_thickness_m = 0.002;
  std::string chambers = "single";  ///< or "per-phase"
  int level = 1;
  std::string silicone = "dragon_skin_10";  ///< for people
  std::filesystem::path silicone_file;
  std::string silicone_name;          ///< from its record
  std::string law;                    ///< recommended by the record, on one line
  double shear_modulus_Pa = 0.0;      ///< of the recommended law, at rest
  std::optional<double> pressure_Pa;  ///< none: 6 kPa, or 0.8 of the limit pressure if that is at most 6 kPa
  std::vector<TradeObservable> observables{TradeObservable::volume_change, TradeObservable::extent_x, TradeObservable::extent_y,
                                           TradeObservable::extent_z};
  std::vector<double> targets{0.2, 0.1, 0.05, 0.02, 0.01};  ///< relative errors to recommend for
  std::optional<ElementChoice> elements;
  VoxelChoice voxels;
  std::optional<SettlingChoice> settling;
  std::optional<GaitChoice> gait;
  std::optional<SearchChoice> search;
  bool only_search = false;                   ///< finite elements are then used for champions only
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read
};

/// Describes the keys of a study, for people: `menger tradeoff --keys`. A part without a table is not run. `[voxels]` applies to
/// settling, gait and search.
void describe(io::StudyVisitor& visitor, TradeStudy& study);

/// Reads a study, or a design file: then everything else has its default (finite elements and a gait). If a scene or a study of
/// searches names voxel parameters, their files are inputs too.
/// @throws io::InputError with file, key and value; also if nothing is to be run
TradeStudy read_trade_study(const std::filesystem::path& file);

/// Returns everything that decides the results, as text for the manifest.
std::string resolved_text(const TradeStudy& study);

}  // namespace menger::evolution
