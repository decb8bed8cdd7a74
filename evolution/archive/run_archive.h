#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "evolution/archive/pool_member.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/genome/decoder.h"
#include "evolution/genome/genome.h"

namespace menger::evolution {

/// Identifies a result: equal keys mean equal results.
struct EvaluationKey {
  std::string design_hash;  ///< design_hash() of the phenotype at the level
  int level = 1;
  std::string physics_hash;  ///< of DesignEvaluator::physics()

  auto operator<=>(const EvaluationKey&) const = default;  // NOLINT(modernize-use-nullptr): taken for a comparison with 0
};

/// Returns the hash of everything that decides the body of a level: the basal body and, for a phenotype with arrangements, the
/// arrangements up to that level.
std::string design_hash(const Phenotype& phenotype, int level);

/// A result and the generation that asked for it first.
struct ArchivedEvaluation {
  int generation = 0;
  Evaluation result;
};

/// An individual at its birth.
struct Individual {
  std::uint64_t id = 0;
  int generation = 0;                   ///< in which it was born
  std::optional<std::uint64_t> parent;  ///< none for a random individual
  int age = 0;                          ///< at birth: its parent's, or 0
  Genome genome;
  Phenotype phenotype;

  bool operator==(const Individual&) const = default;
};

/// A design of an archive that has a fitness. Each phenotype has one.
struct FitDesign {
  std::uint64_t individual = 0;  ///< the first with this phenotype
  Phenotype phenotype;
  double fitness = 0.0;  ///< in the unit of the objective
};

/// A result of a design by another evaluator than that of the search.
struct Reevaluation {
  std::string design_hash;  ///< design_hash() of the phenotype at the level
  int level = 1;
  std::string protocol;  ///< everything that decides the result besides the body, as canonical text
  std::string variant;   ///< name of the protocol among those that were computed together; for display
  double duration_s = 0.0;

  /// Its status is `stopped` only if a stated budget ended it. Read from an archive it has status, reason, displacement, steps
  /// and seconds; displacements by period, elements, fidelity and validity are not kept.
  Evaluation result;

  bool has_result = true;  ///< false: the other evaluator failed for `result.reason`; no status
};

/// What a screening decided of a new individual.
enum class Screened {
  passed,   ///< it is evaluated
  drawn,    ///< its rank was too low, but it was drawn and is evaluated
  left_out  ///< it is not evaluated
};
std::string_view to_string(Screened outcome);  ///< "passed", "drawn" or "left out"

/// A new individual that was screened by a surrogate.
struct ScreenedIndividual {
  std::uint64_t id = 0;
  int generation = 0;
  std::optional<double> surrogate{};  ///< its score by the surrogate
  Screened outcome = Screened::passed;
  double probability = 1.0;  ///< with which it was to be evaluated

  bool operator==(const ScreenedIndividual&) const = default;
};

/// One of the scenarios in which robots are evaluated.
struct ArchivedScenario {
  std::string physics_hash;  ///< of its evaluations, see EvaluationKey
  std::string text;          ///< what is special about it, as TOML

  bool operator==(const ArchivedScenario&) const = default;
};

/// A thing that happened in a steady-state search: a robot was born, or ended, which is when all its results were known.
struct SearchEvent {
  std::uint64_t individual = 0;
  bool is_birth = true;

  bool operator==(const SearchEvent&) const = default;
};

/// A finished generation.
struct GenerationRecord {
  int number = 0;
  std::uint64_t evaluations = 0;    ///< made for this generation
  std::uint64_t cached = 0;         ///< results that were known already, or needed twice
  std::uint64_t pruned = 0;         ///< results that selection did not need
  double seconds = 0.0;             ///< wall time of the process that finished it; never compared
  std::string variation_generator;  ///< state of the random streams after the generation
  std::string selection_generator;

  bool operator==(const GenerationRecord&) const = default;
};

/// The archive of one search: an SQLite database with everything that is needed to continue the search, to show its history and
/// to evaluate its designs again.
///
/// Displacements that do not count (Evaluation::left_out_m), displacements in every period, finite elements of bodies,
/// scenarios, checks of the time step and the order of a steady-state search have tables of their own. Only the archives of
/// searches with such data have these tables.
///
/// Every change is one transaction. Once the call returns, it survives the end of the process: by a write-ahead log, a second
/// file `<archive>-wal`. A process that ends regularly leaves the archive as one file without a log; after a kill both belong
/// together. Rows have natural keys only, so that two runs of a study have the same content, apart from the columns named
/// `seconds`. One process writes, any number may read at the same time. Calls from several threads must not overlap.
class RunArchive {
 public:
  /// The version of the tables and of the keys of studies. The studies of archives of earlier versions have earlier names of
  /// keys, or lack keys: such an archive can be read, and re-evaluations can be added to it, but no search continues with it.
  /// Version 2 had no re-evaluations; the first one turns it into version 3. Version 5 had no model of evaluation, and no
  /// displacements by period. Version 6 had no scenarios. In version 7 a body that had fallen `diverged`,
  /// without displacements.
  static constexpr int schema_version = 8;

