#include "fem/locomotion/locomotion_drive.h"

#include "fem/surfaces/gas_law.h"

namespace menger::fem {

void describe(io::StudyVisitor& visitor, SurrogateDrive& drive) {
  visitor.word(
      {"mode", "Which cells are driven at which time. hold: all cells have the highest pressure; none: no cell is driven.",
       "\"in_phase\""},
      drive.mode,
      {{"none", DriveMode::none},
       {"in_phase", DriveMode::in_phase},
       {"antiphase", DriveMode::antiphase},
       {"wave", DriveMode::wave},
       {"hold", DriveMode::hold}});
  visitor.numbers({"pressure_Pa", "Lowest and highest gauge pressure.", "[0, 6000]"}, drive.pressure_Pa);
  visitor.check(drive.pressure_Pa[0] > -standard_atmosphere_Pa, "pressure_Pa", "reaches a perfect vacuum or less");
  visitor.check(drive.pressure_Pa[0] <= drive.pressure_Pa[1], "pressure_Pa", "must ascend: lowest, then highest");
  visitor.number({.name = "frequency_Hz",
                  .help = "Periods per second.",
                  .example = drive.mode == DriveMode::none ? "" : "3",
                  .earlier = "period_s",
                  .was_reciprocal = true},
                 drive.frequency_Hz, io::positive());
  visitor.optional_number({"ramp_s", "Time in which the pressure grows to its full value. If not given: one period.", "0.1"},
                          drive.ramp_s, io::non_negative());
  visitor.only_if(drive.mode == DriveMode::antiphase, "mode = \"antiphase\"", [&] {
    visitor.numbers({"material_phase", "Fraction of a period by which cells of materials 1 and 2 are ahead."},
                    drive.material_phase);
  });
  visitor.only_if(drive.mode == DriveMode::wave, "mode = \"wave\"", [&] {
    visitor.word({"wave_axis", "Axis along which the wave runs."}, drive.wave_axis, {{"x", 0}, {"y", 1}, {"z", 2}});
    visitor.number({"wave_periods_per_body", "Periods of the wave over the length of the body."}, drive.wave_periods_per_body);
    visitor.boolean({"wave_over_gaps", "Whether the length of the body is the distance between its first and its last cell."},
                    drive.wave_over_gaps);
  });
}

}  // namespace menger::fem
