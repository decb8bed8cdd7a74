#include "io/ranks/rank_team.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

#include "io/process/interrupt.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::io {

namespace {

/// Returns how long a rank waits before it looks for messages again. A look takes some 25 us of a core that a task could use, and
/// a message waits for the next look. So the pause grows with the time since the last message or result: of tasks of any length
/// from some milliseconds on, looks take a few hundredths.
std::chrono::microseconds pause_after(std::chrono::steady_clock::time_point last) {
  const auto quiet = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - last);
  return std::clamp(quiet / 20, std::chrono::microseconds(200), std::chrono::microseconds(10000));
}

/// The least patience with the first rank, in s: a sign of life comes from it every second.
constexpr double least_patience_s = 5.0;

/// Signs of life come several times within the patience, in s.
double seconds_between_signs(double patience_s) { return std::min(5.0, 0.2 * patience_s); }

std::string with_id(std::uint64_t id, const std::string& bytes) {
  std::string all(sizeof id, '\0');
  std::memcpy(all.data(), &id, sizeof id);
  return all + bytes;
}

std::uint64_t id_of(const std::string& bytes) {
  std::uint64_t id = 0;
  if (bytes.size() < sizeof id) throw std::runtime_error("a message between ranks is cut off");
  std::memcpy(&id, bytes.data(), sizeof id);
  return id;
}

std::string without_id(const std::string& bytes) { return bytes.substr(sizeof(std::uint64_t)); }

/// Describes what a task threw: whether it is wrong input, and its message.
std::string fault_bytes(const std::exception_ptr& fault) {
  try {
    std::rethrow_exception(fault);
  } catch (const InputError& error) {
    return std::string("i") + error.what();
  } catch (const std::exception& error) {
    return std::string("f") + error.what();
  } catch (...) {
    return "funknown";
  }
}

std::string end_text(const std::string& fault) { return fault.empty() ? "has ended" : "has ended (" + fault + ")"; }

[[noreturn]] void throw_fault(const std::string& name, const std::string& bytes) {
  const std::string message = name + ": " + bytes.substr(1);
  if (bytes.starts_with('i')) throw InputError(message);
  throw std::runtime_error(message);
}

}  // namespace

/// The tasks of one call of run().
struct RankTeam::Run {
  std::uint64_t first_id = 0;
  std::vector<std::string> tasks;
  std::vector<bool> is_done;
  std::size_t done = 0;
  bool is_ended = false;            ///< by what receives results
  std::deque<std::size_t> waiting;  ///< in the order in which they are given out
  const Finished* finished = nullptr;

  void add(std::vector<std::string> more) {
    for (std::string& task : more) {
      waiting.push_back(tasks.size());
      tasks.push_back(std::move(task));
      is_done.push_back(false);
    }
  }

  /// Puts a task first in the list again, once.
  void give_again(std::uint64_t id) {
    const std::size_t task = id - first_id;
    if (std::ranges::find(waiting, task) == waiting.end()) waiting.push_front(task);
  }

  /// Takes the tasks of a rank that does them after all from the list.
  void keep(const std::set<std::uint64_t>& ids) {
    std::erase_if(waiting, [&](std::size_t task) { return ids.contains(first_id + task); });
  }

  [[nodiscard]] bool is_over() const { return is_ended || done == tasks.size(); }

  /// Whether the result of a task of this run is still asked for.
  [[nodiscard]] bool is_open(std::uint64_t id) const {
    return !is_ended && id >= first_id && id - first_id < tasks.size() && !is_done[id - first_id];
  }

  /// Returns the next task that is to be given to a rank, if there is one. @param has the tasks that the rank has
  std::optional<std::size_t> next(const std::set<std::uint64_t>& has) {
    // The rank that was thought to be lost may have done it.
    std::erase_if(waiting, [&](std::size_t task) { return is_done[task]; });
    const auto found = std::ranges::find_if(waiting, [&](std::size_t task) { return !has.contains(first_id + task); });
    if (found == waiting.end()) return std::nullopt;
    const std::size_t task = *found;
    waiting.erase(found);
    return task;
  }
};

RankTeam::RankTeam(RankSession& session, RankWork work, std::vector<RankFacts> facts, TeamOptions options)
    : session_(session), work_(std::move(work)), options_(std::move(options)) {
  assert(session.is_first() && facts.size() == static_cast<std::size_t>(session.count()));
  for (RankFacts& one : facts) members_.push_back({.facts = std::move(one)});
}

int RankTeam::threads() const {
  int sum = 0;
  for (const Member& member : members_)
    if (member.is_present()) sum += member.facts.threads;
  return sum;
}

