#include "fem/device/lone_step_taker.h"

#include <cassert>
#include <variant>

#include "fem/device/body_arrays.h"
#include "fem/device/body_steps.h"
#include "io/device/block_thread.h"

namespace menger::fem {
namespace {

template <class Number>
using BlockFunction = detail::BlockOutcome (*)(const BodyView<Number>&, const StepsMemory<Number>&, const detail::BlockOrder&,
                                               double* volumes_m3);

template <class Law, class Number>
detail::BlockOutcome take_alone(const BodyView<Number>& body, const StepsMemory<Number>& memory, const detail::BlockOrder& order,
                                double* volumes_m3) {
  io::LoneThread thread;
  return detail::BodySteps<Law, Number, io::LoneThread>(thread, body, memory, order).take(volumes_m3);
}

template <class Number, class... Laws>
constexpr std::array<BlockFunction<Number>, sizeof...(Laws)> functions_of(const std::variant<Laws...>*) {
  return {take_alone<Laws, Number>...};
}

template <class Number>
class LoneStepTaker final : public StepTaker {
 public:
  LoneStepTaker(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, const ExplicitBodyOptions& options,
                const NodalLoads& loads)
      : arrays_(mesh, body, options, loads, 1),
        body_(arrays_.place(arrays_.bytes().data())),
        values_(3 * body_.node_count + 1),
        rates_(body_.is_viscous ? values_.size() : 0),
        forces_(body_.force_number_count),
        branches_(body_.branch_number_count),
        wall_volumes_(body_.batch_count),
        side_volumes_(2 * body_.batch_count),
        face_volumes_(body_.face_batch_count),
        volumes_(2 * body_.plenum_count) {}

  [[nodiscard]] std::string text() const override {
    return std::string("a lone thread, ") + (sizeof(Number) == 4 ? "single" : "double") + " precision";
  }

  [[nodiscard]] StepsOutcome take(const StepsOrder& order, const SteppedBody& body) override {
    static constexpr auto functions = functions_of<Number>(static_cast<const materials::HyperelasticLaw*>(nullptr));
    auto& branches = std::get<AlignedVector<Number>>(body.branches);
    assert(branches.size() == arrays_.given_branch_count());
    const StepsMemory<Number> memory{.displacements_m = body.displacements_m.data(),
                                     .velocities_m_per_s = body.velocities_m_per_s.data(),
                                     .values_m = values_.data(),
                                     .rates_m_per_s = rates_.data(),
                                     .forces_N = forces_.data(),
                                     .branches = branches_.data(),
                                     .given_branches = branches.data(),
                                     .wall_volumes_m3 = wall_volumes_.data(),
                                     .side_volumes_m3 = side_volumes_.data(),
                                     .face_volumes_m3 = face_volumes_.data(),
                                     .pressures_Pa = order.pressures_Pa.data()};
    const detail::BlockOutcome outcome = functions[arrays_.law()](body_, memory, detail::block_order(order), volumes_.data());
    return detail::outcome_of(outcome, volumes_);
  }

 private:
  BodyArrays<Number> arrays_;
  BodyView<Number> body_;
  AlignedVector<Number> values_;
  AlignedVector<Number> rates_;
  AlignedVector<Number> forces_;
  AlignedVector<Number> branches_;
  AlignedVector<Number> wall_volumes_;
  AlignedVector<Number> side_volumes_;
  AlignedVector<Number> face_volumes_;
  std::vector<double> volumes_;
};

}  // namespace

std::unique_ptr<StepTaker> lone_step_taker(const meshes::HexahedralMesh& mesh, const ExplicitBody& body,
                                           const ExplicitBodyOptions& options, const NodalLoads& loads) {
  if (std::get<ThinWallOptions>(options.elements).precision == Precision::double_precision)
    return std::make_unique<LoneStepTaker<double>>(mesh, body, options, loads);
  return std::make_unique<LoneStepTaker<float>>(mesh, body, options, loads);
}

}  // namespace menger::fem
