#include "io/ranks/rank_session.h"

#include <mpi.h>
#include <oneapi/tbb/info.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <list>
#include <thread>
#include <utility>

#include "io/ranks/mpi_start.h"
#include "io/text/input_error.h"

namespace menger::io {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto longest_end = std::chrono::seconds(10);
constexpr auto pause_at_end = std::chrono::milliseconds(1);

}  // namespace

/// Messages that are on their way, and the ranks of this machine.
struct RankSession::Mpi {
  struct Letter {
    std::string bytes;
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

  std::list<Letter> letters{};  // whose bytes must stay where they are
};

RankSession::RankSession() {
  if (!is_started_as_rank()) return;
  keep_mpi_start_to_this_process();
  int provided = MPI_THREAD_SINGLE;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS || provided < MPI_THREAD_FUNNELED)
    throw InputError("MPI cannot be started with threads beside the one that sends messages");
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
  Mpi::Letter& letter = mpi_->letters.emplace_back();
  letter.bytes = std::move(bytes);
  const int code = MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, to, static_cast<int>(topic),
                             MPI_COMM_WORLD, &letter.request);
  if (code != MPI_SUCCESS) mpi_->letters.pop_back();
}

std::optional<RankMessage> RankSession::receive() {
  if (!mpi_) return std::nullopt;
  mpi_->sweep();
  int has_come = 0;
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status{};
  const int code = MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_come, &message, &status);
  if (code != MPI_SUCCESS || has_come == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  RankMessage received{.from = status.MPI_SOURCE, .topic = static_cast<RankTopic>(status.MPI_TAG), .bytes = {}};
  received.bytes.resize(static_cast<std::size_t>(size));
  // The rest of a long message may never come from a rank that is gone; it is small enough for that to be rare.
  if (MPI_Mrecv(received.bytes.data(), size, MPI_BYTE, &message, &status) != MPI_SUCCESS) return std::nullopt;
  return received;
}

void RankSession::give_up(int rank) { given_up_.insert(rank); }

void RankSession::take_back(int rank) { given_up_.erase(rank); }

void RankSession::end(int code) {
  if (!mpi_) return;
  if (rank_ > 0) {
    send(0, RankTopic::ended);
  } else {
    std::set<int> others;
    for (int other = 1; other < count_; ++other) {
      send(other, RankTopic::end);
      if (!given_up_.contains(other)) others.insert(other);
    }
    const Clock::time_point start = Clock::now();
    while (!others.empty() && Clock::now() - start < longest_end) {
      const std::optional<RankMessage> message = receive();
      if (!message)
        std::this_thread::sleep_for(pause_at_end);
      else if (message->topic == RankTopic::ended)
        others.erase(message->from);
    }
    // The end of MPI would wait for ranks that do not answer.
    if (!others.empty() || !given_up_.empty()) MPI_Abort(MPI_COMM_WORLD, code);
  }
  MPI_Finalize();
  mpi_.reset();
}

}  // namespace menger::io
