#pragma once

#include <cuda_runtime_api.h>

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace menger::io {

/// What CUDA refused, with its words. A numerical outcome is never one of these.
class DeviceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @throws DeviceError unless the call has succeeded. @param what was tried, for the message
void check_cuda(cudaError_t code, const char* what);

/// A queue of copies and kernels, which are done one after the other. Those of two queues may be done at once.
class DeviceStream {
 public:
  DeviceStream();
  DeviceStream(const DeviceStream&) = delete;
  DeviceStream& operator=(const DeviceStream&) = delete;
  ~DeviceStream();

  [[nodiscard]] cudaStream_t get() const { return stream_; }
  /// Waits until all is done. @throws DeviceError for what failed on the way
  void wait() const;

 private:
  cudaStream_t stream_ = nullptr;
};

/// An array in the memory of the graphics processor.
template <class Number>
class DeviceArray {
 public:
  DeviceArray() = default;
  explicit DeviceArray(std::size_t size) : size_(size) {
    if (size > 0) check_cuda(cudaMalloc(reinterpret_cast<void**>(&numbers_), size * sizeof(Number)), "take memory of the device");
  }
  explicit DeviceArray(std::span<const Number> numbers) : DeviceArray(numbers.size()) {
    if (size_ > 0)
      check_cuda(cudaMemcpy(numbers_, numbers.data(), size_ * sizeof(Number), cudaMemcpyHostToDevice), "copy to the device");
  }
  DeviceArray(DeviceArray&& other) noexcept : numbers_(other.numbers_), size_(other.size_) {
    other.numbers_ = nullptr;
    other.size_ = 0;
  }
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    std::swap(numbers_, other.numbers_);
    std::swap(size_, other.size_);
    return *this;
  }
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;
  ~DeviceArray() { static_cast<void>(cudaFree(numbers_)); }

  [[nodiscard]] Number* get() const { return numbers_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Copies from or to the host in a queue; the host's array must stay until that is done. Sizes must fit.
  void put(std::span<const Number> numbers, const DeviceStream& stream) {
    if (!numbers.empty())
      check_cuda(cudaMemcpyAsync(numbers_, numbers.data(), numbers.size_bytes(), cudaMemcpyHostToDevice, stream.get()),
                 "copy to the device");
  }
  void take(std::span<Number> numbers, const DeviceStream& stream) const {
    if (!numbers.empty())
      check_cuda(cudaMemcpyAsync(numbers.data(), numbers_, numbers.size_bytes(), cudaMemcpyDeviceToHost, stream.get()),
                 "copy from the device");
  }

 private:
  Number* numbers_ = nullptr;
  std::size_t size_ = 0;
};

/// An array in memory of this processor that the graphics processor can read and write by itself, which makes copies fast.
template <class Number>
class PinnedArray {
 public:
  PinnedArray() = default;
  explicit PinnedArray(std::size_t size) {
    if (size > 0)
      check_cuda(cudaMallocHost(reinterpret_cast<void**>(&numbers_), size * sizeof(Number)), "take memory for copies");
  }
  PinnedArray(PinnedArray&& other) noexcept : numbers_(other.numbers_) { other.numbers_ = nullptr; }
  PinnedArray& operator=(PinnedArray&& other) noexcept {
    std::swap(numbers_, other.numbers_);
    return *this;
  }
  PinnedArray(const PinnedArray&) = delete;
  PinnedArray& operator=(const PinnedArray&) = delete;
  ~PinnedArray() { static_cast<void>(cudaFreeHost(numbers_)); }

  [[nodiscard]] Number* get() const { return numbers_; }

 private:
  Number* numbers_ = nullptr;
};

}  // namespace menger::io
