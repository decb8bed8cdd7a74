#include "io/ranks/rank_session.h"

#include <mpi.h>
#include <oneapi/tbb/info.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <list>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <utility>

#include "io/ranks/mpi_start.h"
#include "io/text/input_error.h"

namespace menger::io {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto longest_end = std::chrono::seconds(10);
constexpr auto pause_at_end = std::chrono::milliseconds(1);
constexpr auto pause_between_signs = std::chrono::seconds(1);

}  // namespace

int message_size(std::size_t bytes) {
  constexpr int largest = std::numeric_limits<int>::max();
  if (bytes > static_cast<std::size_t>(largest))
    throw std::length_error("a message of " + std::to_string(bytes) + " bytes is too large: MPI sends at most " +
                            std::to_string(largest));
  return static_cast<int>(bytes);
}

/// Messages that are on their way, and the thread that gives signs of life.
struct RankSession::Mpi {
  struct Letter {
    std::string bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  /// A message of which the rest may never come, from a rank that hangs or is gone.
  struct Arriving {
    RankMessage message;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  /// Forgets the messages that have left.
  void sweep() {
    std::erase_if(letters, [](Letter& letter) {
      int has_left = 0;
      const bool is_known = MPI_Test(&letter.request, &has_left, MPI_STATUS_IGNORE) == MPI_SUCCESS;
      return !is_known || has_left != 0;
    });
  }

  void send(int to, RankTopic topic, std::string bytes) {
    const int size = message_size(bytes.size());
    Letter& letter = letters.emplace_back();
    letter.bytes = std::move(bytes);
    const int code = MPI_Isend(letter.bytes.data(), size, MPI_BYTE, to, static_cast<int>(topic), MPI_COMM_WORLD, &letter.request);
    if (code != MPI_SUCCESS) letters.pop_back();
  }

  /// Gives others a sign of life until it is told to stop. Those that do not answer get none.
  void give_signs(const std::stop_token& stop, int ranks) {
    std::unique_lock lock(access);
    while (!stop.stop_requested()) {
      sweep();
      for (int other = 1; other < ranks; ++other)
        if (!silent.contains(other)) send(other, RankTopic::alive, {});
      wakes.wait_for(lock, stop, pause_between_signs, [] { return false; });
    }
  }

  /// Begins to receive the next message of any rank. @return whether there is one
  bool begin_to_receive() {
    int has_come = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status{};
    // Open MPI looks for a message first, and for what has arrived since then: so a second look is needed to find that.
    for (int look = 0; look < 2 && has_come == 0; ++look) {
      if (MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_come, &message, &status) != MPI_SUCCESS) return false;
    }
    if (has_come == 0) return false;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Arriving& one = arriving.emplace_back();
    one.message = {.from = status.MPI_SOURCE, .topic = static_cast<RankTopic>(status.MPI_TAG), .bytes = {}};
    one.message.bytes.resize(static_cast<std::size_t>(size));
    if (MPI_Imrecv(one.message.bytes.data(), size, MPI_BYTE, &message, &one.request) != MPI_SUCCESS) arriving.pop_back();
    return true;
  }

  /// Returns the first message that is whole, but none before an earlier one of the same rank.
  std::optional<RankMessage> take_whole() {
    std::set<int> late;
    for (auto one = arriving.begin(); one != arriving.end();) {
      if (late.contains(one->message.from)) {
        ++one;
        continue;
      }
      int is_whole = 0;
      const bool is_known = MPI_Test(&one->request, &is_whole, MPI_STATUS_IGNORE) == MPI_SUCCESS;
      if (is_known && is_whole == 0) {
        late.insert(one->message.from);
        ++one;
        continue;
      }
      RankMessage message = std::move(one->message);
      one = arriving.erase(one);
      if (is_known) return message;
    }
    return std::nullopt;
  }

