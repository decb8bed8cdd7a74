#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "evolution/trade_off/trade_off_table.h"
#include "io/process/program_job.h"
#include "io/text/toml_document.h"

namespace menger::evolution {

/// Updates of voxels in a second of a core, for estimates of the time that is left.
inline constexpr double usual_voxel_steps_per_s = 1e7;

/// Options that decide how a trade-off study is run. Apart from the times they do not change its results.
struct TradeOptions {
  std::filesystem::path programs;  ///< folder of menger-inflate and the other programs
  const std::atomic<bool>* stop = nullptr;
  bool pictures = true;

  /// Called before, during and after every run. @param done, total estimated seconds of work @param name of the run
  std::function<void(double done, double total, const std::string& name)> progress{};

  std::function<void()> begins{};  ///< called when the study is checked, before the first file is written
};

/// Reads the summary of a run, `result/result.toml`, and writes its status and reason into a row.
/// @throws io::InputError if it cannot be read
io::TomlTable read_summary(const io::ProgramJobResult& result, TradeRow& row);

/// Runs jobs one after the other and reports the progress.
class TradeRunner {
 public:
  /// @param runs folder with a folder per job
  TradeRunner(std::filesystem::path runs, TradeOptions options);

  /// Returns the path of a program of menger. @throws io::InputError if there is none
  [[nodiscard]] std::filesystem::path program(const std::string& name) const;

  /// Adds future work to the total, in estimated seconds.
  void expect(double seconds) { total_s_ += seconds; }

  /// Runs a job that was announced by expect(). If the program refuses its input, the job has failed like any other: one fidelity
  /// may be refused and others not.
  /// @return none if the user stopped this job or an earlier one
  /// @throws io::InputError if the program cannot be started or the folder cannot be written
  std::optional<io::ProgramJobResult> run(const io::ProgramJob& job);

  /// Runs a job and writes its cost and status into a row; `read` writes its result. The row becomes "failed", with the reason,
  /// if the result cannot be read or the program fails or refuses its input. It becomes "stopped" if the job exceeded its time
  /// limit or the user stopped it.
  /// @return the result, if it could be read
  std::optional<io::ProgramJobResult> fill(TradeRow& row, const io::ProgramJob& job,
                                           const std::function<void(const io::ProgramJobResult&, TradeRow&)>& read);

  [[nodiscard]] bool is_stopped() const { return is_stopped_; }
  [[nodiscard]] std::size_t repeated() const { return repeated_; }  ///< number of runs made, not found from an earlier call
  [[nodiscard]] const std::filesystem::path& runs() const { return runs_; }
  [[nodiscard]] const TradeOptions& options() const { return options_; }

 private:
  std::filesystem::path runs_;
  TradeOptions options_;
  double total_s_ = 0.0;
  double done_s_ = 0.0;
  bool is_stopped_ = false;
  std::size_t repeated_ = 0;
};

}  // namespace menger::evolution
