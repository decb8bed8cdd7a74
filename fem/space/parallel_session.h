#pragma once

#include <memory>

namespace menger::fem {

/// Starts MPI, PETSc and the libraries they need, and ends them with its lifetime. A program has one, in main, and runs one
/// thread per rank.
class ParallelSession {
 public:
  /// Removes the arguments of MPI and PETSc from argv. @param argv ends with a null pointer
  ParallelSession(int& argc, char**& argv);
  ~ParallelSession();
  ParallelSession(const ParallelSession&) = delete;
  ParallelSession& operator=(const ParallelSession&) = delete;

 private:
  struct Libraries;
  std::unique_ptr<Libraries> libraries_;
};

}  // namespace menger::fem
