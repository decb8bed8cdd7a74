#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace menger::io {

/// What a message of a rank is about.
enum class RankTopic : int {
  roll = 1,     ///< to the first rank: what this rank has, see roll_call.h
  task = 2,     ///< from the first rank: a task to do
  result = 3,   ///< to the first rank: the result of a task
  fault = 4,    ///< to the first rank: why a task has no result and never will
  alive = 5,    ///< to the first rank, and from it: a sign of life
  leaving = 6,  ///< to the first rank: this one was told to stop and does no more tasks
  end = 7,      ///< from the first rank: there are no more tasks
  ended = 8     ///< to the first rank: this one has ended its work, and why if an error ended it
};

/// A message from another rank.
struct RankMessage {
  int from = 0;
  RankTopic topic = RankTopic::alive;
  std::string bytes;
};

/// Returns the size of a message as MPI counts it. @throws std::length_error for one of 2 GiB or more, which MPI cannot send
int message_size(std::size_t bytes);

/// The ranks that mpirun or srun started together, for a program whose first rank gives tasks to the others. A process that
/// nobody started as a rank is the only one: then MPI is not started.
///
/// All calls are made by the thread that made the session. None waits for another rank, except for end(). The first rank gives
/// all others a sign of life every second by a thread of its own, whatever it computes or writes.
class RankSession {
 public:
  /// Starts MPI if is_started_as_rank(). Under mpirun, a rank whose starter dies is told to stop as by SIGTERM.
  /// @throws InputError if MPI cannot be started, or srun started several processes that it does not join
  RankSession();
  ~RankSession();
  RankSession(const RankSession&) = delete;
  RankSession& operator=(const RankSession&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] bool is_first() const { return rank_ == 0; }

  [[nodiscard]] int count_on_machine() const { return count_on_machine_; }  ///< ranks on the machine of this one, >= 1
  [[nodiscard]] static std::string machine();                               ///< its name

  /// Returns how many threads a rank has if its user asks for no number: its share of the cores of its machine, but no more than
  /// it may run on. A process alone has as many as the machine has cores.
  [[nodiscard]] int usual_threads() const;

  /// Sends bytes to a rank. They leave later, in receive() or end(). @throws std::length_error as message_size
  void send(int to, RankTopic topic, std::string bytes = {});

  /// Returns the next message that has come as a whole, if any. Those of a rank come in the order in which it sent them.
  [[nodiscard]] std::optional<RankMessage> receive();

  /// Returns why a rank ended before the end of all, as far as a message has told the first rank so: the message of its error,
  /// or an empty text. Nothing of a rank that has not ended.
  [[nodiscard]] std::optional<std::string> end_of(int rank) const;

  /// Tells that a rank does not answer any more: end() will not wait for it.
  void give_up(int rank);
  void take_back(int rank);  ///< it answers again

  /// Ends MPI. The first rank tells the others that there are no more tasks, and waits until they have ended, for at most ten
  /// seconds. If some do not, MPI aborts: mpirun then kills all ranks, and ends with `code`. Another rank tells the first one
  /// why it ended; one that has given the first rank up says it on standard error, and its process ends with `code`. Nothing may
  /// be left to write.
  /// @param fault the message of the error that ends this rank; empty without one
  void end(int code, const std::string& fault = {});

 private:
  struct Mpi;
  std::unique_ptr<Mpi> mpi_;  ///< null in a process that is no rank
  int rank_ = 0;
  int count_ = 1;
  int count_on_machine_ = 1;
  std::set<int> given_up_;
  std::map<int, std::string> ended_;
};

}  // namespace menger::io
