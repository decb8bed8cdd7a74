#pragma once

#include <memory>

namespace menger::fem {

/// MPI, PETSc and what they need, from its construction to its end. One per program, in main; the program runs one thread per
/// rank.
class ParallelSession {
 public:
  /// Takes the arguments of MPI and PETSc out of argv. @param argv ends with a null pointer
  ParallelSession(int& argc, char**& argv);
  ~ParallelSession();
  ParallelSession(const ParallelSession&) = delete;
  ParallelSession& operator=(const ParallelSession&) = delete;

 private:
  struct Libraries;
  std::unique_ptr<Libraries> libraries_;
};

}  // namespace menger::fem
