// A program of ranks whose tasks are words: rank_child OPTIONS TASK...; see the options below. The first rank prints results.
//   say TEXT   its result is the rank and the text
//   wait FILE  writes FILE.begun, and waits for FILE
//   hurt FILE  does so on other ranks than the first, and throws; on the first one it does nothing
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/ranks/rank_program.h"
#include "io/ranks/rank_team.h"
#include "io/ranks/roll_call.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace {

namespace fs = std::filesystem;
using namespace menger::io;

struct Arguments {
  double patience_s = 60.0;
  std::string facts;          ///< that must be the same on all ranks
  std::string error;          ///< that the rank says in the roll call
  std::string early_fault;    ///< what it throws before
  std::string fault;          ///< what it throws after
  fs::path late;              ///< a file for which it waits before it answers the roll
  bool twice = false;         ///< it answers twice
  bool told_to_stop = false;  ///< it is told to stop as soon as it has answered
  bool by_hand = false;       ///< its result comes when the first rank has its own and waits: see take
  bool halting = false;       ///< it halts before all of its result has left
  std::vector<std::string> tasks;
  std::vector<std::string> then;  ///< tasks that the first rank gives in a second run; the first result of the first one throws
};

void wait_for(const fs::path& file, const std::atomic<bool>* stop = nullptr) {
  while (!fs::exists(file) && (stop == nullptr || !*stop)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

void note(const fs::path& file) { write_whole(file, ""); }

RankWork work_of(int rank) {
  return [rank](const std::string& task, const std::atomic<bool>& stop, const std::function<int()>&) -> std::string {
    const std::string word = task.substr(0, task.find(' '));
    const std::string rest = task.substr(task.find(' ') + 1);
    if (word == "wait" || (word == "hurt" && rank > 0)) {
      note(rest + ".begun");
      wait_for(rest, &stop);
    }
    if (word == "hurt" && rank > 0) throw InputError("it hurts");
    return std::to_string(rank) + " " + rest;
  };
}

int first_rank(const Arguments& arguments, RankSession& session) {
  std::vector<RankFacts> facts = call_roll(session, facts_of(session, 1, {{"word", arguments.facts}}), arguments.patience_s);
  if (facts.empty()) return exit_code::interrupted;
  TeamOptions options{.threads = 1, .patience_s = arguments.patience_s};
  options.note = [](const std::string& text) { std::cout << text << std::endl; };
  RankTeam team(session, work_of(0), std::move(facts), options);
  std::atomic<bool> stop{false};
  const auto take = [&](std::size_t task, const std::string& result) {
    std::cout << task << ": " << result << std::endl;
    if (arguments.by_hand && task == 0) {
      note("waits");
      wait_for("sent");
      stop = true;
    }
    return std::vector<std::string>();
  };
  if (!arguments.then.empty()) {
    try {
      (void)team.run(arguments.tasks, &stop, [](std::size_t, const std::string& result) -> std::vector<std::string> {
        throw std::runtime_error(result);
      });
    } catch (const std::runtime_error& error) {
      std::cout << "thrown: " << error.what() << std::endl;
    }
  }
  const menger::io::RunStatus status = team.run(arguments.then.empty() ? arguments.tasks : arguments.then, &stop, take);
  std::cout << to_string(status) << ": " << team.shares() << ", on " << team.threads() << " threads" << std::endl;
  return exit_code::done;
}

/// Sends the result of a task when the first rank does not listen, and writes "sent" when it has left.
void serve_by_hand(RankSession& session) {
  while (true) {
    const std::optional<RankMessage> message = session.receive();
    if (message && message->topic == RankTopic::end) return;
    if (!message || message->topic != RankTopic::task) continue;
    wait_for("waits");
    session.send(0, RankTopic::result, message->bytes.substr(0, sizeof(std::uint64_t)) + "by hand");
    (void)session.receive();
    note("sent");
  }
}

/// Begins to send a result that is too long to leave at once, and halts.
void serve_halting(RankSession& session) {
  constexpr std::size_t long_bytes = std::size_t{1} << 25U;
  while (true) {
    const std::optional<RankMessage> message = session.receive();
    if (message && message->topic == RankTopic::end) return;
    if (!message || message->topic != RankTopic::task) continue;
    session.send(0, RankTopic::result, message->bytes.substr(0, sizeof(std::uint64_t)) + std::string(long_bytes, 'x'));
    raise(SIGSTOP);
  }
}

int other_rank(const Arguments& arguments, RankSession& session) {
  if (!arguments.early_fault.empty()) throw InputError(arguments.early_fault);
  if (!arguments.late.empty()) wait_for(arguments.late);
  RankFacts facts = facts_of(session, 1, {{"word", arguments.facts}});
  facts.error = arguments.error;
  answer_roll(session, facts);
  if (arguments.twice) answer_roll(session, facts);
  if (arguments.told_to_stop) raise(SIGTERM);
  if (!arguments.error.empty()) return exit_code::bad_input;
  if (!arguments.fault.empty()) throw InputError(arguments.fault);
  if (arguments.by_hand)
    serve_by_hand(session);
  else if (arguments.halting)
    serve_halting(session);
  else
    serve_first_rank(session, work_of(session.rank()), {.threads = 1, .patience_s = arguments.patience_s});
  return exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_rank_program("rank_child", [&](RankSession& session) -> int {
    Arguments arguments;
    CLI::App app("Shares words among ranks");
    app.add_option("--patience", arguments.patience_s);
    app.add_option("--facts", arguments.facts);
    app.add_option("--error", arguments.error);
    app.add_option("--early-fault", arguments.early_fault);
    app.add_option("--fault", arguments.fault);
    app.add_option("--late", arguments.late);
    app.add_option("--then", arguments.then)->allow_extra_args(false);
    app.add_flag("--twice", arguments.twice);
    app.add_flag("--halting", arguments.halting);
    app.add_flag("--told-to-stop", arguments.told_to_stop);
    app.add_flag("--by-hand", arguments.by_hand);
    app.add_option("task", arguments.tasks);
    if (const auto code = parse_arguments(app, argc, argv)) return *code;
    return session.is_first() ? first_rank(arguments, session) : other_rank(arguments, session);
  });
}