std::string RankTeam::name_of(int rank) const {
  return "rank " + std::to_string(rank) + " on " + members_.at(static_cast<std::size_t>(rank)).facts.machine;
}

std::string RankTeam::shares() const {
  const auto [least, most] = std::ranges::minmax_element(members_, {}, &Member::done);
  const auto of = [&](std::vector<Member>::const_iterator member) {
    return std::to_string(member->done) + " (" + name_of(static_cast<int>(member - members_.begin())) + ")";
  };
  return "each process did from " + of(least) + " to " + of(most) + " tasks";
}

void RankTeam::note(int rank, const std::string& what) const {
  if (options_.note) options_.note(name_of(rank) + " " + what);
}

RunStatus RankTeam::run(std::vector<std::string> tasks, const std::atomic<bool>* stop, const Finished& finished) {
  members_.front().tasks.clear();  // of a run that threw
  Run run{.first_id = next_id_, .tasks = {}, .is_done = {}, .done = 0, .is_ended = false, .waiting = {}, .finished = &finished};
  run.add(std::move(tasks));
  for (Member& member : members_) member.heard = Clock::now();
  for (int rank = 1; rank < session_.count(); ++rank)  // during the roll call, or an earlier run
    if (const auto end = session_.end_of(rank)) leave(run, rank, end_text(*end));
  TaskThreads threads(options_.threads, work_);
  const auto take_own = [&](const TaskThreads::Done& done) {
    members_.front().tasks.erase(done.id);
    if (done.fault && run.is_open(done.id)) std::rethrow_exception(done.fault);
    if (!done.fault) take(run, 0, done.id, done.result);
  };
  Clock::time_point busy = Clock::now();
  while (!run.is_over()) {
    if (stop != nullptr && *stop) {
      threads.stop();
      while (const auto done = threads.take(std::chrono::microseconds(0))) take_own(*done);
      receive(run);  // what has come meanwhile
      break;
    }
    hand_out(run, threads);
    bool has_news = receive(run);
    look_for_lost_ranks(run);
    while (const auto done = threads.take(has_news ? std::chrono::microseconds(0) : pause_after(busy))) {
      take_own(*done);
      has_news = true;
    }
    if (has_news) busy = Clock::now();
  }
  members_.front().tasks.clear();
  return run.is_over() ? RunStatus::completed : RunStatus::stopped;
}

/// Gives tasks to all that have a free thread, one to each in turn. While there are many, other ranks get one more for each
/// thread, with which they go on while the result of the one before is on its way.
void RankTeam::hand_out(Run& run, TaskThreads& threads) {
  const auto give = [&](std::size_t rank, int most) {
    Member& member = members_[rank];
    if (!member.is_present() || static_cast<int>(member.tasks.size()) >= most) return false;
    const std::optional<std::size_t> task = run.next(member.tasks);
    if (!task) return false;
    const std::uint64_t id = run.first_id + *task;
    next_id_ = std::max(next_id_, id + 1);
    member.tasks.insert(id);
    if (rank == 0)
      threads.begin(id, run.tasks[*task]);
    else
      session_.send(static_cast<int>(rank), RankTopic::task, with_id(id, run.tasks[*task]));
    return true;
  };
  const std::size_t many = 2 * static_cast<std::size_t>(this->threads());
  for (const bool ahead : {false, true}) {
    bool was_given = true;
    while (was_given && run.waiting.size() > (ahead ? many : 0)) {
      was_given = false;
      for (std::size_t rank = ahead ? 1 : 0; rank < members_.size(); ++rank)
        if (run.waiting.size() > (ahead ? many : 0) && give(rank, members_[rank].facts.threads * (ahead ? 2 : 1)))
          was_given = true;
    }
  }
}

/// Takes a result that may have come before from another rank, or belong to an earlier run.
void RankTeam::take(Run& run, int rank, std::uint64_t id, const std::string& result) {
  if (!run.is_open(id)) return;
  const std::size_t task = id - run.first_id;
  run.is_done[task] = true;
  ++run.done;
  ++members_.at(static_cast<std::size_t>(rank)).done;
  run.tasks[task] = {};  // nobody needs it any more
  if (auto more = (*run.finished)(task, result))
    run.add(std::move(*more));
  else
    run.is_ended = true;
}