  /// Opens the archive of a study for writing. Makes it if there is none.
  /// @param study identity_text of the study
  /// @param generations the number that the run is to reach; kept for readers
  /// @throws io::InputError if the file is not an archive, is damaged, has triggers, views or tables that no archive has, is only
  /// a part of an archive because its log is missing, has another schema version, belongs to another study (with
  /// the first difference), is being written by another process, or cannot be written. It stays as it is
  static RunArchive open(const std::filesystem::path& file, std::string_view study, int generations);

  /// Opens an existing archive to add re-evaluations to it. @throws io::InputError as open does
  static RunArchive open_to_extend(const std::filesystem::path& file);

  /// Opens an existing archive for reading, also on a medium that cannot be written to. @throws io::InputError as open does
  static RunArchive open_to_read(const std::filesystem::path& file);

  ~RunArchive();
  RunArchive(RunArchive&&) noexcept;
  RunArchive& operator=(RunArchive&&) noexcept;

  [[nodiscard]] const std::filesystem::path& file() const;
  [[nodiscard]] std::string study() const;    ///< identity_text of the study
  [[nodiscard]] int generation_goal() const;  ///< the number of generations that the latest run was to reach

  [[nodiscard]] std::optional<int> last_generation() const;  ///< none before generation 0 is finished
  [[nodiscard]] GenerationRecord generation(int number) const;
  [[nodiscard]] std::vector<PoolMember> pool(int generation) const;       ///< by id
  [[nodiscard]] std::vector<PoolMember> survivors(int generation) const;  ///< those of the pool, by rank
  [[nodiscard]] Individual individual(std::uint64_t id) const;
  [[nodiscard]] std::uint64_t next_id() const;  ///< one more than the largest id, or 0

  /// Returns the keys of the phenotypes of all individuals that no surrogate left out, each once.
  [[nodiscard]] std::vector<std::string> tried_phenotype_keys() const;

  /// Returns a result, or none. An archive of an earlier version has another text and hash of the physics, but results of one
  /// physics only. There the design and the level decide.
  [[nodiscard]] std::optional<ArchivedEvaluation> evaluation(const EvaluationKey& asked) const;

  /// Returns how many of the results of one physics that a generation asked for first are outside of the range of validity of
  /// their model. See evaluation() for archives of an earlier version.
  [[nodiscard]] std::uint64_t evaluations_outside_validity(int generation, const std::string& physics_hash) const;

  /// Returns all designs that had a fitness in some generation, the best first; of equals the one with the lower id first.
  [[nodiscard]] std::vector<FitDesign> fit_designs() const;

  /// Returns all re-evaluations, by design, level and protocol. There are none in an archive of version 2.
  [[nodiscard]] std::vector<Reevaluation> reevaluations() const;

  /// Adds re-evaluations in one transaction. Each replaces an earlier one of the same design, level and protocol, but a run that
  /// was stopped or failed never replaces a physical result.
  void add_reevaluations(std::span<const Reevaluation> reevaluations);

  /// Returns a result with half the time step of the search, or none. Keys are found as by evaluation().
  [[nodiscard]] std::optional<ArchivedEvaluation> step_check(const EvaluationKey& key) const;

  /// Adds a result with half the time step. Precondition: there is no check with this key, and the status is not `stopped`.
  void add_step_check(const EvaluationKey& key, const ArchivedEvaluation& evaluation);

  /// Adds a result. Precondition: there is no result with this key, and the status is not `stopped`.
  void add_evaluation(const EvaluationKey& key, const ArchivedEvaluation& evaluation);

  /// Adds what happened in a steady-state search, after all that happened before, and the results of robots that ended, in one
  /// transaction. Precondition: as for add_evaluation.
  void add_events(std::span<const SearchEvent> events, std::span<const std::pair<EvaluationKey, ArchivedEvaluation>> results);

  /// Returns all that has happened in a steady-state search, in its order; nothing of other searches.
  [[nodiscard]] std::vector<SearchEvent> events() const;

  /// Sets the scenarios of the search, in their order. Each result belongs to one of them by its physics.
  void set_scenarios(std::span<const ArchivedScenario> scenarios);

  /// Returns the scenarios of the search, in their order; none if it has only one.
  [[nodiscard]] std::vector<ArchivedScenario> scenarios() const;

  /// Adds a finished generation. Precondition: the archive has the previous generation but not this one.
  /// @param screened those of the new individuals that a surrogate screened
  void add_generation(const GenerationRecord& record, std::span<const Individual> born, std::span<const PoolMember> pool,
                      std::span<const ScreenedIndividual> screened = {});

  /// Returns all individuals that a surrogate screened from a generation on, by id.
  [[nodiscard]] std::vector<ScreenedIndividual> screened_individuals(int from_generation = 0) const;

 private:
  class Database;
  explicit RunArchive(std::unique_ptr<Database> database);

  std::unique_ptr<Database> database_;
};

}  // namespace menger::evolution
