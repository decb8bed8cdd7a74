#include "voxel/model/expected_errors.h"

#include <algorithm>
#include <cstdint>
#include <sstream>

#include "io/shown/shown_quantity.h"
#include "io/text/content_hash.h"
#include "io/text/joined_text.h"
#include "voxel/model/surrogate_file.h"

namespace menger::voxel {
namespace {

constexpr std::string_view warning = "warning: ";

std::string percents(const std::optional<double>& fraction) { return fraction ? io::percents(*fraction) : "an unknown share"; }

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

KindErrors kind_errors(const io::CsvContents& table, std::size_t row) {
  KindErrors errors{.bodies = words_of(table.text(row, "bodies"))};
  errors.displacements = table.count(row, "displacements");
  errors.volumes = table.count(row, "volumes");
  errors.displacement_median = table.optional_number(row, "displacement_median", io::non_negative());
  errors.displacement_ninth_decile = table.optional_number(row, "displacement_ninth_decile", io::non_negative());
  errors.volume_median = table.optional_number(row, "volume_median", io::non_negative());
  errors.signs = table.count(row, "signs");
  errors.wrong_signs = table.count(row, "wrong_signs");
  return errors;
}

std::string bodies_text(std::size_t count) { return count == 1 ? "1 body" : std::to_string(count) + " bodies"; }

/// What the medians of a kind are taken over.
std::string basis_text(const std::vector<std::string>& bodies) {
  if (bodies.size() == 1) return "of one body alone, \"" + bodies.front() + "\", which tells little of others";
  return "median over " + bodies_text(bodies.size()) + " of this kind that no fit has seen";
}

bool is_bad(const KindErrors& errors) { return !errors.displacement_median || *errors.displacement_median > largest_good_error; }

/// "9 % in displacement and 4 % in chamber volume"
std::string medians_text(const KindErrors& errors) {
  const std::string displacement = percents(errors.displacement_median) + " in displacement";
  return errors.volumes > 0 ? displacement + " and " + percents(errors.volume_median) + " in chamber volume" : displacement;
}

std::string ninth_decile_text(const KindErrors& errors) {
  return errors.displacement_ninth_decile ? "one in ten by more than " + percents(*errors.displacement_ninth_decile)
                                          : std::string("one displacement in ten has no value");
}

std::string poor_model_of(BodyKind kind) {
  return std::string(warning) + "the voxels are a poor model of " + std::string(plural_name(kind)) +
         ": the median error in displacement is above " + percents(largest_good_error);
}

std::string wrong_signs_text(const KindErrors& errors) {
  return std::to_string(errors.wrong_signs) + " of " + std::to_string(errors.signs);
}

std::string no_validation_of(BodyKind kind) {
  return std::string(warning) + "no validation of these parameters covers " + std::string(plural_name(kind)) +
         ": the error is unknown";
}

constexpr const char* about_shape = "this is of inflated shapes; a walk can be off by much more";

}  // namespace

std::string hash_of(const SurrogateParameters& parameters) { return io::content_hash(surrogate_text(parameters)); }

io::CsvTable expected_errors_table(const ExpectedErrors& errors) {
  io::CsvTable table({"kind", "displacement_median", "displacement_ninth_decile", "volume_median", "displacements", "volumes",
                      "signs", "wrong_signs", "body_count", "bodies", "parameters_sha256"});
  for (const BodyKind kind : body_kinds) {
    const std::optional<KindErrors>& of_kind = errors.of(kind);
    if (!of_kind) continue;
    const auto number = [](std::size_t count) { return std::uint64_t{count}; };
    table.add_row(to_string(kind), of_kind->displacement_median, of_kind->displacement_ninth_decile, of_kind->volume_median,
                  number(of_kind->displacements), number(of_kind->volumes), number(of_kind->signs), number(of_kind->wrong_signs),
                  number(of_kind->bodies.size()), io::joined(of_kind->bodies, " "), errors.parameters_hash);
  }
  return table;
}

std::filesystem::path expected_errors_file(const std::filesystem::path& parameters_file) {
  return std::filesystem::path(parameters_file).replace_extension(".errors.csv");
}

std::optional<ExpectedErrors> read_expected_errors(const std::filesystem::path& parameters_file) {
  const std::filesystem::path file = expected_errors_file(parameters_file);
  if (!std::filesystem::exists(file)) return std::nullopt;
  const io::CsvContents table = io::read_csv(file);
  ExpectedErrors errors;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string& word = table.text(row, "kind");
    const std::optional<BodyKind> kind = body_kind(word);
    const std::string& hash = table.text(row, "parameters_sha256");
    if (!kind) throw io::InputError(file.string() + ": kind = \"" + word + "\": is no kind of body");
    if (row > 0 && hash != errors.parameters_hash)
      throw io::InputError(file.string() + ": parameters_sha256 = \"" + hash + "\": is not that of the first row");
    errors.parameters_hash = hash;
    std::optional<KindErrors>& of_kind = errors.kinds.at(static_cast<std::size_t>(*kind));
    if (of_kind) throw io::InputError(file.string() + ": kind = \"" + word + "\": is there twice");
    of_kind = kind_errors(table, row);
  }
  return errors;
}

