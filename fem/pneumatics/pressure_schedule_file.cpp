#include "fem/pneumatics/pressure_schedule_file.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "io/text/csv_table.h"

namespace menger::fem {
namespace {

/// The names of the kinds, by their index among the schedules.
const io::Words<std::size_t>& kind_words() {
  static const io::Words<std::size_t> words{{"constant", PressureSchedule(ConstantPressure{}).index()},
                                            {"sine", PressureSchedule(SinePressure{}).index()},
                                            {"square", PressureSchedule(SquarePressure{}).index()},
                                            {"table", PressureSchedule(PressureTable{}).index()}};
  return words;
}

void describe_swing(io::StudyVisitor& visitor, double& low_Pa, double& high_Pa, double& frequency_Hz, double& phase) {
  visitor.number({"low_Pa", "Lowest gauge pressure."}, low_Pa);
  visitor.number({"high_Pa", "Highest gauge pressure.", "4000"}, high_Pa);
  visitor.number({"frequency_Hz", "Periods per second.", "3"}, frequency_Hz, io::positive());
  visitor.number({"phase", "Fraction of a period by which the pressure is ahead."}, phase);
}

void describe_members(io::StudyVisitor& visitor, ConstantPressure& constant) {
  visitor.number({"pressure_Pa", "Gauge pressure at all times.", "4000"}, constant.pressure_Pa);
}

void describe_members(io::StudyVisitor& visitor, SinePressure& sine) {
  describe_swing(visitor, sine.low_Pa, sine.high_Pa, sine.frequency_Hz, sine.phase);
}

void describe_members(io::StudyVisitor& visitor, SquarePressure& square) {
  describe_swing(visitor, square.low_Pa, square.high_Pa, square.frequency_Hz, square.phase);
  visitor.number({"duty", "Fraction of a period from the start of the rise to the start of the fall."}, square.duty,
                 io::between(0.0, 1.0));
  visitor.number({"rise_s", "Duration of a rise and of a fall."}, square.rise_s, io::non_negative());
  visitor.check(square.rise_s * square.frequency_Hz <= std::min(square.duty, 1.0 - square.duty), "rise_s",
                "must not be longer than the time at high pressure or the time at low pressure");
}

void describe_points(io::StudyVisitor& visitor, PressureTable& table) {
  visitor.numbers({"times_s", "Times of the points, increasing.", "[0, 0.5]"}, table.times_s, io::any_number(), {.fewest = 1});
  visitor.numbers({"pressures_Pa", "Gauge pressures at these times; straight lines between them.", "[0, 4000]"},
                  table.pressures_Pa, io::any_number(), {.fewest = 1});
  visitor.check(table.pressures_Pa.size() == table.times_s.size(), "pressures_Pa", "must have as many values as times_s");
  for (std::size_t n = 1; n < table.times_s.size(); ++n)
    visitor.check(table.times_s[n] > table.times_s[n - 1], "times_s", "must be later than the time before it", {n});
}

/// Names the keys of one kind of schedule. They have a meaning only if the schedule is of this kind.
template <class Schedule, class Describe>
void describe_kind(io::StudyVisitor& visitor, PressureSchedule& schedule, std::size_t kind, const Describe& describe_own) {
  Schedule own = std::holds_alternative<Schedule>(schedule) ? std::get<Schedule>(schedule) : Schedule{};
  const std::size_t own_kind = PressureSchedule(Schedule{}).index();
  visitor.only_if(own_kind == kind, "schedule = \"" + io::word_of(kind_words(), own_kind) + "\"", [&] { describe_own(own); });
  if (own_kind == kind) schedule = own;
}

}  // namespace

PressureTable read_pressure_table(const std::filesystem::path& file) {
  const io::CsvContents csv = io::read_csv(file);
  PressureTable table{csv.numbers("time_s"), csv.numbers("pressure_Pa")};
  if (table.times_s.empty()) throw io::InputError(file.string() + ": has no rows");
  for (std::size_t row = 1; row < table.times_s.size(); ++row) {
    // The range names file, line, column and value.
    static_cast<void>(csv.number(row, "time_s", {.lowest = table.times_s[row - 1], .lowest_excluded = true}));
  }
  return table;
}

void describe(io::StudyVisitor& visitor, PlenumSchedule& schedule, std::optional<std::filesystem::path>& file) {
  std::size_t kind = schedule.schedule.index();
  visitor.word({"schedule", "How the pressure changes.", "\"sine\""}, kind, kind_words());
  const auto members = [&](auto& own) { describe_members(visitor, own); };
  describe_kind<ConstantPressure>(visitor, schedule.schedule, kind, members);
  describe_kind<SinePressure>(visitor, schedule.schedule, kind, members);
  describe_kind<SquarePressure>(visitor, schedule.schedule, kind, members);
  describe_kind<PressureTable>(visitor, schedule.schedule, kind, [&](PressureTable& table) {
    const auto keep = [] {};
    std::filesystem::path named;
    const auto describe_file = [&] {
      visitor.path({"file", "A CSV table with the columns time_s and pressure_Pa.", "\"pressure.csv\""}, named);
      if (visitor.source() == nullptr) return;
      file = named;
      table = visitor.source()->reading("file", [&] { return read_pressure_table(named); });
    };
    visitor.one_of({{"times_s", !table.times_s.empty(), keep, [&] { describe_points(visitor, table); }},
                    {"file", false, keep, describe_file}},
                   "give the points of the table");
  });
  visitor.number({"ramp_s", "Time in which the pressure grows to the value of the schedule."}, schedule.ramp_s,
                 io::non_negative());
}

}  // namespace menger::fem
