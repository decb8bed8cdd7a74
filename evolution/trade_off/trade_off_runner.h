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

/// How a trade is run, never what comes out of it, apart from the times.
struct TradeOptions {
  std::filesystem::path programs;  ///< folder of menger-inflate and the others
  const std::atomic<bool>* stop = nullptr;
  bool pictures = true;

  /// Called before, during and after every run. @param done, total estimated seconds of work @param name of the run
  std::function<void(double done, double total, const std::string& name)> progress{};
};

/// What a program says of its run in `result/result.toml`; its status and its reason go into the row.
/// @throws io::InputError if that cannot be read
io::TomlTable read_summary(const io::ProgramJobResult& result, TradeRow& row);

/// Runs jobs one after the other and keeps count of the work.
class TradeRunner {
 public:
  /// @param runs folder with a folder per job
  TradeRunner(std::filesystem::path runs, TradeOptions options);

  /// A program of menger. @throws io::InputError if there is none
  [[nodiscard]] std::filesystem::path program(const std::string& name) const;

  /// Adds work to come, in estimated seconds.
  void expect(double seconds) { total_s_ += seconds; }

  /// Runs a job that was expected; none if the user stopped it or an earlier one. A program that refuses its input is a result
  /// like any other failure: one fidelity may be refused where others are not.
  /// @throws io::InputError if the program cannot be started or the folder cannot be written
  std::optional<io::ProgramJobResult> run(const io::ProgramJob& job);

  /// Runs a job and puts its costs, its status and by `read` its result into a row. A result that cannot be read makes the row
  /// "failed" with the reason, as does a program that fails or refuses its input, with its message; a time that was up "stopped".
  /// @return the result, if it could be read
  std::optional<io::ProgramJobResult> fill(TradeRow& row, const io::ProgramJob& job,
                                           const std::function<void(const io::ProgramJobResult&, TradeRow&)>& read);

  [[nodiscard]] bool is_stopped() const { return is_stopped_; }
  [[nodiscard]] std::size_t repeated() const { return repeated_; }  ///< runs made, not found
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
