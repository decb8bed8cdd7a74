#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "evolution/genome/decoder.h"
#include "evolution/genome/genome.h"

namespace menger::evolution {

/// Which result: equal keys mean equal results.
struct EvaluationKey {
  std::string design_hash;  ///< design_hash() of the phenotype at the level
  int level = 1;
  std::string physics_hash;  ///< of DesignEvaluator::physics()

  auto operator<=>(const EvaluationKey&) const = default;  // NOLINT(modernize-use-nullptr): taken for a comparison with 0
};

/// Name of what decides the body of a level: of the basal body and, where there are arrangements, of those up to the level.
std::string design_hash(const Phenotype& phenotype, int level);

/// A result and the generation that first asked for it.
struct ArchivedEvaluation {
  int generation = 0;
  Evaluation result;
};

/// The time steps that an evaluation took.
struct EvaluationSteps {
  std::string design_hash;
  int level = 1;
  std::uint64_t steps = 0;
};

/// An individual as it was born.
struct Individual {
  std::uint64_t id = 0;
  int generation = 0;                   ///< in which it was born
  std::optional<std::uint64_t> parent;  ///< none for a random individual
  int age = 0;                          ///< at birth: its parent's, or 0
  Genome genome;
  Phenotype phenotype;

  bool operator==(const Individual&) const = default;
};

/// How well the fitness of an individual is known when survivors are selected.
enum class Knowledge {
  evaluated,  ///< at all levels
  failed,     ///< some evaluation did not complete: no fitness
  bounded,    ///< at some levels or none; what is known rules survival out
  duplicate,  ///< an earlier individual had its phenotype, and duplicates are culled: no fitness
  penalised   ///< it falls apart: no fitness
};
std::string_view to_string(Knowledge knowledge);

/// An individual in the selection of one generation.
struct Contender {
  std::uint64_t id = 0;
  int age = 0;
  Knowledge knowledge = Knowledge::evaluated;
  std::optional<double> fitness;             ///< exists exactly for `evaluated`
  std::optional<double> fitness_bound;       ///< for `bounded`: the fitness is at most this, if anything is known
  std::optional<std::size_t> survivor_rank;  ///< position among the survivors; none: culled

  bool operator==(const Contender&) const = default;
};

/// A design of an archive that has a fitness, once per phenotype.
struct FitDesign {
  std::uint64_t individual = 0;  ///< the first that had the phenotype
  Phenotype phenotype;
  double fitness = 0.0;  ///< in the unit of the objective
};

/// What another judge than that of the search found of a design.
struct Reevaluation {
  std::string design_hash;  ///< design_hash() of the phenotype at the level
  int level = 1;
  std::string protocol;  ///< all that decides the result beside the body, as canonical text
  std::string variant;   ///< name of the protocol among those that were judged together, for people
  double duration_s = 0.0;
  Evaluation result;  ///< status `stopped` only where a stated budget ended it

  bool has_result = true;  ///< false: the judge failed, result.reason says how; there is no status
};

/// What a judge that takes part in a search found of a robot.
struct Judgement {
  int generation = 0;               ///< before which it was judged
  std::size_t place = 0;            ///< among the robots of that generation, from 0: the best first
  std::uint64_t individual = 0;     ///< that was judged for all of its form
  std::string form;                 ///< robot_form of its basal body
  double surrogate = 0.0;           ///< score by the evaluator of the search
  std::optional<double> score;      ///< by the judge; none if it failed
  std::uint64_t element_steps = 0;  ///< what it took
  Reevaluation found;
};

/// A finished generation.
struct GenerationRecord {
  int number = 0;
  std::uint64_t evaluations = 0;    ///< made for this generation
  std::uint64_t cached = 0;         ///< results that were used and known before, or asked for twice
  std::uint64_t pruned = 0;         ///< results that were not needed
  double seconds = 0.0;             ///< wall time of the process that finished it; never compared
  std::string variation_generator;  ///< state of the random streams after the generation
  std::string selection_generator;

