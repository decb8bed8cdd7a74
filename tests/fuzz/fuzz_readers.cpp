// The fuzzer of libFuzzer for all readers; the first argument names the one to run: fuzz-readers evolve CORPUS -runs=100000.

#include <sanitizer/asan_interface.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>

#include "tests/fuzz/line_mutation.h"
#include "tests/fuzz/readers.h"
#include "tests/support/temporary_folder.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest);

namespace {

using namespace menger::tests;

const FuzzedReader* reader = nullptr;
const pid_t fuzzer = ::getpid();

struct Place {
  TemporaryFolder root{"menger-fuzz"};
  std::filesystem::path file = fuzzed_place(*reader, root.path());
};

/// Removed when the fuzzer ends well; what a crash leaves behind is named on standard error.
const Place& place() {
  static const Place the_place;
  return the_place;
}

}  // namespace

/// Called by the sanitizer before it reports an error. A file may claim more memory than the child process that reads it may
/// have. Without a sanitizer the child throws then, and the file is refused; the sanitizer would end it as for a fault.
extern "C" void __asan_on_error() {  // NOLINT(bugprone-reserved-identifier): the sanitizer knows it by this name
  const std::string_view error = __asan_get_report_description();
  const bool is_too_much = error == "out-of-memory" || error == "allocation-size-too-big";
  if (is_too_much && ::getpid() != fuzzer) ::raise(SIGKILL);
}

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  // -merge, -jobs and -minimize_crash start this program again with all arguments, the name included.
  if (*count > 1) reader = fuzzed_reader((*arguments)[1]);
  if (reader == nullptr) {
    std::cerr << "fuzz-readers: the first argument must be one of";
    for (const FuzzedReader& one : fuzzed_readers()) std::cerr << ' ' << one.name;
    std::cerr << '\n';
    std::exit(2);
  }
  for (int n = 1; n + 1 < *count; ++n) (*arguments)[n] = (*arguments)[n + 1];
  --*count;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  const std::string refusal = read_fuzzed(*reader, place().root.path(), place().file, content);
  static const bool says = std::getenv("MENGER_FUZZ_SAYS") != nullptr;  // for people: why is this file refused?
  if (says) std::cerr << (refusal.empty() ? "accepted" : refusal) << '\n';
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t largest, unsigned int seed) {
  if (seed % 3 == 0 || reader->name == "archive" || reader->name == "checkpoint") return LLVMFuzzerMutate(data, size, largest);
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string mutated = mutated_lines(text, seed);
  const std::size_t kept = std::min(mutated.size(), largest);
  std::memcpy(data, mutated.data(), kept);
  return kept;
}
