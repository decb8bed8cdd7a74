#pragma once

#include <iosfwd>
#include <memory>

namespace menger::io {

/// While it lives, everything that the program writes to std::cout and std::cerr is printable: names and messages may come from
/// files, whose control characters must not reach the terminal (io::printable).
class PlainOutput {
 public:
  PlainOutput();
  ~PlainOutput();
  PlainOutput(const PlainOutput&) = delete;
  PlainOutput& operator=(const PlainOutput&) = delete;

 private:
  class Filter;
  std::unique_ptr<Filter> out_;
  std::unique_ptr<Filter> error_;
};

/// Returns standard error without that filter, for what moves the cursor on purpose. What it writes must be printable.
std::ostream& terminal();

}  // namespace menger::io
