#include "voxel/validation/validation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

#include "io/text/joined_text.h"

namespace menger::voxel {

namespace {

using meshes::LoadCase;
using meshes::LoadCaseKind;
using meshes::ResponseCurve;

ObservableKind kind_of(const std::string& column) {
  if (column == "volume_change") return ObservableKind::volume;
  if (column == "force_N" || column == "moment_N_m") return ObservableKind::force;
  if (column == "frequency_1_Hz") return ObservableKind::frequency;
  if (column.starts_with("frequency_")) return ObservableKind::higher_frequency;
  return ObservableKind::displacement;
}

auto identity(const LoadCase& load_case) {
  return std::tie(load_case.cells, load_case.digits, load_case.level, load_case.per_phase);
}

/// A name without the word for its kind and the sign that joins them.
std::string without_kind(std::string name, LoadCaseKind kind) {
  const std::string word(to_string(kind));
  const auto joins = [](char sign) { return sign == '_' || sign == '-'; };
  if (name.size() <= word.size() + 1) return name;
  if (name.ends_with(word) && joins(name[name.size() - word.size() - 1])) {
    name.resize(name.size() - word.size() - 1);
  } else if (name.starts_with(word) && joins(name[word.size()])) {
    name.erase(0, word.size() + 1);
  }
  return name;
}

/// One name for a body whose curves have several: their common beginning, as far as it ends where words join; all names if there
/// is none, so that no curve passes for one of another body.
std::string common_name(const std::vector<std::string>& names) {
  std::string common = names.front();
  for (const std::string& name : names) {
    const auto differ = std::mismatch(common.begin(), common.end(), name.begin(), name.end());
    const bool ends_a_word =
        differ.first == common.end() && (differ.second == name.end() || *differ.second == '_' || *differ.second == '-');
    if (ends_a_word) continue;
    common.erase(differ.first, common.end());
    const auto join = common.find_last_of("_-");
    common.resize(join == std::string::npos ? 0 : join);
  }
  return common.empty() ? io::joined(names, "+") : common;
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Scale of the errors of each column; 0 for abscissae.
std::vector<double> scales_of(const ResponseCurve& curve) {
  constexpr double least_share = 0.01;
  const std::size_t first = meshes::abscissa_count(curve.provenance.load_case.kind);
  std::array<double, observable_kind_count> largest_of_kind{};
  std::vector<double> scales(curve.columns.size(), 0.0);
  for (std::size_t column = first; column < scales.size(); ++column) {
    scales[column] = largest_magnitude(curve.values[column]);
    double& largest = largest_of_kind.at(static_cast<std::size_t>(kind_of(curve.columns[column])));
    largest = std::max(largest, scales[column]);
  }
  for (std::size_t column = first; column < scales.size(); ++column) {
    const double of_kind = largest_of_kind.at(static_cast<std::size_t>(kind_of(curve.columns[column])));
    scales[column] = std::max(scales[column], least_share * of_kind);
  }
  return scales;
}

void set_errors(ObservableError& error, double scale) {
  constexpr double least_share = 1e-3;
  const double difference = error.surrogate - error.reference;
  error.error = difference / scale;
  if (std::abs(error.reference) >= least_share * scale) error.pointwise_error = difference / std::abs(error.reference);
}

bool is_at_rest(const std::vector<double>& state) {
  return std::all_of(state.begin(), state.end(), [](double abscissa) { return abscissa == 0.0; });
}

std::optional<double> imposed_of(const std::vector<double>& state) {
  return state.size() > 1 ? std::optional(state[1]) : std::nullopt;
}

/// Slope of the least-squares straight line; nothing if all x are equal.
std::optional<double> slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0.0)) return std::nullopt;
  return xy / xx;
}

std::vector<double> part(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  return {values.begin() + static_cast<std::ptrdiff_t>(begin), values.begin() + static_cast<std::ptrdiff_t>(end)};
}

/// Responses of a column in consecutive rows; nothing if a row has none.
std::optional<std::vector<double>> responses_between(const CurveComparison& comparison, std::size_t column, std::size_t begin,
                                                     std::size_t end) {
  std::vector<double> responses;
  for (std::size_t row = begin; row < end; ++row) {
    if (!comparison.response_rows[row]) return std::nullopt;
    responses.push_back(comparison.response.values[column][*comparison.response_rows[row]]);
  }
  return responses;
}

