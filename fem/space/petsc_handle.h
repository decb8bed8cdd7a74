#pragma once

#include <petscksp.h>
#include <petscsnes.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace menger::fem {

/// Turns an error code of PETSc into an exception. Such an error is a fault of the program, not of its input.
inline void petsc(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error("PETSc: " + std::string(text != nullptr ? text : "error") + " (" + std::to_string(code) + ")");
}

/// Owns an object of PETSc.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  explicit PetscHandle(Object object) : object_(object) {}
  ~PetscHandle() { reset(); }
  PetscHandle(PetscHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscHandle& operator=(PetscHandle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  PetscHandle(const PetscHandle&) = delete;
  PetscHandle& operator=(const PetscHandle&) = delete;

  // NOLINTNEXTLINE(google-explicit-constructor): it stands for the object in calls
  operator Object() const { return object_; }
  /// Returns the address where a function of PETSc can store a new object.
  Object* receive() {
    reset();
    return &object_;
  }

 private:
  void reset() {
    if (object_ != nullptr) destroy(&object_);
    object_ = nullptr;
  }
  Object object_ = nullptr;
};

/// Read access to the numbers of a vector on this rank, as long as this object lives.
class VectorReader {
 public:
  explicit VectorReader(Vec vector) : vector_(vector) { petsc(VecGetArrayRead(vector_, &data_)); }
  ~VectorReader() { VecRestoreArrayRead(vector_, &data_); }
  VectorReader(const VectorReader&) = delete;
  VectorReader& operator=(const VectorReader&) = delete;
  [[nodiscard]] const double* data() const { return data_; }
  double operator[](std::size_t n) const { return data_[n]; }

 private:
  Vec vector_;
  const double* data_ = nullptr;
};

/// Write access to the numbers of a vector on this rank, as long as this object lives.
class VectorWriter {
 public:
  explicit VectorWriter(Vec vector) : vector_(vector) { petsc(VecGetArray(vector_, &data_)); }
  ~VectorWriter() { VecRestoreArray(vector_, &data_); }
  VectorWriter(const VectorWriter&) = delete;
  VectorWriter& operator=(const VectorWriter&) = delete;
  [[nodiscard]] double* data() const { return data_; }
  double& operator[](std::size_t n) const { return data_[n]; }

 private:
  Vec vector_;
  double* data_ = nullptr;
};

using VectorHandle = PetscHandle<Vec, VecDestroy>;
using MatrixHandle = PetscHandle<Mat, MatDestroy>;
using LinearSolverHandle = PetscHandle<KSP, KSPDestroy>;
using NonlinearSolverHandle = PetscHandle<SNES, SNESDestroy>;
using NullSpaceHandle = PetscHandle<MatNullSpace, MatNullSpaceDestroy>;

}  // namespace menger::fem
