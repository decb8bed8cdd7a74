#include "fem/locomotion/locomotion_checkpoint.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "io/process/checkpoint_file.h"
#include "io/text/input_error.h"
#include "io/text/run_status_words.h"
#include "io/text/version.h"

namespace menger::fem {
namespace {

using Json = nlohmann::json;

constexpr std::string_view title = "menger locomotion checkpoint 8";

/// Reads consecutive values, starting at a place.
template <class... Values>
void take(const Json& json, std::size_t first, Values&... values) {
  (json.at(first++).get_to(values), ...);
}

// The structured bindings name all members of a struct. So code with an added member does not compile until the member is kept
// here, too.

Json to_json(const MotionWork& work) {
  const auto& [pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping] = work;
  return {pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping};
}

MotionWork work_from(const Json& json) {
  MotionWork work;
  auto& [pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping] = work;
  take(json, 0, pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping);
  return work;
}

Json to_json(const PneumaticState& air) {
  const auto& [time, volumes, plenum_air, piston_air, source_air, work] = air;
  const auto& [piston, source, plenum, line] = work;
  return {time, volumes, plenum_air, piston_air, source_air, piston, source, plenum, line};
}

PneumaticState air_from(const Json& json) {
  PneumaticState air;
  auto& [time, volumes, plenum_air, piston_air, source_air, work] = air;
  auto& [piston, source, plenum, line] = work;
  take(json, 0, time, volumes, plenum_air, piston_air, source_air, piston, source, plenum, line);
  return air;
}

Json to_json(const ContactMemory& memory) {
  const auto& [node, face, depth, pressed, paid, spring, slip, is_sliding] = memory;
  return {node, face, depth, pressed, paid, spring, slip, is_sliding};
}

ContactMemory memory_from(const Json& json) {
  ContactMemory memory;
  auto& [node, face, depth, pressed, paid, spring, slip, is_sliding] = memory;
  take(json, 0, node, face, depth, pressed, paid, spring, slip, is_sliding);
  return memory;
}

Json to_json(const std::vector<ContactMemory>& memories) {
  Json list = Json::array();
  for (const ContactMemory& memory : memories) list.push_back(to_json(memory));
  return list;
}

Json to_json(const BranchState& branches) {
  const auto& [numbers, age] = branches;
  return {numbers.index(), std::visit([](const auto& list) { return Json(list); }, numbers), age};
}

BranchState branches_from(const Json& json) {
  BranchState branches;
  auto& [numbers, age] = branches;
  if (json.at(0).get<std::size_t>() == 1) numbers.emplace<1>();
  std::visit([&](auto& list) { json.at(1).get_to(list); }, numbers);
  json.at(2).get_to(age);
  return branches;
}

Json to_json(const ExplicitState& state) {
  const auto& [time, displacements, velocities, last_step, steps, steps_to_bound, steps_since_bound, stable_step, step_share,
               work, at_start, turnover, air, contact, branches, pressures, volumes] = state;
  return {time,
          displacements,
          velocities,
          last_step,
          steps,
          steps_to_bound,
          steps_since_bound,
          stable_step,
          step_share,
          to_json(work),
          turnover,
          at_start ? Json(*at_start) : Json(),
          air ? to_json(*air) : Json(),
          contact ? to_json(*contact) : Json(),
          branches ? to_json(*branches) : Json(),
          pressures,
          volumes.walls_m3,
          volumes.chambers_m3};
}

ExplicitState explicit_state_from(const Json& json) {
  ExplicitState state;
  auto& [time, displacements, velocities, last_step, steps, steps_to_bound, steps_since_bound, stable_step, step_share, work,
         at_start, turnover, air, contact, branches, pressures, volumes] = state;
  take(json, 0, time, displacements, velocities, last_step, steps, steps_to_bound, steps_since_bound, stable_step, step_share);
  work = work_from(json.at(9));
  json.at(10).get_to(turnover);
  if (!json.at(11).is_null()) at_start = json.at(11).get<double>();
  if (!json.at(12).is_null()) air = air_from(json.at(12));
  if (!json.at(13).is_null()) {
    contact.emplace();
    for (const Json& memory : json.at(13)) contact->push_back(memory_from(memory));
  }
  if (!json.at(14).is_null()) branches = branches_from(json.at(14));
  take(json, 15, pressures, volumes.walls_m3, volumes.chambers_m3);
  return state;
}

Json to_json(const GroundNode& node) {
  const auto& [touches, slides, anchor, friction] = node;
  return {touches, slides, anchor, friction};
}

GroundNode ground_node_from(const Json& json) {
  GroundNode node;
  auto& [touches, slides, anchor, friction] = node;
  take(json, 0, touches, slides, anchor, friction);
  return node;
}

Json to_json(const ImplicitState& state) {
  const auto& [time, displacements, velocities, accelerations, ground_nodes, next_step, steps, rejected, iterations, work,
               at_start] = state;
  Json ground = Json::array();
  for (const GroundNode& node : ground_nodes) ground.push_back(to_json(node));
  return {time,
          displacements,
          velocities,
          accelerations,
          ground,
          next_step,
          steps,
          rejected,
          iterations,
          to_json(work),
          at_start ? Json(*at_start) : Json()};
}

ImplicitState implicit_state_from(const Json& json) {
  ImplicitState state;
  auto& [time, displacements, velocities, accelerations, ground_nodes, next_step, steps, rejected, iterations, work, at_start] =
      state;
  take(json, 0, time, displacements, velocities, accelerations);
  for (const Json& node : json.at(4)) ground_nodes.push_back(ground_node_from(node));
  take(json, 5, next_step, steps, rejected, iterations);
  work = work_from(json.at(9));
  if (!json.at(10).is_null()) at_start = json.at(10).get<double>();
  return state;
}

/// Writes a state with the index of its method in the variant.
Json to_json(const WalkState& state) {
  return {state.index(), std::visit([](const auto& kind) { return to_json(kind); }, state)};
}

WalkState state_from(const Json& json) {
  if (json.at(0).get<std::size_t>() == 0) return explicit_state_from(json.at(1));
  return implicit_state_from(json.at(1));
}

Json to_json(const WalkRecord& record) {
  const auto& [time, centre, pressures, volumes, energies, ground_force, upright] = record;
  const auto& [kinetic, strain, work, at_start] = energies;
  return {time, centre, pressures, volumes, kinetic, strain, to_json(work), at_start, ground_force, upright};
}

WalkRecord record_from(const Json& json) {
  WalkRecord record;
  auto& [time, centre, pressures, volumes, energies, ground_force, upright] = record;
  auto& [kinetic, strain, work, at_start] = energies;
  take(json, 0, time, centre, pressures, volumes, kinetic, strain);
  work = work_from(json.at(6));
  take(json, 7, at_start, ground_force, upright);
  return record;
}

/// Returns the progress as CBOR, which holds numbers exactly.
std::string content_of(const WalkProgress& progress) {
  const auto& [state, records, outcome, seconds] = progress;
  Json list = Json::array();
  for (const WalkRecord& record : records) list.push_back(to_json(record));
  Json end;
  if (outcome) end = {static_cast<int>(outcome->status), outcome->reason};
  std::string bytes;
  Json::to_cbor(Json{to_json(state), list, end, seconds}, bytes);
  return bytes;
}

/// Passes over all values of a text of CBOR and stops where they lie deeper than any checkpoint: the parser, which calls itself
/// for every level, would run out of stack.
class DepthCheck : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*elements*/) override { return ++depth_ <= most_levels; }
  bool key(string_t& /*value*/) override { return true; }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t /*elements*/) override { return ++depth_ <= most_levels; }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    return false;
  }
  [[nodiscard]] bool is_too_deep() const { return depth_ > most_levels; }

 private:
  static constexpr std::size_t most_levels = 32;
  bool leave() {
    --depth_;
    return true;
  }
  std::size_t depth_ = 0;
};

