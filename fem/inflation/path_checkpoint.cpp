#include "fem/inflation/path_checkpoint.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "fem/space/rank_agreement.h"
#include "io/process/checkpoint_file.h"
#include "io/text/input_error.h"
#include "io/text/run_status_words.h"

namespace menger::fem {
namespace {

constexpr std::string_view title = "menger path checkpoint 5";

template <class Transfer, class Value>
void transfer(Transfer& stream, Value& value);

/// Appends values as bytes.
class Writer {
 public:
  template <class Number>
  void operator()(const Number& value) requires std::is_arithmetic_v<Number> {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + sizeof(Number));
    std::memcpy(bytes_.data() + end, &value, sizeof(Number));
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  template <class Value>
  void operator()(const std::optional<Value>& value) {
    (*this)(value.has_value());
    if (value) transfer(*this, *value);
  }
  template <class Value>
  void operator()(const std::vector<Value>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const Value& value : values) transfer(*this, value);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads values from bytes in the order in which they were written.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class Number>
  void operator()(Number& value) requires std::is_arithmetic_v<Number> {
    if (bytes_.size() < sizeof(Number)) throw io::InputError("ends too early");
    std::memcpy(&value, bytes_.data(), sizeof(Number));
    bytes_.remove_prefix(sizeof(Number));
  }
  void operator()(std::string& text) {
    std::uint64_t size = 0;
    (*this)(size);
    text = take(size);
  }
  template <class Value>
  void operator()(std::optional<Value>& value) {
    bool present = false;
    (*this)(present);
    value.reset();
    if (present) transfer(*this, value.emplace());
  }
  template <class Value>
  void operator()(std::vector<Value>& values) {
    std::uint64_t size = 0;
    (*this)(size);
    if (size > bytes_.size()) throw io::InputError("ends too early");  // every value takes at least one byte
    values.resize(size);
    for (Value& value : values) transfer(*this, value);
  }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) throw io::InputError("ends too early");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

 private:
  std::string_view bytes_;
};

/// Lists the members once for reading and writing; Value is const when writing.
template <class Transfer, class Value>
void transfer(Transfer& stream, Value& value) {
  using Plain = std::remove_const_t<Value>;
  if constexpr (std::is_same_v<Plain, PathPoint>) {
    stream(value.s);
    stream(value.step);
    stream(value.pressures_Pa);
    stream(value.plenum_volumes_m3);
    stream(value.chamber_volumes_m3);
    stream(value.work_volumes_m3);
    stream(value.strain_energy_J);
    stream(value.work_J);
    stream(value.dead_load_work_J);
    stream(value.ground_force_N);
    stream(value.plates);
    stream(value.smallest_ratio);
    stream(value.negative_pivots);
    stream(value.smallest_gap_m);
    stream(value.iterations);
    stream(value.seconds);
  } else if constexpr (std::is_same_v<Plain, PlateReaction>) {
    for (auto& component : value.force_N) stream(component);
    for (auto& component : value.moment_N_m) stream(component);
  } else if constexpr (std::is_same_v<Plain, Point>) {
    for (auto& component : value) stream(component);
  } else if constexpr (std::is_same_v<Plain, BodyState>) {
    stream(value.displacements_m);
    stream(value.plenum_pressures_Pa);
    stream(value.element_pressures_Pa);
  } else if constexpr (std::is_same_v<Plain, LimitPoint>) {
    stream(value.plenum);
    stream(value.pressure_Pa);
    stream(value.volume_m3);
    stream(value.passed);
  } else if constexpr (std::is_same_v<Plain, PathOutcome>) {
    transfer(stream, value.status);
    stream(value.reason);
    stream(value.limit_points);
    stream(value.rejected_steps);
  } else if constexpr (std::is_same_v<Plain, PathProgress>) {  // except the states, of which every rank has its own part
    stream(value.restart.s);
    stream(value.restart.points);
    stream(value.restart.limit_points);
    stream(value.restart.next_step);
    stream(value.restart.failed_s);
    transfer(stream, value.restart.failed_status);
    stream(value.restart.failure);
    stream(value.restart.rejected_steps);
    stream(value.observations);
    stream(value.extent_changes_m);
    stream(value.outcome);
  } else if constexpr (std::is_same_v<Plain, io::RunStatus>) {
    auto number = static_cast<int>(value);
    stream(number);
    if constexpr (!std::is_const_v<Value>) value = io::run_status_of(number);
  } else if constexpr (std::is_same_v<Plain, PointObservation>) {
    for (auto& component : value.displacement_m) stream(component);
    stream(value.largest_stretch);
  } else {
    stream(value);
  }
}

/// Returns the bytes of every rank on the first one. Large bodies have more than a message may hold.
std::vector<std::string> gather(std::string bytes, MPI_Comm communicator) {
  constexpr std::size_t most_in_message = std::size_t{1} << 30U;
  int rank = 0;
  int count = 0;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &count);
  const std::uint64_t size = bytes.size();
  std::vector<std::uint64_t> sizes(static_cast<std::size_t>(count));
  MPI_Gather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, 0, communicator);
  const auto in_messages = [&](std::string& part, const auto& transfer_piece) {
    for (std::size_t at = 0; at < part.size(); at += most_in_message)
      transfer_piece(part.data() + at, static_cast<int>(std::min(most_in_message, part.size() - at)));
  };
  std::vector<std::string> parts;
  if (rank != 0) {
    in_messages(bytes, [&](const char* piece, int length) { MPI_Send(piece, length, MPI_CHAR, 0, 0, communicator); });
    return parts;
  }
  parts.push_back(std::move(bytes));
  for (int r = 1; r < count; ++r) {
    parts.emplace_back(sizes[static_cast<std::size_t>(r)], '\0');
    in_messages(parts.back(),
                [&](char* piece, int length) { MPI_Recv(piece, length, MPI_CHAR, r, 0, communicator, MPI_STATUS_IGNORE); });
  }
  return parts;
}