/// Takes all messages that have come. @return whether there was one
bool RankTeam::receive(Run& run) {
  bool was_one = false;
  while (const std::optional<RankMessage> message = session_.receive()) {
    was_one = true;
    Member& member = members_.at(static_cast<std::size_t>(message->from));
    member.heard = Clock::now();
    if (member.is_lost) {
      member.is_lost = false;
      run.keep(member.tasks);
      session_.take_back(message->from);
      note(message->from, "answers again");
    }
    if (message->topic == RankTopic::result) {
      const std::uint64_t id = id_of(message->bytes);
      member.tasks.erase(id);
      take(run, message->from, id, without_id(message->bytes));
    } else if (message->topic == RankTopic::fault) {
      const std::uint64_t id = id_of(message->bytes);
      member.tasks.erase(id);
      if (run.is_open(id)) throw_fault(name_of(message->from), without_id(message->bytes));
    } else if (message->topic == RankTopic::leaving) {
      leave(run, message->from, "was told to stop");
    } else if (message->topic == RankTopic::ended) {
      leave(run, message->from, end_text(message->bytes));
    }
  }
  return was_one;
}

/// Gives the tasks of a rank that does not do them back to the list, except those that another one does.
void RankTeam::give_again(Run& run, const Member& member) {
  for (auto id = member.tasks.rbegin(); id != member.tasks.rend(); ++id) {  // so that the first one comes first again
    const bool is_elsewhere = std::ranges::any_of(
        members_, [&](const Member& other) { return &other != &member && other.is_present() && other.tasks.contains(*id); });
    if (run.is_open(*id) && !is_elsewhere) run.give_again(*id);
  }
}

/// Goes on without a rank that does no more tasks. It may say so several times. @param what happened, as a part of a sentence
void RankTeam::leave(Run& run, int rank, const std::string& what) {
  Member& member = members_.at(static_cast<std::size_t>(rank));
  give_again(run, member);
  member.tasks.clear();
  if (!member.has_left) note(rank, what + ": the others go on without it");
  member.has_left = true;
}

/// Gives the tasks of ranks that are silent for too long back to the list. All messages that have come were received before.
void RankTeam::look_for_lost_ranks(Run& run) {
  const Clock::time_point now = Clock::now();
  for (std::size_t rank = 1; rank < members_.size(); ++rank) {
    Member& member = members_[rank];
    if (!member.is_present()) continue;
    if (std::chrono::duration<double>(now - member.heard).count() <= options_.patience_s) continue;
    member.is_lost = true;
    session_.give_up(static_cast<int>(rank));
    give_again(run, member);
    note(static_cast<int>(rank), "has been silent for " + number_text(options_.patience_s) + " s: the others go on without it");
  }
}

void serve_first_rank(RankSession& session, const RankWork& work, const TeamOptions& options) {
  using Clock = std::chrono::steady_clock;
  constexpr double longest_step_s = 1.0;
  TaskThreads threads(options.threads, work);
  const auto seconds_since = [](Clock::time_point time) { return std::chrono::duration<double>(Clock::now() - time).count(); };
  const double patience_s = std::max(options.patience_s, least_patience_s);
  Clock::time_point said = Clock::now();
  Clock::time_point busy = said;
  Clock::time_point looked = said;
  double silent_s = 0.0;  // since the last message of the first rank
  bool has_left = false;
  const auto hand_over = [&](std::chrono::microseconds pause) {
    while (const auto done = threads.take(pause)) {
      busy = Clock::now();
      if (has_left) continue;  // it may be a part of a result
      if (done->fault)
        session.send(0, RankTopic::fault, with_id(done->id, fault_bytes(done->fault)));
      else
        session.send(0, RankTopic::result, with_id(done->id, done->result));
    }
  };
  while (true) {
    // A process that was itself halted meanwhile, with the first one or alone, does not count that time.
    silent_s += std::min(seconds_since(looked), longest_step_s);
    looked = Clock::now();
    while (const std::optional<RankMessage> message = session.receive()) {
      silent_s = 0.0;
      if (message->topic == RankTopic::end) return;
      if (message->topic != RankTopic::task) continue;
      busy = Clock::now();
      if (has_left)
        session.send(0, RankTopic::leaving);  // the first one may have called the roll when this was said before
      else
        threads.begin(id_of(message->bytes), without_id(message->bytes));
    }
    if (silent_s > patience_s) {
      session.give_up(0);
      throw std::runtime_error("rank 0 has given no sign of life for " + number_text(patience_s) + " s");
    }
    if (interrupted() && !has_left) {
      hand_over(std::chrono::microseconds(0));
      has_left = true;
      session.send(0, RankTopic::leaving);
      threads.stop();
      come_to_stop();
    }
    if (seconds_since(said) >= seconds_between_signs(options.patience_s)) {
      session.send(0, RankTopic::alive);
      said = Clock::now();
    }
    hand_over(pause_after(busy));
  }
}

}  // namespace menger::io
