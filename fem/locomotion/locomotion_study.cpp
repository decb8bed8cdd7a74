#include "fem/locomotion/locomotion_study.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "fem/locomotion/locomotion_study_file.h"
#include "io/study/study_text.h"

namespace menger::fem {
double body_length_m(const meshes::Design& design, int level) {
  const int cells = std::max({design.body.nx(), design.body.ny(), design.body.nz()});
  double length = design.cell_edge_m;
  for (int i = 0; i < level; ++i) length *= cells;
  return length;
}

std::string locomotion_text(const LocomotionStudy& study) {
  LocomotionStudy deciding = study;
  deciding.threads = LocomotionStudy{}.threads;
  deciding.output.pictures = LocomotionOutput{}.pictures;
  deciding.sweep.reset();
  return io::described_text(std::move(deciding));
}

double contact_modulus_Pa(const LocomotionStudy& study) {
  if (study.elements.kind == ElementKind::three_field) return study.material.bulk_modulus_Pa;
  return contact_modulus_Pa(materials::shear_modulus_at_rest_Pa(study.material.law));
}

ExplicitBodyOptions body_options(const LocomotionStudy& study) {
  ExplicitBodyOptions options;
  const LocomotionMaterial& material = study.material;
  const ExplicitMaterial elements{material.law, materials::SimoTaylorVolume{material.bulk_modulus_Pa}, material.viscosity_Pa_s,
                                  material.branch};
  options.regions.assign(study.mesh.region_names.size(), {elements, material.density_kg_per_m3});
  if (study.elements.kind == ElementKind::thin_wall)
    options.elements = ThinWallOptions{.precision = study.elements.precision, .constants = ThinWallConstants{}};
  return options;
}

ExplicitOptions dynamics_options(const LocomotionStudy& study) {
  ExplicitOptions options;
  options.loads.gravity_m_per_s2 = {0.0, 0.0, -study.gravity_m_per_s2};
  options.loads.mass_damping_per_s = study.mass_damping_per_s;
  options.loads.ground = study.ground;
  options.supply = study.supply;
  options.step_safety = study.step_safety;
  options.largest_step_s = study.largest_step_s;
  options.self_contact = study.self_contact;
  options.threads = study.threads;
  return options;
}

std::vector<double> record_times_s(const LocomotionStudy& study) {
  // The last record is at the duration itself, which need not be a multiple of the interval.
  const auto intervals = static_cast<std::uint64_t>(std::ceil(study.duration_s / study.record_interval_s * (1.0 - 1e-12)));
  std::vector<double> times;
  for (std::uint64_t i = 1; i < intervals; ++i) times.push_back(static_cast<double>(i) * study.record_interval_s);
  times.push_back(study.duration_s);
  return times;
}

}  // namespace menger::fem
