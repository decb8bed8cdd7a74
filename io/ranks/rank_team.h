#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/ranks/rank_session.h"
#include "io/ranks/roll_call.h"
#include "io/ranks/task_threads.h"
#include "io/text/run_status.h"

namespace menger::io {

/// How the ranks of a program work together. It does not change results.
struct TeamOptions {
  int threads = 1;  ///< of this rank, >= 1
  /// Wall time without a sign of life after which a rank counts as lost, > 0, in s.
  double patience_s = 60.0;
  std::function<void(const std::string&)> note{};  ///< called with a sentence for people, about a rank that is lost
};

/// The ranks of a program that share tasks: bytes whose results are bytes. The first rank has the tasks; it does its share of
/// them with its own threads.
///
/// A rank has as many tasks at a time as threads, and gets the next one of the list when it returns a result. While the list is
/// long, ranks but the first have one more for each thread, so that none waits for a message. Of a rank that
/// gives no sign of life for longer than the patience, the tasks are given to others; if it answers again, it keeps those that no
/// other rank has begun, and gets further ones. So a task may be done by two ranks at once: the work bears that. The first result
/// counts, and what is thrown after it does not. Nothing but time is lost with a rank that hangs, or that is gone where MPI lets
/// the others live.
class RankTeam {
 public:
  /// @param session of the first rank; outlives the team
  /// @param facts of all ranks, see call_roll
  RankTeam(RankSession& session, RankWork work, std::vector<RankFacts> facts, TeamOptions options);

  /// Receives the position of a task and its result. Returns further tasks, whose positions follow those of all before; nothing
  /// ends the run: what is under way is dropped.
  using Finished = std::function<std::optional<std::vector<std::string>>(std::size_t task, const std::string& result)>;

  /// Does all tasks, the first ones first. Calls `finished` with every result, one call at a time, in the order in which results
  /// arrive. What the work or `finished` throws ends the rest and is thrown again; of another rank, its message with the name of
  /// the rank: as InputError, or else as std::runtime_error.
  /// @param stop may be null: then nothing stops it
  /// @return completed, also if `finished` ended it, or stopped if `stop` was set before all were done
  [[nodiscard]] RunStatus run(std::vector<std::string> tasks, const std::atomic<bool>* stop, const Finished& finished);

  /// Returns how many tasks are done at the same time, by ranks that have neither left nor are lost.
  [[nodiscard]] int threads() const;

  /// Says for people how many tasks the ranks have done so far, from the least to the most.
  [[nodiscard]] std::string shares() const;

 private:
  using Clock = std::chrono::steady_clock;

  struct Member {
    RankFacts facts;
    std::set<std::uint64_t> tasks{};  ///< that it has
    Clock::time_point heard{};        ///< of it at last
    std::size_t done = 0;             ///< tasks whose results it was the first to have
    bool is_lost = false;
    bool has_left = false;

    [[nodiscard]] bool is_present() const { return !is_lost && !has_left; }
  };
  struct Run;

  void hand_out(Run& run, TaskThreads& threads);
  bool receive(Run& run);
  void take(Run& run, int rank, std::uint64_t id, const std::string& result);
  void give_again(Run& run, const Member& member);
  void leave(Run& run, int rank, const std::string& what);
  void look_for_lost_ranks(Run& run);
  void note(int rank, const std::string& what) const;
  [[nodiscard]] std::string name_of(int rank) const;

  RankSession& session_;
  RankWork work_;
  TeamOptions options_;
  std::vector<Member> members_;
  std::uint64_t next_id_ = 0;  ///< larger than that of any task that was given to a rank
};

/// Does tasks of the first rank until there are no more. To be called by all other ranks after answer_roll. One that is told to
/// stop by SIGTERM says so, and waits for the end.
/// @throws std::runtime_error if the first rank gives no sign of life for longer than the patience, or five seconds if that is
/// less; then it is given up
void serve_first_rank(RankSession& session, const RankWork& work, const TeamOptions& options);

}  // namespace menger::io
