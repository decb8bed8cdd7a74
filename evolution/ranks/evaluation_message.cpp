#include "evolution/ranks/evaluation_message.h"

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

namespace menger::evolution {

namespace {

using nlohmann::json;

constexpr std::size_t cells_per_byte = 4;
constexpr unsigned bits_per_cell = 2;

json packed(const meshes::Polycube& body) {
  const std::string digits = body.digits();
  std::vector<std::uint8_t> cells((digits.size() + cells_per_byte - 1) / cells_per_byte);
  for (std::size_t n = 0; n < digits.size(); ++n) {
    const auto material = static_cast<unsigned>(digits[n] - '0');
    std::uint8_t& place = cells[n / cells_per_byte];
    place = static_cast<std::uint8_t>(place | material << (bits_per_cell * (n % cells_per_byte)));
  }
  return {body.nx(), body.ny(), body.nz(), json::binary(std::move(cells))};
}

meshes::Polycube unpacked(const json& body) {
  const int nx = body.at(0);
  const int ny = body.at(1);
  const int nz = body.at(2);
  const std::vector<std::uint8_t>& cells = body.at(3).get_binary();
  std::string digits;
  for (const std::uint8_t four : cells) {
    for (unsigned n = 0; n < cells_per_byte; ++n)
      digits += static_cast<char>('0' + (static_cast<unsigned>(four) >> (bits_per_cell * n) & 3U));
  }
  const std::size_t count = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
  if ((count + cells_per_byte - 1) / cells_per_byte != cells.size()) throw std::runtime_error("a body of a message is cut off");
  digits.resize(count);
  return meshes::Polycube::from_digits(nx, ny, nz, digits);
}

json optional_of(const std::optional<std::array<double, 3>>& vector) { return vector ? json(*vector) : json(); }

std::optional<std::array<double, 3>> optional_from(const json& value) {
  if (value.is_null()) return std::nullopt;
  return value.get<std::array<double, 3>>();
}

std::string cbor(const json& value) {
  std::string bytes;
  json::to_cbor(value, bytes);
  return bytes;
}

}  // namespace

std::string bytes_of(const TaskMessage& message) {
  json tasks = json::array();
  for (const EvaluationTask& task : message.tasks) tasks.push_back({packed(task.body), task.level, task.scenario});
  return cbor({message.evaluator, tasks});
}

TaskMessage task_message_from(const std::string& bytes) {
  const json read = json::from_cbor(bytes);
  TaskMessage message{.evaluator = read.at(0), .tasks = {}};
  for (const json& task : read.at(1))
    message.tasks.push_back({.body = unpacked(task.at(0)), .level = task.at(1), .scenario = task.at(2)});
  return message;
}

std::string bytes_of(std::span<const Evaluation> results) {
  json all = json::array();
  for (const Evaluation& one : results) {
    all.push_back({static_cast<int>(one.status), optional_of(one.displacement_m), optional_of(one.left_out_m),
                   one.period_displacements_m, one.outside_validity, one.reason, one.steps, one.elements, one.fidelity,
                   one.seconds});
  }
  return cbor(all);
}

std::vector<Evaluation> results_from(const std::string& bytes) {
  std::vector<Evaluation> results;
  for (const json& one : json::from_cbor(bytes)) {
    results.push_back({.status = static_cast<io::RunStatus>(one.at(0).get<int>()),
                       .displacement_m = optional_from(one.at(1)),
                       .left_out_m = optional_from(one.at(2)),
                       .period_displacements_m = one.at(3).get<PeriodDisplacements>(),
                       .outside_validity = one.at(4),
                       .reason = one.at(5),
                       .steps = one.at(6),
                       .elements = one.at(7),
                       .fidelity = one.at(8),
                       .seconds = one.at(9)});
  }
  return results;
}

}  // namespace menger::evolution
