#include "evolution/verdict/shape_findings.h"

#include <algorithm>
#include <string>

#include "evolution/verdict/finding_words.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/joined_text.h"
#include "meshes/load_cases/shape_agreement.h"

namespace menger::evolution {
namespace {

Tone tone_of_error(double median) {
  if (median <= judged_by::good_error) return Tone::good;
  return median <= judged_by::usable_error ? Tone::caution : Tone::bad;
}

/// Of one body alone, whether the surrogate takes its shape well, as the loop judges it.
/// @pre displacements have a median error
Tone tone_of(const ValidationFacts& facts) {
  if (facts.bodies == 1) {
    const double displacement = std::max(*facts.displacement.median, facts.displacement_outside.value_or(0.0));
    const double volume = std::max(facts.volume.median.value_or(0.0), facts.volume_outside.value_or(0.0));
    return meshes::is_shape_close(displacement, volume, facts.wrong_signs) ? Tone::good : Tone::bad;
  }
  const Tone by_size = tone_of_error(*facts.displacement.median);
  return facts.wrong_signs > 0 ? std::max(by_size, Tone::caution) : by_size;
}

/// Whether all that was compared lies outside the range of the fit, of one body alone.
bool is_all_outside(const ValidationFacts& facts) { return facts.bodies == 1 && !facts.displacement.median && facts.outside > 0; }

/// ": it is longer than the bodies of the fit"; empty if it is not known.
std::string why_text(const ValidationFacts& facts) {
  return facts.outside_why.empty() ? "" : ": " + io::joined(facts.outside_why, "; ");
}

/// " 6 of 36 displacements of at least 0.2 mm go the wrong way: extent y (5 of 5)."; empty if none does.
std::string wrong_signs_text(const ValidationFacts& facts) {
  if (facts.wrong_signs == 0) return "";
  return " " + std::to_string(facts.wrong_signs) + " of " + io::counted(facts.signs, "displacement") + " of at least " +
         io::millimetres(meshes::smallest_signed_m) + (facts.wrong_signs == 1 ? " goes" : " go") +
         " the wrong way: " + io::joined(facts.wrong_ways, ", ") + ".";
}

}  // namespace

Finding finding_on_shapes(const ValidationFacts& facts) {
  const ErrorFact& shapes = facts.displacement;
  if (is_all_outside(facts)) {
    const std::string outside = "all that was compared lies outside the range of its fit" + why_text(facts) + ".";
    if (!facts.displacement_outside) return {Tone::bad, "Do not trust the surrogate for this body: " + outside, facts.source};
    const std::string errors = io::percents(*facts.displacement_outside) + " off finite elements (median)" +
                               (facts.volume_outside ? ", its volumes " + io::percents(*facts.volume_outside) : "");
    if (meshes::is_shape_close(*facts.displacement_outside, facts.volume_outside.value_or(0.0), facts.wrong_signs))
      return {Tone::caution, "The surrogate's shapes are " + errors + ", though " + outside, facts.source};
    return {Tone::bad,
            "Do not trust the surrogate for this body: its shapes are " + errors + "." + wrong_signs_text(facts) + " Also, " +
                outside,
            facts.source};
  }
  if (!shapes.median) {
    return {
        Tone::caution,
        "Whether the surrogate takes the right shapes is not known: no displacement was compared inside the range of its fit.",
        facts.source};
  }
  const bool has_bodies = facts.bodies > 1;
  std::string text = "The surrogate's shapes are " + io::percents(*shapes.median) +
                     (shapes.median_m && !has_bodies ? " (" + io::millimetres(*shapes.median_m, 2) + ")" : "") +
                     " off finite elements (median of " + io::counted(shapes.count, "displacement") + " of " +
                     io::counted(facts.bodies, "body", "bodies") + ", inside the range of the fit";
  if (shapes.worst) {
    text += "; the worst is " + io::percents(*shapes.worst) + " off";
    if (shapes.worst_m) text += ", or " + io::millimetres(*shapes.worst_m);
    if (has_bodies) text += ", of " + shapes.worst_body;
    if (shapes.worst_m) text += (has_bodies ? " in " : ", in ") + shapes.worst_observable;
  }
  if (shapes.furthest_m && shapes.furthest_error && shapes.worst_m && *shapes.worst_m < *shapes.furthest_m) {
    text += "; furthest off over the length of its body, by " + io::millimetres(*shapes.furthest_m) + " or " +
            io::percents(*shapes.furthest_error) + ", is " + (has_bodies ? shapes.furthest_body + " in " : "") +
            shapes.furthest_observable;
  }
  text += ")";
  if (facts.volume.median) text += ", its volumes " + io::percents(*facts.volume.median);
  text += ".";
  text += wrong_signs_text(facts);
  if (shapes.without_equilibrium > 0)
    text += " In " + io::counted(shapes.without_equilibrium, "state") + " it found no equilibrium.";
  if (facts.outside > 0) {
    text += " " +
            io::counted(facts.outside, "number outside the range of the fit does", "numbers outside the range of the fit do") +
            " not count here" + (has_bodies ? "" : why_text(facts)) + ".";
  }
  if (facts.bodies == 1 && tone_of(facts) == Tone::bad) text += " Do not trust the surrogate for this body.";
  return {tone_of(facts), text, facts.source};
}

Finding validation_finding(const ValidationFacts& facts) {
  Finding finding = finding_on_shapes(facts);
  if (facts.early_end.empty()) return finding;
  finding.text += " Its finite elements, quadratic ones, ended before the pressure of the drive (" + facts.early_end + ").";
  finding.tone = std::max(finding.tone, Tone::caution);
  return finding;
}

Finding calibration_finding(const CalibrationFacts& facts) {
  if (!facts.median_error)
    return {Tone::bad, "The calibration of the surrogate gave no result (" + with_reason(facts.status, facts.reason) + ").",
            facts.source};
  std::string text =
      "The fitted surrogate is " + io::percents(*facts.median_error) + " off the finite elements it was fitted to (median of " +
      io::counted(facts.quantities, "quantity", "quantities") + " of " + io::counted(facts.cases, "load case") + ")";
  if (facts.worst_error) text += "; the worst is " + io::percents(*facts.worst_error) + " off (" + facts.worst_case + ")";
  text += ".";
  if (facts.status != io::RunStatus::completed) text += " The fit ended early (" + with_reason(facts.status, facts.reason) + ").";
  if (!facts.explained) text += " This is more than the uncertainty of the curves explains: the surrogate differs in shape.";
  const bool good = facts.explained && facts.status == io::RunStatus::completed && *facts.median_error <= judged_by::good_error;
  return {good ? Tone::good : Tone::caution, text, facts.source};
}

Tone tone_of_shapes(const ReportFacts& facts) {
  Tone worst = Tone::missing;
  for (const ValidationFacts& one : facts.validations) {
    if (one.displacement.median)
      worst = worse_of(worst, tone_of(one));
    else if (is_all_outside(one))
      worst = worse_of(worst, finding_on_shapes(one).tone);
  }
  return worst;
}

std::string shape_headline(const ReportFacts& facts, Tone worst, bool were_walks_compared) {
  const std::string walks = were_walks_compared ? "its walks say nothing." : "its walks were not compared.";
  if (worst == Tone::good) return "The surrogate's shapes can be used; " + walks;
  if (worst != Tone::caution) return "Do not trust the surrogate's shapes; " + walks;
  const bool is_rough = std::ranges::any_of(
      facts.validations, [](const ValidationFacts& one) { return one.displacement.median && tone_of(one) == Tone::caution; });
  return (is_rough ? "The surrogate's shapes are rough; "
                   : "The surrogate's shapes are close to finite elements, though some outside the range of its fit; ") +
         walks;
}

}  // namespace menger::evolution
