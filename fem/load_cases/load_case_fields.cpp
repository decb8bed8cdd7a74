#include "fem/load_cases/load_case_fields.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "fem/space/rank_agreement.h"
#include "fem/statics/nodal_fields.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view hash_name = "content_hash";
constexpr std::string_view collection_name = "fields.pvd";
constexpr std::string_view step_folder_name = "fields";

}  // namespace

LoadCaseFields::LoadCaseFields(const fs::path& folder, const std::string& name, std::string key, MPI_Comm communicator)
    : place_(folder / "fields" / name),
      collected_(folder / "cache" / key),
      key_(std::move(key)),
      communicator_(communicator),
      series_(collected_, communicator) {}

bool LoadCaseFields::are_kept() const {
  if (!io::is_file(place_ / collection_name) || !io::is_file(place_ / hash_name)) return false;
  return io::read_whole(place_ / hash_name) == key_;
}

void LoadCaseFields::remove_others() const {
  if (are_kept()) return;
  FieldSeries(place_, communicator_).keep_only({});
  on_first_rank(communicator_, [&] {
    fs::remove(place_ / hash_name);
    // folders with other files are kept
    std::error_code not_empty;
    for (const fs::path& folder : {place_ / step_folder_name, place_, place_.parent_path()}) fs::remove(folder, not_empty);
  });
}

void LoadCaseFields::add(std::size_t place, Equilibrium& equilibrium, const PathPoint& point, const BodyState& state) {
  const auto step = static_cast<int>(place);
  const NodalFields fields = nodal_fields(equilibrium.assembly(), state.displacements_m, state.plenum_pressures_Pa);
  steps_.push_back({.step = step, .s = static_cast<double>(step), .plenum_pressures_Pa = point.pressures_Pa});
  series_.add(equilibrium.space(), state.displacements_m, fields, steps_.back());
}

void LoadCaseFields::publish() {
  // states come in the order in which paths meet them
  std::sort(steps_.begin(), steps_.end(), [](const FieldStep& a, const FieldStep& b) { return a.step < b.step; });
  series_.keep_only(steps_);
  FieldSeries(place_, communicator_).keep_only({});
  on_first_rank(communicator_, [&] {
    fs::create_directories(place_);
    fs::rename(collected_ / step_folder_name, place_ / step_folder_name);
    io::write_whole(place_ / hash_name, key_);
    // last, so that it never names files that do not exist
    fs::rename(collected_ / collection_name, place_ / collection_name);
  });
  discard();
}

void LoadCaseFields::discard() const {
  on_first_rank(communicator_, [&] { fs::remove_all(collected_); });
}

}  // namespace menger::fem
