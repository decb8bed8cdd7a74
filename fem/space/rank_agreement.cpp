#include "fem/space/rank_agreement.h"

#include <array>
#include <exception>
#include <filesystem>
#include <new>

namespace menger::fem {
namespace {

enum class Failure : int { none, input, fault };

/// The exception of an action, in a form that can be sent between ranks.
struct Outcome {
  Failure failure = Failure::none;
  std::string message{};
};

Outcome outcome_of(const std::function<void()>& action) {
  try {
    action();
    return {};
  } catch (const io::InputError& error) {
    return {Failure::input, error.what()};
  } catch (const std::filesystem::filesystem_error& error) {
    return {Failure::input, error.what()};
  } catch (const std::bad_alloc&) {
    return {Failure::input, "not enough memory for this input"};
  } catch (const std::exception& error) {
    return {Failure::fault, error.what()};
  }
}

}  // namespace

void on_every_rank(MPI_Comm communicator, const std::function<void()>& action) {
  Outcome outcome = outcome_of(action);
  int rank = 0;
  int count = 0;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &count);
  int first = outcome.failure != Failure::none ? rank : count;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, communicator);
  if (first == count) return;
  std::array<int, 2> head{static_cast<int>(outcome.failure), static_cast<int>(outcome.message.size())};
  MPI_Bcast(head.data(), 2, MPI_INT, first, communicator);
  outcome.message.resize(static_cast<std::size_t>(head[1]));
  MPI_Bcast(outcome.message.data(), head[1], MPI_CHAR, first, communicator);
  if (static_cast<Failure>(head[0]) == Failure::input) throw AgreedInputError(outcome.message);
  throw AgreedFault(outcome.message);
}

void on_first_rank(MPI_Comm communicator, const std::function<void()>& action) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  on_every_rank(communicator, [&] {
    if (rank == 0) action();
  });
}

}  // namespace menger::fem
