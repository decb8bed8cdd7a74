#pragma once

#include <mpi.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "io/text/input_error.h"

namespace menger::fem {

/// Marks an exception that all ranks throw together: each may end on its own, and none waits for another. Any other exception may
/// be that of one rank alone, after which only MPI_Abort ends the rest.
class Agreed {
 public:
  Agreed() = default;
  Agreed(const Agreed&) = default;
  Agreed(Agreed&&) = default;
  Agreed& operator=(const Agreed&) = default;
  Agreed& operator=(Agreed&&) = default;
  virtual ~Agreed() = default;
};

/// Wrong input, or a place or memory that the machine does not give.
class AgreedInputError : public io::InputError, public Agreed {
 public:
  explicit AgreedInputError(const std::string& message) : io::InputError(message) {}
};

/// A fault of menger or of a library.
class AgreedFault : public std::runtime_error, public Agreed {
 public:
  explicit AgreedFault(const std::string& message) : std::runtime_error(message) {}
};

/// Runs an action on the first rank only, such as writing a file, and lets all ranks share its outcome: what is thrown there is
/// thrown everywhere, so that no rank waits for one that has left. Collective.
/// @throws AgreedInputError with its message after InputError, std::filesystem::filesystem_error or std::bad_alloc
/// @throws AgreedFault with its message after any other std::exception
void on_first_rank(MPI_Comm communicator, const std::function<void()>& action);

/// The same for an action of every rank: if it throws on any, all throw what the first of them did. The action is not collective
/// itself, or all ranks throw in it together.
void on_every_rank(MPI_Comm communicator, const std::function<void()>& action);

}  // namespace menger::fem