bool is_too_deep(std::string_view bytes) {
  DepthCheck check;
  (void)Json::sax_parse(bytes, &check, Json::input_format_t::cbor);
  return check.is_too_deep();
}

WalkProgress progress_from(std::string_view bytes) {
  const Json json = Json::from_cbor(bytes);
  WalkProgress progress{.state = state_from(json.at(0)), .records = {}, .outcome = {}, .seconds = json.at(3).get<double>()};
  for (const Json& record : json.at(1)) progress.records.push_back(record_from(record));
  if (const Json& end = json.at(2); !end.is_null())
    progress.outcome = {io::run_status_of(end.at(0).get<int>()), end.at(1).get<std::string>()};
  return progress;
}

}  // namespace

std::string locomotion_identity(const LocomotionStudy& study, const WalkDynamics& dynamics) {
  return locomotion_text(study) + "version = " + std::string(io::version()) + "\ninstruction_set = " + dynamics.machine_text() +
         "\n";
}

void write_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity, const WalkProgress& progress) {
  io::CheckpointFile(file, title, identity).write(content_of(progress));
}

std::optional<WalkProgress> read_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity) {
  const io::CheckpointFile checkpoint(file, title, identity);
  const std::optional<std::string> content = checkpoint.read();
  if (!content) return std::nullopt;
  if (is_too_deep(*content)) throw checkpoint.error("has values inside values to a depth that no checkpoint has");
  try {
    return progress_from(*content);
  } catch (const Json::exception&) {  // the content is undamaged, but another build arranged it differently
    throw checkpoint.error("is of another build of menger");
  } catch (const io::InputError& error) {
    throw checkpoint.error(error.what());
  }
}

std::optional<double> resume_from_checkpoint(Walk& walk, const std::filesystem::path& file, const std::string& identity) {
  std::optional<WalkProgress> progress = read_locomotion_checkpoint(file, identity);
  if (!progress) return std::nullopt;
  const double seconds = progress->seconds;
  try {
    walk.resume(*std::move(progress));
  } catch (const io::InputError& error) {
    throw io::CheckpointFile(file, title, identity).error(std::string("does not fit the walk: ") + error.what());
  }
  return seconds;
}

}  // namespace menger::fem
