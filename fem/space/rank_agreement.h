#pragma once

#include <mpi.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "io/text/input_error.h"

namespace menger::fem {

/// Marks an exception that all ranks throw together. Each rank may then end on its own, and none waits for another. Any other
/// exception may come from one rank alone; then only MPI_Abort ends the others.
class Agreed {
 public:
  Agreed() = default;
  Agreed(const Agreed&) = default;
  Agreed(Agreed&&) = default;
  Agreed& operator=(const Agreed&) = default;
  Agreed& operator=(Agreed&&) = default;
  virtual ~Agreed() = default;
};

/// Wrong input, or a file or memory that the machine cannot provide.
class AgreedInputError : public io::InputError, public Agreed {
 public:
  explicit AgreedInputError(const std::string& message) : io::InputError(message) {}
};

/// A fault of menger or of a library.
class AgreedFault : public std::runtime_error, public Agreed {
 public:
  explicit AgreedFault(const std::string& message) : std::runtime_error(message) {}
};

/// Runs an action, such as writing a file, on the first rank only. All ranks share its outcome: if it throws there, all ranks
/// throw, so that no rank waits for one that has left. Collective.
/// @throws AgreedInputError with its message after InputError, std::filesystem::filesystem_error or std::bad_alloc
/// @throws AgreedFault with its message after any other std::exception
void on_first_rank(MPI_Comm communicator, const std::function<void()>& action);

/// Runs an action on every rank. If it throws on any rank, all ranks throw what the first of these threw. Either the action is
/// not collective itself, or all ranks throw in it together.
void on_every_rank(MPI_Comm communicator, const std::function<void()>& action);

}  // namespace menger::fem
