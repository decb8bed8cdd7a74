#include "evolution/trade_off/trade_off_runner.h"

#include <algorithm>
#include <utility>

#include "io/text/input_error.h"

namespace menger::evolution {

io::TomlTable read_summary(const io::ProgramJobResult& result, TradeRow& row) {
  io::TomlTable summary = io::read_toml(result.folder / "result/result.toml");
  row.status = summary.text("status");
  row.reason = summary.text_or("reason", "");
  return summary;
}

TradeRunner::TradeRunner(std::filesystem::path runs, TradeOptions options)
    : runs_(std::move(runs)), options_(std::move(options)) {}

std::filesystem::path TradeRunner::program(const std::string& name) const { return io::program_in(options_.programs, name); }

std::optional<io::ProgramJobResult> TradeRunner::run(const io::ProgramJob& job) {
  is_stopped_ = is_stopped_ || (options_.stop != nullptr && options_.stop->load());
  if (is_stopped_) return std::nullopt;
  const auto tell = [&](double part) {
    if (options_.progress) options_.progress(done_s_ + part, total_s_, job.name);
  };
  tell(0.0);
  // A run that takes longer than estimated stays at 95 %.
  const auto waiting = [&](double seconds) { tell(std::min(seconds, 0.95 * job.estimated_s)); };
  io::ProgramJobResult result = io::run_job(job, {.runs = runs_, .stop = options_.stop, .waiting = waiting});
  is_stopped_ = result.is_stopped();
  if (is_stopped_) return std::nullopt;
  done_s_ += job.estimated_s;
  if (result.repeated) ++repeated_;
  tell(0.0);
  return result;
}

std::optional<io::ProgramJobResult> TradeRunner::fill(TradeRow& row, const io::ProgramJob& job,
                                                      const std::function<void(const io::ProgramJobResult&, TradeRow&)>& read) {
  std::optional<io::ProgramJobResult> result = run(job);
  if (!result) {
    row.status = "stopped";
    return std::nullopt;
  }
  constexpr double bytes_per_megabyte = 1e6;
  row.seconds = result->outcome.wall_s;
  row.cpu_seconds = result->outcome.cpu_s;
  row.peak_megabytes = static_cast<double>(result->outcome.peak_memory_bytes) / bytes_per_megabyte;
  if (!result->has_result()) {
    row.status = result->outcome.end == io::ChildEnd::timed_out ? "stopped" : "failed";
    row.reason = result->failure();
    row.is_refused = result->is_refused();
    return std::nullopt;
  }
  try {
    read(*result, row);
    return result;
  } catch (const io::InputError& error) {
    row.status = "failed";
    row.reason = error.what();
    std::ranges::fill(row.values, std::nullopt);
    return std::nullopt;
  }
}

}  // namespace menger::evolution
