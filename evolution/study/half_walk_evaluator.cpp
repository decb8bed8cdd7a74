#include "evolution/study/half_walk_evaluator.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include "evolution/study/walk_evaluator.h"
#include "io/text/input_error.h"
#include "io/text/toml_text.h"

namespace menger::evolution {

namespace {

fem::PreparedWalk prepared_walk(const fem::WalkInput& input) {
  fem::check(input);
  fem::PreparedWalk prepared{input};
  fem::prepare(prepared);
  return prepared;
}

/// Returns what tells bodies of paused walks apart.
std::string key_of(const meshes::Polycube& body) {
  return std::to_string(body.nx()) + " " + std::to_string(body.ny()) + " " + std::to_string(body.nz()) + " " + body.digits();
}

}  // namespace

// The walk is asked between its records whether it is stopped, since the flag of its first half may be gone when it goes on.
WalkInParts::WalkInParts(const fem::WalkInput& input)
    : prepared_(prepared_walk(input)), dynamics_(fem::explicit_walk_dynamics(prepared_, nullptr)), walk_(prepared_, *dynamics_) {
  walk_.start();
}

bool WalkInParts::go_on_to(double time_s, const std::atomic<bool>& stop) {
  const double almost_s = time_s - 0.5 * prepared_.record_interval_s;  // times of records are rounded
  while (walk_.is_under_way() && walk_.records().back().time_s < almost_s) {
    if (stop) return false;
    walk_.go_on();
  }
  return true;
}

void PausedWalks::put(const meshes::Polycube& body, std::unique_ptr<WalkInParts> walk) {
  const std::string key = key_of(body);
  const std::lock_guard guard(access_);
  if (!walks_.insert_or_assign(key, std::move(walk)).second) return;
  order_.push_back(key);
  if (order_.size() <= most_) return;
  walks_.erase(order_.front());
  order_.pop_front();
}

std::unique_ptr<WalkInParts> PausedWalks::take(const meshes::Polycube& body) {
  const std::string key = key_of(body);
  const std::lock_guard guard(access_);
  const auto found = walks_.find(key);
  if (found == walks_.end()) return nullptr;
  std::unique_ptr<WalkInParts> walk = std::move(found->second);
  walks_.erase(found);
  std::erase(order_, key);
  return walk;
}

Study first_half_of(const Study& study) {
  const LastPeriods last = measured_periods(study).value();
  const std::size_t periods = whole_periods(study.duration_s, last.period_s) / 2;
  assert(periods >= 2);
  Study half = study;
  half.duration_s = static_cast<double>(periods) * last.period_s;
  half.measure_periods = std::min(last.count, periods - 1);
  return half;
}

HalfWalkEvaluator::HalfWalkEvaluator(Study study, std::shared_ptr<PausedWalks> paused)
    : whole_(std::move(study)), half_(first_half_of(whole_)), paused_(std::move(paused)) {}

Evaluation HalfWalkEvaluator::evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const {
  const auto start = std::chrono::steady_clock::now();
  Evaluation result = blank_result(whole_);
  try {
    auto walk = std::make_unique<WalkInParts>(walk_of(whole_, module_of_aggregate(body, level), level));
    if (!walk->go_on_to(half_.duration_s, stop)) return result;
    take_result(half_, walk->result(), result);
    if (paused_) paused_->put(body, std::move(walk));
  } catch (const io::InputError& error) {
    set_refused(error, result);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string HalfWalkEvaluator::physics() const {
  io::TomlText text;
  text.add("first_half_of", whole_.duration_s);
  return text.lines(WalkEvaluator(half_).physics()).text();
}

double HalfWalkEvaluator::cost(const meshes::Polycube& body, int level) const { return WalkEvaluator(whole_).cost(body, level); }

}  // namespace menger::evolution
