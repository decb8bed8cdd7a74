#include "fem/locomotion/locomotion_study.h"

#include <utility>

#include "fem/locomotion/locomotion_study_file.h"
#include "io/study/study_text.h"

namespace menger::fem {

std::string locomotion_text(const LocomotionStudy& study) {
  LocomotionStudy deciding = study;
  deciding.threads = LocomotionStudy{}.threads;
  deciding.output.pictures = LocomotionOutput{}.pictures;
  deciding.sweep.reset();
  return io::described_text(std::move(deciding));
}

}  // namespace menger::fem