/// The first validity of consecutive rows that is not inside; inside if there is none.
Validity validity_of_rows(const std::vector<Validity>& validity, std::size_t begin, std::size_t end) {
  const auto first = validity.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = validity.begin() + static_cast<std::ptrdiff_t>(end);
  const auto outside = std::find_if(first, last, [](Validity of_row) { return of_row != Validity::inside; });
  return outside == last ? Validity::inside : *outside;
}

/// Adds the errors of the slopes of column 2 over column 1 at each pressure.
void add_stiffness(CurveComparison& comparison) {
  const std::vector<Validity>& validity = comparison.validity;
  const ResponseCurve& curve = comparison.curve;
  const std::vector<double>& pressures = curve.values[0];
  std::vector<ObservableError> errors;
  double scale = 0.0;
  for (std::size_t begin = 0, end = 0; begin < pressures.size(); begin = end) {
    while (end < pressures.size() && pressures[end] == pressures[begin]) ++end;
    const std::vector<double> imposed = part(curve.values[1], begin, end);
    const std::optional<double> reference = slope(imposed, part(curve.values[2], begin, end));
    if (!reference) continue;
    scale = std::max(scale, std::abs(*reference));
    const std::optional<std::vector<double>> forces = responses_between(comparison, 2, begin, end);
    if (!forces) {
      comparison.without_equilibrium.push_back({ObservableKind::stiffness, validity_of_rows(validity, begin, end)});
      continue;
    }
    ObservableError error;
    error.kind = ObservableKind::stiffness;
    error.observable = curve.columns[1] == "angle_rad" ? "stiffness_N_m_per_rad" : "stiffness_N_per_m";
    error.pressure_Pa = pressures[begin];
    error.reference = *reference;
    error.surrogate = *slope(imposed, *forces);
    error.validity = validity_of_rows(validity, begin, end);
    errors.push_back(error);
  }
  if (!(scale > 0.0)) return;
  for (ObservableError& error : errors) {
    set_errors(error, scale);
    comparison.errors.push_back(error);
  }
}

void add_column(CurveComparison& comparison, std::size_t column, double scale, const std::vector<std::vector<double>>& states) {
  const ResponseCurve& curve = comparison.curve;
  const ObservableKind kind = kind_of(curve.columns[column]);
  const std::vector<double>& responses = comparison.response.values[column];
  const bool says_something_at_rest = comparison.load_case().kind == LoadCaseKind::modes;
  for (std::size_t row = 0; row < states.size(); ++row) {
    if (is_at_rest(states[row]) && !says_something_at_rest) continue;
    if (!comparison.response_rows[row]) {
      comparison.without_equilibrium.push_back({kind, comparison.validity[row]});
      continue;
    }
    ObservableError error;
    error.kind = kind;
    error.observable = curve.columns[column];
    error.pressure_Pa = states[row].front();
    error.imposed = imposed_of(states[row]);
    error.reference = curve.values[column][row];
    error.surrogate = responses[*comparison.response_rows[row]];
    error.validity = comparison.validity[row];
    set_errors(error, scale);
    comparison.errors.push_back(error);
  }
}

/// Adds the responses to some rows of the curve, which were computed in this order.
void add_responses(CurveComparison& comparison, const std::vector<std::size_t>& rows, const LoadCaseResponse& part) {
  LoadCaseResponse& response = comparison.response;
  if (response.status == io::RunStatus::completed) {
    response.status = part.status;
    response.reason = part.reason;
  }
  response.smallest_strain = std::min(response.smallest_strain, part.smallest_strain);
  response.largest_strain = std::max(response.largest_strain, part.largest_strain);
  response.values.resize(comparison.curve.columns.size());  // without any state reached there may be no columns
  if (part.values.empty()) return;
  response.columns = part.columns;
  const std::size_t before = response.values.front().size();
  const std::size_t reached = std::min(rows.size(), part.values.front().size());
  for (std::size_t n = 0; n < reached; ++n) comparison.response_rows[rows[n]] = before + n;
  for (std::size_t column = 0; column < part.values.size(); ++column)
    response.values[column].insert(response.values[column].end(), part.values[column].begin(), part.values[column].end());
}