/// Returns the identity that two runs must have in common. It includes the number of ranks, since the states of a rank have no
/// meaning for another number.
std::string whole_identity(const std::string& identity, MPI_Comm communicator) {
  int count = 0;
  MPI_Comm_size(communicator, &count);
  return identity + "processes = " + std::to_string(count) + "\n";
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const std::string& identity, const PathProgress& progress,
                      MPI_Comm communicator) {
  Writer states;
  states(progress.restart.states);
  const std::vector<std::string> parts = gather(states.bytes(), communicator);
  on_first_rank(communicator, [&] {
    Writer common;
    transfer(common, progress);
    std::string content = common.bytes();
    for (const std::string& part : parts) {
      Writer size;
      size(static_cast<std::uint64_t>(part.size()));
      content += size.bytes() + part;
    }
    io::CheckpointFile(file, title, whole_identity(identity, communicator)).write(content);
  });
}

std::optional<PathProgress> read_checkpoint(const std::filesystem::path& file, const std::string& identity, MPI_Comm communicator,
                                            const std::function<std::string(const PathProgress&)>& misfit) {
  std::optional<PathProgress> progress;
  on_every_rank(communicator, [&] {
    const io::CheckpointFile checkpoint(file, title, whole_identity(identity, communicator));
    const std::optional<std::string> content = checkpoint.read();
    if (!content) return;
    try {
      Reader reader(*content);
      PathProgress& read = progress.emplace();
      transfer(reader, read);
      int rank = 0;
      MPI_Comm_rank(communicator, &rank);
      for (int r = 0; r <= rank; ++r) {
        std::uint64_t size = 0;
        reader(size);
        Reader states(reader.take(size));
        if (r == rank) states(read.restart.states);
      }
      if (const std::string reason = misfit ? misfit(read) : ""; !reason.empty())
        throw io::InputError("does not fit the body: " + reason);
    } catch (const io::InputError& error) {
      throw checkpoint.error(error.what());
    }
  });
  return progress;
}

}  // namespace menger::fem
