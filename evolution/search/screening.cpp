#include "evolution/search/screening.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "evolution/genome/random_stream.h"
#include "evolution/search/archived_score.h"
#include "evolution/search/search.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"

namespace menger::evolution {

namespace {

/// Fewer robots have no interval by Fisher's z.
constexpr double fewest_robots = 5.0;

/// Returns weighted mid-ranks of one side of robots.
std::vector<double> weighted_ranks(std::span<const ScoredTwice> robots, double ScoredTwice::*side) {
  std::vector<std::size_t> order(robots.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t n) { return robots[n].*side; });
  std::vector<double> ranks(robots.size());
  double below = 0.0;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    double equal = 0.0;
    while (end < order.size() && robots[order[end]].*side == robots[order[begin]].*side) equal += robots[order[end++]].weight;
    for (std::size_t n = begin; n < end; ++n) ranks[order[n]] = below + 0.5 * equal;
    below += equal;
    begin = end;
  }
  return ranks;
}

double weighted_mean(std::span<const ScoredTwice> robots, const std::vector<double>& values) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t n = 0; n < robots.size(); ++n) {
    sum += robots[n].weight * values[n];
    weights += robots[n].weight;
  }
  return sum / weights;
}

}  // namespace

std::optional<double> rank_correlation(std::span<const ScoredTwice> robots) {
  if (robots.size() < 2) return std::nullopt;
  const std::vector<double> x = weighted_ranks(robots, &ScoredTwice::surrogate);
  const std::vector<double> y = weighted_ranks(robots, &ScoredTwice::score);
  const double mean_x = weighted_mean(robots, x);
  const double mean_y = weighted_mean(robots, y);
  const auto is_one = [](const std::vector<double>& ranks) {
    return std::ranges::adjacent_find(ranks, std::not_equal_to{}) == ranks.end();
  };
  if (is_one(x) || is_one(y)) return std::nullopt;  // sums of squares would be of rounding
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t n = 0; n < robots.size(); ++n) {
    xx += robots[n].weight * (x[n] - mean_x) * (x[n] - mean_x);
    yy += robots[n].weight * (y[n] - mean_y) * (y[n] - mean_y);
    xy += robots[n].weight * (x[n] - mean_x) * (y[n] - mean_y);
  }
  return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
}

double passing_share(std::span<const ScoredTwice> robots, const ScreeningPlan& plan) {
  const std::optional<double> correlation = rank_correlation(robots);
  if (!correlation) return 1.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const ScoredTwice& robot : robots) {
    sum += robot.weight;
    squares += robot.weight * robot.weight;
  }
  const double count = sum * sum / squares;
  if (count < fewest_robots) return 1.0;
  const double largest = 1.0 - 1e-9;  // where Fisher's z is finite
  const double z = std::atanh(std::clamp(*correlation, -largest, largest)) - 1.0 / std::sqrt(count - 3.0);
  return 1.0 - (1.0 - plan.least_share) * std::max(0.0, std::tanh(z));
}

std::size_t ScreeningRound::count(Screened outcome) const {
  return static_cast<std::size_t>(std::ranges::count(individuals, outcome, &ScreenedIndividual::outcome));
}

Screening::Screening(const SearchPlan& plan, const DesignEvaluator& surrogate, const std::string& physics, RunArchive& archive)
    : plan_(&plan),
      surrogate_(&surrogate),
      archive_(&archive),
      surrogate_hash_(io::content_hash(surrogate.physics())),
      physics_hash_(io::content_hash(physics)) {
  assert(plan.screening && plan.levels().size() == 1);
}

/// Adds what the screenings before a generation tell. A result counts only if it was there when its design was screened: those
/// of a generation that was interrupted must not change what passes.
void Screening::learn(int generation) {
  std::set<std::string> screened;  // designs of one generation
  int screened_in = -1;
  for (const ScreenedIndividual& one : archive_->screened_individuals(learnt_)) {
    if (one.generation != screened_in) screened.clear();
    screened_in = one.generation;
    if (!one.surrogate) continue;
    const std::string design = simulated_design(*plan_, archive_->individual(one.id).phenotype);
    if (known_.contains(design) || !screened.insert(design).second) continue;
    const auto before = left_out_.find(design);
    const double missed = (before == left_out_.end() ? 1.0 : before->second) * (1.0 - one.probability);
    if (one.outcome == Screened::left_out) {
      left_out_[design] = missed;
    } else if (const auto score = archived_score(*plan_, *archive_, design, physics_hash_, one.generation)) {
      robots_.push_back({*one.surrogate, *score, 1.0 / (1.0 - missed)});
      known_.insert(design);
      left_out_.erase(design);
    }
  }
  learnt_ = generation;
}

