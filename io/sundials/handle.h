#pragma once

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <memory>
#include <new>
#include <type_traits>

namespace menger::io {

static_assert(std::is_same_v<realtype, double>, "SUNDIALS must be built for double precision");

/// Frees an object of SUNDIALS. `free_object` takes either the object or the address of the pointer to it.
template <auto free_object>
struct SundialsDeleter {
  template <class Object>
  void operator()(Object* object) const {
    if constexpr (std::is_invocable_v<decltype(free_object), Object*>)
      static_cast<void>(free_object(object));
    else
      static_cast<void>(free_object(&object));
  }
};

/// Owns an object of SUNDIALS, which itself is a pointer: `SundialsHandle<N_Vector, N_VDestroy>`. For the memory of a solver,
/// name its own function: `SundialsHandle<void*, ARKStepFree>`. An object must not outlive its context, so declare the context
/// first.
template <class Object, auto free_object>
using SundialsHandle = std::unique_ptr<std::remove_pointer_t<Object>, SundialsDeleter<free_object>>;

using SundialsContext = SundialsHandle<SUNContext, SUNContext_Free>;
using SundialsVector = SundialsHandle<N_Vector, N_VDestroy>;
using SundialsMatrix = SundialsHandle<SUNMatrix, SUNMatDestroy>;
using SundialsLinearSolver = SundialsHandle<SUNLinearSolver, SUNLinSolFree>;

/// Takes ownership of a new object of SUNDIALS. Its constructors fail only if memory runs out, and then return a null pointer.
/// @throws std::bad_alloc for a null pointer
template <class Handle>
Handle sundials_made(typename Handle::pointer object) {
  if (object == nullptr) throw std::bad_alloc();
  return Handle(object);
}

/// Creates a SUNDIALS context. Only one thread at a time may use the objects of a context.
/// @throws std::bad_alloc
inline SundialsContext make_sundials_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  return SundialsContext(context);
}

/// An error handler that prints nothing, for ARKStepSetErrHandlerFn, KINSetErrHandlerFn and similar functions. Callers use the
/// return codes of a solver instead.
inline void print_no_sundials_error(int /*code*/, const char* /*module*/, const char* /*function*/, char* /*message*/,
                                    void* /*data*/) {}

}  // namespace menger::io
