#include "io/process/plain_output.h"

#include <iostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "io/text/printable.h"

namespace menger::io {
namespace {

std::streambuf* unfiltered_error = nullptr;  ///< set while std::cerr is filtered

}  // namespace

/// Stands between a stream and its buffer. A character of UTF-8 that is written in parts waits for its end.
class PlainOutput::Filter : public std::streambuf {
 public:
  explicit Filter(std::ostream& stream) : stream_(&stream), under_(stream.rdbuf()) { put_before_stream(this); }
  ~Filter() override {
    (void)write_on(unfinished_);
    put_before_stream(under_);
  }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  [[nodiscard]] std::streambuf* under() const { return under_; }

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    unfinished_.append(text, static_cast<std::size_t>(count));
    const std::size_t whole = unfinished_.size() - unfinished_bytes(unfinished_);
    const bool is_written = write_on(std::string_view(unfinished_).substr(0, whole));
    unfinished_.erase(0, whole);
    return is_written ? count : 0;
  }
  int_type overflow(int_type sign) override {
    if (traits_type::eq_int_type(sign, traits_type::eof())) return traits_type::not_eof(sign);
    const char letter = traits_type::to_char_type(sign);
    return xsputn(&letter, 1) == 1 ? sign : traits_type::eof();
  }
  int sync() override { return under_->pubsync(); }

 private:
  /// Sets the buffer of the stream and keeps its state, which says whether it is silenced, as on all ranks but the first.
  void put_before_stream(std::streambuf* buffer) {
    const std::ios::iostate state = stream_->rdstate();
    stream_->rdbuf(buffer);
    stream_->clear(state);
  }
  [[nodiscard]] bool write_on(std::string_view text) const {
    const std::string shown = printable(text);
    const auto count = static_cast<std::streamsize>(shown.size());
    return under_->sputn(shown.data(), count) == count;
  }

  std::ostream* stream_;
  std::streambuf* under_;
  std::string unfinished_;
};

PlainOutput::PlainOutput() : out_(std::make_unique<Filter>(std::cout)), error_(std::make_unique<Filter>(std::cerr)) {
  unfiltered_error = error_->under();
}

PlainOutput::~PlainOutput() { unfiltered_error = nullptr; }

std::ostream& terminal() {
  if (std::cerr.fail()) return std::cerr;  // silenced, as on all ranks but the first
  static std::ostream stream(nullptr);
  std::streambuf* const under = unfiltered_error != nullptr ? unfiltered_error : std::cerr.rdbuf();
  if (stream.rdbuf() != under) stream.rdbuf(under);
  return stream;
}

}  // namespace menger::io
