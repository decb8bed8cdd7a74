#include "evolution/trade_off/trade_off_voxels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "evolution/trade_off/trade_off_runner.h"
#include "evolution/trade_off/trade_off_variant.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr double records_of_settling = 10.0;  ///< few, but enough to see whether it came to rest
constexpr double usual_step_s = 5e-5;         ///< recommended step of the paper's physics for cells of 1 cm

/// Returns how coarse an exclusion depth is: a larger depth checks fewer pairs for collisions.
double coarseness(const std::string& exclusion_depth) {
  return exclusion_depth == "off" ? std::numeric_limits<double>::infinity() : std::stod(exclusion_depth);
}

double estimated_s(const TradeStudy& study, const VoxelFidelity& fidelity, double duration_s) {
  double voxels = 1.0;
  for (int level = 0; level < study.level; ++level) voxels *= static_cast<double>(study.design.body.count());
  const double steps = duration_s / (usual_step_s * fidelity.time_step_fraction);
  return 0.3 + steps * voxels / usual_voxel_steps_per_s;
}

io::ProgramJob scene_job(const TradeStudy& study, const VoxelFidelity& fidelity, const fs::path& program, double duration_s) {
  io::ProgramJob job;
  job.program = program;
  job.arguments = {"scene.toml", "-o", "result", "--no-pictures"};
  job.inputs = {{"design.toml", meshes::design_text(study.design)}};
  job.time_limit_s = study.voxels.time_limit_s;
  job.estimated_s = estimated_s(study, fidelity, duration_s);
  return job;
}

}  // namespace

std::vector<VoxelFidelity> voxel_fidelities(const VoxelChoice& choice, const std::vector<fs::path>& parameters) {
  std::vector<std::optional<fs::path>> bodies(parameters.begin(), parameters.end());
  if (bodies.empty()) bodies.emplace_back();
  std::vector<VoxelFidelity> all;
  for (const auto& body : bodies) {
    const std::size_t first = all.size();
    for (const std::string& number : choice.numbers) {
      for (const std::string& damping : choice.dampings) {
        if (number == "float32" && damping == "increments") continue;
        for (const double fraction : choice.time_step_fractions) {
          for (const std::string& depth : choice.exclusion_depths) all.push_back({number, damping, fraction, depth, body});
        }
      }
    }
    const auto fineness = [](const VoxelFidelity& f) {
      return std::tuple(-coarseness(f.exclusion_depth), -f.time_step_fraction, f.number == "float64", f.damping == "increments");
    };
    std::stable_sort(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                     [&](const VoxelFidelity& a, const VoxelFidelity& b) { return fineness(a) < fineness(b); });
  }
  return all;
}

TradeRow voxel_row(const VoxelFidelity& fidelity, std::optional<int> voxels_per_cell) {
  TradeRow row{.model = "voxels", .label = {}};
  row.label = fidelity.number + ", damping from " + (fidelity.damping == "velocity" ? "velocities" : "increments") +
              ", time step fraction " + io::number_text(fidelity.time_step_fraction) + ", collisions " +
              (fidelity.exclusion_depth == "off" ? "off" : "with exclusion depth " + fidelity.exclusion_depth);
  row.fidelity = {{"number", fidelity.number},
                  {"damping", fidelity.damping},
                  {"time_step_fraction", io::number_text(fidelity.time_step_fraction)},
                  {"exclusion_depth", fidelity.exclusion_depth}};
  if (fidelity.parameters) row.fidelity["parameters"] = fidelity.parameters->filename().string();
  if (voxels_per_cell) {
    row.fidelity["voxels_per_cell"] = std::to_string(*voxels_per_cell);
    row.label += ", " + std::to_string(*voxels_per_cell) + " per cell edge";
  }
  return row;
}

std::string integration_text(const VoxelFidelity& fidelity) {
  const std::string& depth = fidelity.exclusion_depth;
  return io::TomlText()
      .table("collisions")
      .raw("exclusion_depth", depth == "off" ? io::toml_quoted(depth) : depth)
      .table("integration")
      .add("number", fidelity.number)
      .add("damping", fidelity.damping)
      .add("time_step_fraction", fidelity.time_step_fraction)
      .text();
}

io::ProgramJob settling_job(const TradeStudy& study, const VoxelFidelity& fidelity, double pressure_Pa, const fs::path& program) {
  const SettlingChoice& choice = *study.settling;
  const double duration_s = choice.ramp_s + choice.settle_s;
  io::ProgramJob job = scene_job(study, fidelity, program, duration_s);
  job.name = "settling: " + voxel_row(fidelity, std::nullopt).label;
  job.inputs["parameters.toml"] = io::read_whole(*fidelity.parameters);
  io::TomlText scene;
  scene.table("design").add("file", "design.toml").add("level", study.level);
  scene.table("time").add("duration_s", duration_s).add("record_interval_s", duration_s / records_of_settling);
  scene.table("output").add("frames", true).add("pictures", false);
  scene.table("loads").add("gravity_m_per_s2", 0.0);
  scene.table("ground").add("present", false);
  scene.table("damping").add("global", choice.global_damping);
  scene.table("drive").add("mode", "hold").add("ramp_s", choice.ramp_s);
  scene.add("pressure_Pa", std::vector<double>{pressure_Pa, pressure_Pa});
  scene.table("surrogate").add("parameters", "parameters.toml").add("chambers", study.chambers);
  scene.add("wall_thickness_m", study.wall_thickness_m).add("outside_range", "warn");
  job.inputs["scene.toml"] = scene.lines(integration_text(fidelity)).text();
  return job;
}

io::ProgramJob gait_job(const TradeStudy& study, const VoxelFidelity& fidelity, const fs::path& program) {
  const GaitChoice& choice = *study.gait;
  io::ProgramJob job = scene_job(study, fidelity, program, choice.duration_s);
  job.name = "gait: " + voxel_row(fidelity, std::nullopt).label;
  TomlVariant scene = choice.scene ? TomlVariant(*choice.scene) : TomlVariant();
  scene.remove("design");
  scene.set({"design", "file"}, "design.toml");
  scene.set({"design", "level"}, study.level);
  scene.set({"time", "duration_s"}, choice.duration_s);
  scene.set({"time", "record_interval_s"}, choice.duration_s);
  scene.set({"energy_ledger"}, false);
  scene.set({"output", "frames"}, false);
  scene.set({"output", "pictures"}, false);
  set_integration(scene, fidelity);
  add_input(job, "scene.toml", std::move(scene));
  return job;
}

bool read_voxel_summary(const io::ProgramJobResult& result, TradeRow& row) {
  const io::TomlTable summary = read_summary(result, row);
  row.voxels = summary.integer<std::uint64_t>("voxels", io::at_least(0));
  row.steps = summary.integer<std::uint64_t>("steps", io::at_least(0));
  if (const auto surrogate = summary.optional_table("surrogate")) row.outside_validity = surrogate->texts("outside_validity");
  return row.status == "completed";
}

void read_gait_result(const io::ProgramJobResult& result, TradeRow& row) {
  if (!read_voxel_summary(result, row)) return;
  row.values = {io::read_toml(result.folder / "result/result.toml").number("horizontal_displacement_m", io::non_negative())};
}

}  // namespace menger::evolution
