#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "voxel/model/body_kind.h"
#include "voxel/model/calibrated_body.h"

namespace menger::voxel {

/// How far calibrated voxels were off on bodies of one kind that no fit has seen. Errors are fractions of the largest magnitude
/// of an observable, inside the range of validity.
struct KindErrors {
  std::vector<std::string> bodies{};  ///< names
  std::size_t displacements = 0;      ///< numbers compared
  std::size_t volumes = 0;
  /// Nothing if no number was compared, or if so many have no response that it is unknown. Likewise the next two.
  std::optional<double> displacement_median{};
  std::optional<double> displacement_ninth_decile{};
  std::optional<double> volume_median{};
  std::size_t signs = 0;        ///< displacements that are large enough for a sign
  std::size_t wrong_signs = 0;  ///< of these, those that went the wrong way

  bool operator==(const KindErrors&) const = default;
};

/// What a validation found for voxel parameters, by kind of body. Its file lies beside that of the parameters, and
/// `menger validate --keep` writes it.
struct ExpectedErrors {
  std::string parameters_hash;                    ///< of their text, see hash_of
  ByBodyKind<std::optional<KindErrors>> kinds{};  ///< nothing for a kind of which no body was compared

  [[nodiscard]] const std::optional<KindErrors>& of(BodyKind kind) const { return kinds.at(static_cast<std::size_t>(kind)); }
  bool operator==(const ExpectedErrors&) const = default;
};

/// The largest median error in displacement of which users are not warned.
inline constexpr double largest_good_error = 0.15;

/// Returns the hash by which a table of errors knows its parameters: that of surrogate_text.
std::string hash_of(const SurrogateParameters& parameters);

/// Returns the table: a row for each kind with bodies, with its columns named as the members of KindErrors.
io::CsvTable expected_errors_table(const ExpectedErrors& errors);

/// Returns where the table of a file of parameters lies: "soft.errors.csv" beside "soft.toml".
std::filesystem::path expected_errors_file(const std::filesystem::path& parameters_file);

/// Reads the table of a file of parameters; nothing if there is none.
/// @throws io::InputError with file, column and value
std::optional<ExpectedErrors> read_expected_errors(const std::filesystem::path& parameters_file);

/// Returns the errors of a validation together with those that an earlier one found, by other load cases, for kinds of bodies
/// that it did not compare. An earlier one of other parameters counts for nothing.
ExpectedErrors together_with(const ExpectedErrors& found, const std::optional<ExpectedErrors>& earlier);

/// What is known of the errors of calibrated parameters, and where from.
struct KnownErrors {
  std::optional<ExpectedErrors> errors{};  ///< nothing if none hold for the parameters
  std::string missing{};                   ///< then: why not, as a sentence without its end
};

/// Finds what is known of the errors of parameters. A table of parameters with other values counts for nothing.
/// @param parameters_file nothing if they do not come from a file
/// @throws io::InputError as read_expected_errors
KnownErrors known_errors(const SurrogateParameters& parameters, const std::optional<std::filesystem::path>& parameters_file);

/// Returns what to expect of a body, as sentences for people: the errors of its kind, then warnings where they are large, where
/// displacements went the wrong way, and where no validation covers the body, its drive or its parameters.
std::vector<std::string> expected_error_text(const KnownErrors& known, const CalibratedBody& calibrated,
                                             const meshes::Polycube& basal_body);

/// Returns what to expect of a search among bodies of all kinds, likewise.
/// @param has_aggregates whether it has bodies of several modules
std::vector<std::string> expected_error_text(const KnownErrors& known, bool has_aggregates);

}  // namespace menger::voxel
