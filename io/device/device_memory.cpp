#include "io/device/device_memory.h"

namespace menger::io {

void check_cuda(cudaError_t code, const char* what) {
  if (code == cudaSuccess) return;
  throw DeviceError(std::string("CUDA could not ") + what + ": " + cudaGetErrorString(code));
}

DeviceStream::DeviceStream() { check_cuda(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "make a queue"); }

DeviceStream::~DeviceStream() { static_cast<void>(cudaStreamDestroy(stream_)); }

void DeviceStream::wait() const { check_cuda(cudaStreamSynchronize(stream_), "finish what it was given"); }

}  // namespace menger::io