/// Computes the responses to all states.
void compute_all(CurveComparison& comparison, const std::vector<std::vector<double>>& states,
                 const SurrogateParameters& parameters, const Responder& responder) {
  std::vector<std::size_t> all;
  std::vector<std::size_t> under_pressure;
  std::vector<std::size_t> under_vacuum;
  for (std::size_t row = 0; row < states.size(); ++row) {
    all.push_back(row);
    (states[row].front() < 0.0 ? under_vacuum : under_pressure).push_back(row);
  }
  std::reverse(under_vacuum.begin(), under_vacuum.end());
  comparison.response_rows.assign(states.size(), std::nullopt);
  const LoadCaseResponse whole = responder(parameters, comparison.load_case(), states);
  if (whole.status == io::RunStatus::completed || under_vacuum.empty()) return add_responses(comparison, all, whole);
  for (const std::vector<std::size_t>& rows : {under_pressure, under_vacuum}) {
    if (rows.empty()) continue;
    std::vector<std::vector<double>> some;
    some.reserve(rows.size());
    for (const std::size_t row : rows) some.push_back(states[row]);
    add_responses(comparison, rows, responder(parameters, comparison.load_case(), some));
  }
}

/// The validity of each row.
std::vector<Validity> claims(const CurveComparison& comparison, const std::vector<std::vector<double>>& states,
                             const SurrogateParameters& parameters, const Responder& responder) {
  std::vector<Validity> validity = validities(states, comparison.load_case(), comparison.response, parameters, responder);
  // Without an equilibrium there are no strains, so these cannot be the reason.
  for (std::size_t row = 0; row < validity.size(); ++row) {
    if (!comparison.response_rows[row] && validity[row] == Validity::strain) validity[row] = Validity::inside;
  }
  return validity;
}

}  // namespace

std::string_view to_string(ObservableKind kind) {
  constexpr std::array<std::string_view, observable_kind_count> words{"displacement", "volume",    "force",
                                                                      "stiffness",    "frequency", "higher_frequency"};
  return words.at(static_cast<std::size_t>(kind));
}

std::vector<std::string> body_names(const std::vector<ResponseCurve>& curves) {
  // The place of the first curve of the same body, for each curve; and the distinct names at these places.
  std::vector<std::size_t> firsts;
  std::map<std::size_t, std::vector<std::string>> candidates;
  for (std::size_t n = 0; n < curves.size(); ++n) {
    const LoadCase& load_case = curves[n].provenance.load_case;
    std::size_t first = 0;
    while (identity(curves[first].provenance.load_case) != identity(load_case)) ++first;
    firsts.push_back(first);
    std::vector<std::string>& known = candidates[first];
    const std::string name = without_kind(load_case.name, load_case.kind);
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  }
  std::map<std::size_t, std::string> names;
  std::set<std::string> taken;
  for (const auto& [first, known] : candidates) {
    std::string name = common_name(known);
    if (taken.contains(name)) name = curves[first].provenance.load_case.name + "_" + std::to_string(first + 1);
    taken.insert(name);
    taken.insert(known.begin(), known.end());  // a part of one body's name must not be another's
    names.emplace(first, std::move(name));
  }
  std::vector<std::string> of_curves;
  of_curves.reserve(firsts.size());
  for (const std::size_t first : firsts) of_curves.push_back(names.at(first));
  return of_curves;
}

std::vector<std::vector<double>> states_of(const ResponseCurve& curve) {
  const std::size_t abscissae = meshes::abscissa_count(curve.provenance.load_case.kind);
  std::vector<std::vector<double>> states(curve.row_count());
  for (std::size_t row = 0; row < states.size(); ++row) {
    for (std::size_t column = 0; column < abscissae; ++column) states[row].push_back(curve.values[column][row]);
  }
  return states;
}

CurveComparison compare(const ResponseCurve& curve, const std::string& body, const SurrogateParameters& parameters,
                        const Responder& responder, const std::optional<std::vector<Validity>>& validity) {
  CurveComparison comparison{
      .curve = curve, .body = body, .response = {}, .response_rows = {}, .validity = {}, .errors = {}, .without_equilibrium = {}};
  const std::vector<std::vector<double>> states = states_of(curve);
  compute_all(comparison, states, parameters, responder);
  assert(!validity || validity->size() == states.size());
  comparison.validity = validity ? *validity : claims(comparison, states, parameters, responder);
  const std::vector<double> scales = scales_of(curve);
  for (std::size_t column = 0; column < scales.size(); ++column) {
    if (scales[column] > 0.0) add_column(comparison, column, scales[column], states);
  }
  if (states.front().size() == 2 && kind_of(curve.columns[2]) == ObservableKind::force) add_stiffness(comparison);
  return comparison;
}

}  // namespace menger::voxel