  std::mutex access{};  ///< to MPI, and to what follows
  std::condition_variable_any wakes{};
  std::list<Letter> letters{};     ///< whose bytes must stay where they are
  std::list<Arriving> arriving{};  ///< whose bytes must, too; those of a rank in its order
  std::set<int> silent{};          ///< ranks that were given up, or have ended
  std::jthread signs{};            ///< last, so that it ends first
};

RankSession::RankSession() {
  if (!is_started_as_rank()) return;
  keep_mpi_start_to_this_process();
  int provided = MPI_THREAD_SINGLE;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS || provided < MPI_THREAD_SERIALIZED)
    throw InputError("MPI cannot be started with threads that send messages in turn");
  mpi_ = std::make_unique<Mpi>();
  // A rank that cannot be reached is left out: that is no reason to end.
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  const char* const tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  if (count_ == 1 && tasks != nullptr && std::atoi(tasks) > 1 && std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) {
    MPI_Finalize();
    throw InputError(std::string("srun started ") + tasks +
                     " processes that do not know of each other: use srun --mpi=pmix, or mpirun");
  }
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &count_on_machine_);
  MPI_Comm_free(&machine);
  // Ranks outlive a mpirun that is killed. The first one would go on alone, and hold the files that the next start needs.
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // NOLINT(cppcoreguidelines-pro-type-vararg): the interface of Linux
  if (is_first() && count_ > 1)
    mpi_->signs = std::jthread([mpi = mpi_.get(), ranks = count_](const std::stop_token& stop) { mpi->give_signs(stop, ranks); });
}

RankSession::~RankSession() = default;

std::string RankSession::machine() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown machine";
}

int RankSession::usual_threads() const {
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (!mpi_) return cores;
  return std::clamp(cores / count_on_machine_, 1, std::max(1, oneapi::tbb::info::default_concurrency()));
}

void RankSession::send(int to, RankTopic topic, std::string bytes) {
  if (!mpi_) return;
  const std::lock_guard guard(mpi_->access);
  mpi_->send(to, topic, std::move(bytes));
}

std::optional<RankMessage> RankSession::receive() {
  if (!mpi_) return std::nullopt;
  const std::lock_guard guard(mpi_->access);
  mpi_->sweep();
  std::optional<RankMessage> received = mpi_->take_whole();
  while (!received && mpi_->begin_to_receive()) received = mpi_->take_whole();
  if (received && received->topic == RankTopic::ended) {
    ended_[received->from] = received->bytes;
    mpi_->silent.insert(received->from);
  }
  return received;
}

std::optional<std::string> RankSession::end_of(int rank) const {
  const auto found = ended_.find(rank);
  return found == ended_.end() ? std::nullopt : std::optional(found->second);
}

void RankSession::give_up(int rank) {
  given_up_.insert(rank);
  if (!mpi_) return;
  const std::lock_guard guard(mpi_->access);
  mpi_->silent.insert(rank);
}

void RankSession::take_back(int rank) {
  given_up_.erase(rank);
  if (!mpi_ || ended_.contains(rank)) return;
  const std::lock_guard guard(mpi_->access);
  mpi_->silent.erase(rank);
}

void RankSession::end(int code, const std::string& fault) {
  if (!mpi_) return;
  const Clock::time_point start = Clock::now();
  const auto is_in_time = [&] { return Clock::now() - start < longest_end; };
  if (rank_ > 0) {
    if (given_up_.contains(0)) {  // the end of MPI would wait for it
      std::cerr.clear();
      std::cerr << program_invocation_short_name << ": rank " << rank_ << " on " << machine() << ": " << fault << std::endl;
      std::_Exit(code);
    }
    send(0, RankTopic::ended, fault);
    const auto has_left = [&] {
      const std::lock_guard guard(mpi_->access);
      mpi_->sweep();
      return mpi_->letters.empty();
    };
    while (!has_left() && is_in_time()) std::this_thread::sleep_for(pause_at_end);
  } else {
    const auto is_awaited = [&](int other) { return !given_up_.contains(other) && !ended_.contains(other); };
    const auto are_awaited = [&] {
      for (int other = 1; other < count_; ++other)
        if (is_awaited(other)) return true;
      return false;
    };
    for (int other = 1; other < count_; ++other) send(other, RankTopic::end);
    while (are_awaited() && is_in_time())
      if (!receive()) std::this_thread::sleep_for(pause_at_end);
    mpi_->signs = {};  // joins
    // The end of MPI would wait for ranks that do not answer.
    if (are_awaited() || !given_up_.empty()) MPI_Abort(MPI_COMM_WORLD, code);
  }
  MPI_Finalize();
  mpi_.reset();
}

}  // namespace menger::io
