#include "fem/locomotion/locomotion_study.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/locomotion/locomotion_study_file.h"
#include "io/study/study_text.h"

namespace menger::fem {

std::size_t usual_records_per_frame(double record_interval_s, double duration_s, std::optional<double> frequency_Hz) {
  constexpr double frames_per_stroke = 8.0;
  constexpr double longest_interval_s = 0.1;
  constexpr double rounding = 1e-9;  // so that 0.1 s of 0.01 s are ten records
  double interval_s = longest_interval_s;
  if (frequency_Hz) interval_s = std::min(interval_s, 1.0 / (frames_per_stroke * *frequency_Hz));
  const double wanted = std::floor(interval_s / record_interval_s + rounding);
  const double records = std::ceil(duration_s / record_interval_s - rounding);  // after that at rest
  const double least =
      std::ceil(records / static_cast<double>(most_frames_of_walk - 2));  // the first and the last have a frame, too
  return static_cast<std::size_t>(std::max({1.0, wanted, least}));
}

std::string locomotion_text(const LocomotionStudy& study) {
  LocomotionStudy deciding = study;
  deciding.threads = LocomotionStudy{}.threads;
  deciding.output.pictures = LocomotionOutput{}.pictures;
  return io::described_text(std::move(deciding));
}

}  // namespace menger::fem
