#include "fem/inflation/field_output.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "fem/inflation/field_grid.h"
#include "fem/space/rank_agreement.h"
#include "io/text/formatted.h"
#include "io/text/whole_file.h"
#include "io/vtk/vtk_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view folder_name = "fields";
constexpr std::string_view collection_name = "fields.pvd";
constexpr std::string_view file_start = "step_";

/// Returns whether a name is that of a step's file: step_0000.vtu, step_0000_1.vtu, step_0000.pvtu.
bool is_step_file(const std::string& name) {
  const bool is_fields = name.ends_with(".vtu") || name.ends_with(".pvtu");
  return is_fields && name.starts_with(file_start) &&
         name.substr(file_start.size(), name.find('.') - file_start.size()).find_first_not_of("0123456789_") == std::string::npos;
}

std::string numbered(int step) { return std::string(file_start) + io::padded(static_cast<std::size_t>(step), 4); }

}  // namespace

FieldSeries::FieldSeries(fs::path folder, MPI_Comm communicator) : folder_(std::move(folder)), communicator_(communicator) {
  MPI_Comm_rank(communicator, &rank_);
  MPI_Comm_size(communicator, &rank_count_);
}

fs::path FieldSeries::step_file(int step) const {
  return fs::path(folder_name) / (numbered(step) + (rank_count_ == 1 ? ".vtu" : ".pvtu"));
}

fs::path FieldSeries::piece_file(int step, int rank) const {
  if (rank_count_ == 1) return step_file(step);
  return fs::path(folder_name) / (numbered(step) + "_" + std::to_string(rank) + ".vtu");
}

io::CollectionEntry FieldSeries::entry_of(const FieldStep& step) const {
  return {.time_s = step.s, .file = step_file(step.step), .name = "finite elements"};
}

void FieldSeries::keep_only(const std::vector<FieldStep>& steps) {
  entries_.clear();
  for (const FieldStep& step : steps) entries_.push_back(entry_of(step));
  on_first_rank(communicator_, [&] {
    std::vector<fs::path> kept;
    for (const FieldStep& step : steps) {
      kept.push_back(step_file(step.step).filename());
      for (int rank = 0; rank < rank_count_; ++rank) kept.push_back(piece_file(step.step, rank).filename());
    }
    // names are collected first: removing files while a folder is listed is not defined
    std::vector<fs::path> surplus;
    std::error_code no_such_folder;
    for (const auto& entry : fs::directory_iterator(folder_ / folder_name, no_such_folder)) {
      const fs::path name = entry.path().filename();
      if (is_step_file(name.string()) && std::find(kept.begin(), kept.end(), name) == kept.end()) surplus.push_back(entry.path());
    }
    // a run that wrote no fields may have come before this one
    std::erase_if(entries_, [&](const io::CollectionEntry& entry) {
      std::error_code unreadable;
      return !fs::exists(folder_ / entry.file, unreadable);
    });
    // the collection is updated before the files are removed, so that it never names one that does not exist
    if (entries_.empty())
      io::remove_if_there(folder_ / collection_name);
    else
      write_collection();
    for (const fs::path& file : surplus) io::remove_if_there(file);
  });
}

void FieldSeries::add(const Space& space, std::span<const double> displacements, const NodalFields& fields,
                      const FieldStep& step) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = field_grid(space, displacements, fields, step);
  on_every_rank(communicator_, [&] { io::write_vtu(folder_ / piece_file(step.step, rank_), *grid); });
  const io::CollectionEntry entry = entry_of(step);
  std::erase_if(entries_, [&](const io::CollectionEntry& other) { return other.file == entry.file; });
  entries_.push_back(entry);
  on_first_rank(communicator_, [&] {
    if (rank_count_ > 1) {
      std::vector<std::string> pieces;
      pieces.reserve(static_cast<std::size_t>(rank_count_));
      for (int rank = 0; rank < rank_count_; ++rank) pieces.push_back(piece_file(step.step, rank).filename().string());
      io::write_whole(folder_ / entry.file, parallel_grid_text(*grid, pieces));
    }
    write_collection();
  });
}

void FieldSeries::write_collection() const { io::write_collection(folder_ / collection_name, entries_); }

}  // namespace menger::fem