bool Screening::evaluate(int generation, std::span<const Individual* const> born, const SearchOptions& options,
                         std::size_t* commits) {
  const int level = plan_->first_level();
  std::set<EvaluationKey> asked;
  std::vector<EvaluationKey> missing;
  std::vector<EvaluationTask> tasks;
  for (const Individual* individual : born) {
    EvaluationKey key{simulated_design(*plan_, individual->phenotype), level, surrogate_hash_};
    if (!asked.insert(key).second || archive_->evaluation(key)) continue;
    tasks.push_back({aggregate(as_simulated(*plan_, individual->phenotype), level), level});
    missing.push_back(std::move(key));
  }
  const io::RunStatus status = options.evaluate(*surrogate_, tasks, [&](std::size_t task, const Evaluation& result) {
    archive_->add_evaluation(missing[task], {generation, result});
    ++*commits;
    if (options.after_commit) options.after_commit(*commits);
  });
  return status == io::RunStatus::completed;
}

std::optional<ScreeningRound> Screening::screen(int generation, std::span<const Individual* const> born,
                                                const SearchOptions& options, std::size_t* commits) {
  if (!evaluate(generation, born, options, commits)) return std::nullopt;
  learn(generation);
  ScreeningRound round{.generation = generation,
                       .individuals = {},
                       .correlation = rank_correlation(robots_),
                       .share = passing_share(robots_, *plan_->screening)};
  std::map<std::string, ScreenedIndividual> designs;
  std::vector<ScreenedIndividual*> line;  // those that must be screened, one of each design
  for (const Individual* individual : born) {
    const std::string design = simulated_design(*plan_, individual->phenotype);
    const auto [place, is_first] = designs.try_emplace(design);
    if (!is_first) continue;
    place->second.surrogate = archived_score(*plan_, *archive_, design, surrogate_hash_);
    const auto known = archive_->evaluation({design, plan_->first_level(), physics_hash_});
    // A result of this generation comes from an interrupted run, and must not change what passes.
    const bool is_known = known && known->generation < generation;
    if (is_known) continue;
    if (place->second.surrogate) {
      line.push_back(&place->second);
    } else if (plan_->screening->by == Screener::half_walks) {
      // A body that fell or failed in the first half of its walk has no fitness, however it goes on.
      place->second.outcome = Screened::left_out;
      place->second.probability = 0.0;
    }
  }
  std::ranges::stable_sort(line, std::ranges::greater{}, [](const ScreenedIndividual* one) { return *one->surrogate; });
  const auto passing = static_cast<std::size_t>(std::ceil(round.share * static_cast<double>(line.size())));
  RandomStream random(plan_->seed, "screening " + std::to_string(generation));
  for (std::size_t place = passing; place < line.size(); ++place) {
    const bool is_drawn = random.uniform() < plan_->screening->drawn_share;
    line[place]->outcome = is_drawn ? Screened::drawn : Screened::left_out;
    line[place]->probability = plan_->screening->drawn_share;
  }
  round.individuals.reserve(born.size());
  for (const Individual* individual : born) {
    ScreenedIndividual one = designs.at(simulated_design(*plan_, individual->phenotype));
    one.id = individual->id;
    one.generation = generation;
    round.individuals.push_back(one);
  }
  return round;
}

std::string screening_text(const ScreeningRound& round, const ScreeningPlan& plan) {
  std::string text = "     generation " + std::to_string(round.generation) + ": " +
                     std::to_string(round.count(Screened::passed)) + " of " + std::to_string(round.individuals.size()) +
                     (plan.by == Screener::surrogate ? " pass the surrogate" : " go on after the first half of their walk");
  if (const std::size_t drawn = round.count(Screened::drawn); drawn > 0) text += ", " + std::to_string(drawn) + " more are drawn";
  return text +
         (round.correlation ? "; rank correlation so far " + io::formatted("%.2f", *round.correlation)
                            : std::string("; no rank correlation yet")) +
         "\n";
}

}  // namespace menger::evolution
