#include "evolution/loop/loop_state.h"

#include <array>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

using nlohmann::json;

constexpr std::array all_statuses{StageStatus::begun,   StageStatus::interrupted, StageStatus::done,    StageStatus::numerical,
                                  StageStatus::refused, StageStatus::failed,      StageStatus::left_out};

StageStatus status_of(const std::string& word) {
  for (const StageStatus status : all_statuses) {
    if (to_string(status) == word) return status;
  }
  throw std::invalid_argument("no status is called " + word);
}

}  // namespace

std::string_view to_string(StageStatus status) {
  switch (status) {
    case StageStatus::begun:
      return "begun";
    case StageStatus::interrupted:
      return "interrupted";
    case StageStatus::done:
      return "done";
    case StageStatus::numerical:
      return "numerical";
    case StageStatus::refused:
      return "refused";
    case StageStatus::failed:
      return "failed";
    case StageStatus::left_out:
      return "left_out";
  }
  return "";
}

LoopState::LoopState(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code ignored;
  if (!std::filesystem::exists(file_, ignored)) return;
  const std::string text = io::read_whole(file_);
  try {
    const json whole = json::parse(text);
    robot_ = whole.value("robot", "");
    for (const auto& [name, stage] : whole.at("stages").items()) {
      stages_[name] = {.status = status_of(stage.at("status").get<std::string>()),
                       .key = stage.at("key").get<std::string>(),
                       .seconds = stage.at("seconds").get<double>(),
                       .finding = stage.at("finding").get<std::string>(),
                       .manifest_hash = stage.at("manifest_sha256").get<std::string>(),
                       .files = stage.at("files").get<std::vector<std::string>>(),
                       .takes_over = stage.value("takes_over", false)};
    }
  } catch (const std::exception&) {
    throw io::InputError(file_.string() + ": is no state of a loop; remove it to begin anew");
  }
}

void LoopState::set_robot(std::filesystem::path file) {
  if (file == robot_) return;
  robot_ = std::move(file);
  if (!stages_.empty()) write();
}

const StageRecord* LoopState::find(const std::string& stage) const {
  const auto found = stages_.find(stage);
  return found == stages_.end() ? nullptr : &found->second;
}

std::vector<std::string> LoopState::names() const {
  std::vector<std::string> names;
  names.reserve(stages_.size());
  for (const auto& [name, record] : stages_) names.push_back(name);
  return names;
}

void LoopState::set(const std::string& stage, StageRecord record) {
  stages_[stage] = std::move(record);
  write();
}

void LoopState::write() const {
  json stages = json::object();
  for (const auto& [name, record] : stages_) {
    stages[name] = {{"status", to_string(record.status)},
                    {"key", record.key},
                    {"seconds", record.seconds},
                    {"finding", record.finding},
                    {"manifest_sha256", record.manifest_hash},
                    {"files", record.files},
                    {"takes_over", record.takes_over}};
  }
  const json whole{{"program", "menger-loop"}, {"version", io::version()}, {"robot", robot_.string()}, {"stages", stages}};
  io::write_whole(file_, whole.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace menger::evolution