ExpectedErrors together_with(const ExpectedErrors& found, const std::optional<ExpectedErrors>& earlier) {
  ExpectedErrors all = found;
  if (!earlier || earlier->parameters_hash != found.parameters_hash) return all;
  for (std::size_t kind = 0; kind < all.kinds.size(); ++kind) {
    if (!all.kinds[kind]) all.kinds[kind] = earlier->kinds[kind];
  }
  return all;
}

KnownErrors known_errors(const SurrogateParameters& parameters, const std::optional<std::filesystem::path>& parameters_file) {
  if (!parameters_file) return {.missing = "the parameters come without a file, beside which a table of errors could lie"};
  KnownErrors known{.errors = read_expected_errors(*parameters_file)};
  const std::string place = parameters_file->filename().string();
  if (!known.errors) {
    known.missing = "no table of errors lies beside " + place + ", which menger validate --keep would write";
  } else if (std::ranges::none_of(body_kinds, [&](BodyKind kind) { return known.errors->of(kind).has_value(); })) {
    known.missing =
        "the table of errors beside " + place + " is empty: they were not compared with other bodies (menger validate --keep)";
    known.errors.reset();
  } else if (known.errors->parameters_hash != hash_of(parameters)) {
    known.missing = "the table of errors beside " + place + " is that of other values";
    known.errors.reset();
  }
  return known;
}

std::vector<std::string> expected_error_text(const KnownErrors& known, const CalibratedBody& calibrated,
                                             const meshes::Polycube& basal_body) {
  if (!known.errors) return {std::string(warning) + "the error of these parameters is unknown: " + known.missing};
  const BodyKind kind = kind_of(basal_body, calibrated.level);
  const std::optional<KindErrors>& errors = known.errors->of(kind);
  if (!errors) return {no_validation_of(kind)};
  const std::vector<std::string> faults = outside_validity(calibrated, basal_body);
  std::vector<std::string> lines{"expected error for " + std::string(name_of(kind)) +
                                 (faults.empty() ? ": " : ", if the fit covered it: ") + medians_text(*errors) + " (" +
                                 basis_text(errors->bodies) + "; " + ninth_decile_text(*errors) + "); " + about_shape};
  if (is_bad(*errors)) lines.push_back(poor_model_of(kind));
  if (errors->wrong_signs > 0)
    lines.push_back(std::string(warning) + wrong_signs_text(*errors) +
                    " displacements went the wrong way on bodies of this kind");
  for (const std::string& fault : faults) lines.push_back(std::string(warning) + "no validation covers this body: " + fault);
  return lines;
}

std::vector<std::string> expected_error_text(const KnownErrors& known, bool has_aggregates) {
  if (!known.errors) return {std::string(warning) + "the error of the voxels is unknown: " + known.missing};
  std::vector<std::string> lines{
      std::string("expected errors of the voxels, by kind of body (medians over bodies that no fit has seen); ") + about_shape};
  std::vector<std::string> warnings;
  std::vector<std::string> wrong_signs;
  for (const BodyKind kind : body_kinds) {
    if (is_aggregate(kind) && !has_aggregates) continue;
    const std::optional<KindErrors>& errors = known.errors->of(kind);
    if (!errors) {
      warnings.push_back(no_validation_of(kind));
      continue;
    }
    const std::string plural(plural_name(kind));
    lines.push_back("  " + plural + ": " + medians_text(*errors) + " (" + bodies_text(errors->bodies.size()) + "; " +
                    ninth_decile_text(*errors) + ")");
    if (is_bad(*errors)) warnings.push_back(poor_model_of(kind));
    if (errors->wrong_signs > 0) wrong_signs.push_back(plural + " (" + wrong_signs_text(*errors) + ")");
  }
  lines.insert(lines.end(), warnings.begin(), warnings.end());
  if (!wrong_signs.empty())
    lines.push_back(std::string(warning) + "displacements went the wrong way on " + io::joined(wrong_signs));
  return lines;
}

}  // namespace menger::voxel
