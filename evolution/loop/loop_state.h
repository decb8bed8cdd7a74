#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace menger::evolution {

/// How a stage of a loop stands.
enum class StageStatus {
  begun,        ///< it runs, or was killed
  interrupted,  ///< the user stopped it
  done,
  numerical,  ///< it ended with a numerical outcome, such as a walk that diverged; its results say which
  refused,    ///< its program refused its input
  failed,     ///< its program ended in another way
  left_out    ///< a stage that it needs has no result
};

std::string_view to_string(StageStatus status);

/// What is known of a stage.
struct StageRecord {
  StageStatus status = StageStatus::begun;
  std::string key{};                 ///< of what decides its results, see LoopRun
  double seconds = 0.0;              ///< wall time of all its runs for this key
  std::string finding{};             ///< its result in words
  std::string manifest_hash{};       ///< io::hash_of_results of its manifest
  std::vector<std::string> files{};  ///< that it left, counted from the folder of the results
  bool takes_over = false;           ///< whether its folder may still hold results for another key

  [[nodiscard]] bool has_ended() const { return status == StageStatus::done || status == StageStatus::numerical; }
};

/// The stages of a loop by name, as loop.json holds them: from it a loop goes on after Ctrl-C or a kill.
class LoopState {
 public:
  /// Reads the state; empty if there is no file. @throws io::InputError naming the file if it cannot be read
  explicit LoopState(std::filesystem::path file);

  /// The file of the robot whose stages these are, counted from the folder of the results; empty if that is not known.
  [[nodiscard]] const std::filesystem::path& robot() const { return robot_; }

  /// Notes of which robot the stages are. The file is written at once if it is there, or else with the first stage.
  void set_robot(std::filesystem::path file);

  /// @return nothing is known: null
  [[nodiscard]] const StageRecord* find(const std::string& stage) const;

  /// Returns the names of all stages that are known, also of those that an earlier robot had and this one has not.
  [[nodiscard]] std::vector<std::string> names() const;

  /// Notes a stage and writes the file, whole or not at all.
  void set(const std::string& stage, StageRecord record);

 private:
  void write() const;

  std::filesystem::path file_;
  std::filesystem::path robot_;
  std::map<std::string, StageRecord> stages_;
};

}  // namespace menger::evolution