  bool operator==(const GenerationRecord&) const = default;
};

/// The archive of one search in an SQLite database: everything to continue it, to tell its history and to judge its designs.
///
/// Displacements that were left out, judgements and checks of the time step have tables of their own, which only searches have
/// that know such.
///
/// Every change is one transaction, which outlives the process once the call returns (write-ahead log). Rows have natural keys
/// only, so that two runs of a study hold the same content, apart from the columns named `seconds`. One process writes, any
/// number may read meanwhile. Calls from several threads must not overlap.
class RunArchive {
 public:
  /// Studies of versions 2 and 3 have keys of earlier names. Such an archive is read, and re-evaluations are added to it, but no
  /// search goes on with it. Version 2 had no re-evaluations and becomes version 3 with the first.
  static constexpr int schema_version = 4;

  /// Opens the archive of a study for writing, and makes it if there is none.
  /// @param study identity_text of the study @param generations that the run is to reach; kept for readers
  /// @throws io::InputError if the file is no archive, is damaged, has another schema version, belongs to another study (naming
  /// the first difference), is being written to by another process, or cannot be written; it is left as it is
  static RunArchive open(const std::filesystem::path& file, std::string_view study, int generations);

  /// Opens an archive that exists to add re-evaluations to it. @throws io::InputError as open does
  static RunArchive open_to_extend(const std::filesystem::path& file);

  /// Opens an archive that exists, for reading. @throws io::InputError as open does
  static RunArchive open_to_read(const std::filesystem::path& file);

  ~RunArchive();
  RunArchive(RunArchive&&) noexcept;
  RunArchive& operator=(RunArchive&&) noexcept;

  [[nodiscard]] const std::filesystem::path& file() const;
  [[nodiscard]] std::string study() const;    ///< identity_text of the study
  [[nodiscard]] int generation_goal() const;  ///< that the latest run was to reach

  [[nodiscard]] std::optional<int> last_generation() const;  ///< none before generation 0 is finished
  [[nodiscard]] GenerationRecord generation(int number) const;
  [[nodiscard]] std::vector<Contender> contenders(int generation) const;  ///< by id
  [[nodiscard]] Individual individual(std::uint64_t id) const;
  [[nodiscard]] std::uint64_t next_id() const;                    ///< one more than the largest id, or 0
  [[nodiscard]] std::vector<std::string> phenotype_keys() const;  ///< of all individuals, each once

  /// An archive of an earlier version finds it by design and level: all its results are of one physics, whose text was another.
  [[nodiscard]] std::optional<ArchivedEvaluation> evaluation(const EvaluationKey& asked) const;

  [[nodiscard]] std::vector<EvaluationSteps> evaluation_steps() const;  ///< of all evaluations, by design, level and physics

  /// Results of which some model left its range of validity, first asked for by a generation.
  [[nodiscard]] std::uint64_t evaluations_outside_validity(int generation) const;

  /// All designs that some generation gave a fitness, the best first; of equals the first individual first.
  [[nodiscard]] std::vector<FitDesign> fit_designs() const;

  /// By design, level and protocol; none in an archive of version 2.
  [[nodiscard]] std::vector<Reevaluation> reevaluations() const;

  /// Adds all in one transaction. One of the same design, level and protocol is replaced, but never an outcome of the physics by
  /// a run that was stopped or failed.
  void add_reevaluations(std::span<const Reevaluation> reevaluations);

  /// What judges found in the course of the search, by generation and place.
  [[nodiscard]] std::vector<Judgement> judgements() const;

  /// Adds judgements and their re-evaluations in one transaction. Precondition: there is none of their generations and places.
  void add_judgements(std::span<const Judgement> judgements);

  /// A result with half the time step, beside that of the search; found as evaluation() finds its own.
  [[nodiscard]] std::optional<ArchivedEvaluation> step_check(const EvaluationKey& key) const;

  /// Precondition: there is no check under this key, and its status is not `stopped`.
  void add_step_check(const EvaluationKey& key, const ArchivedEvaluation& evaluation);

  /// Precondition: there is no result under this key, and its status is not `stopped`.
  void add_evaluation(const EvaluationKey& key, const ArchivedEvaluation& evaluation);

  /// Precondition: the generation before is there, this one is not.
  void add_generation(const GenerationRecord& record, std::span<const Individual> born, std::span<const Contender> contenders);

 private:
  class Database;
  explicit RunArchive(std::unique_ptr<Database> database);

  std::unique_ptr<Database> database_;
};

}  // namespace menger::evolution
