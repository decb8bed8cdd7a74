#include "fem/load_cases/load_case_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fem/load_cases/load_case_body.h"
#include "fem/load_cases/pressure_range.h"
#include "fem/modes/vibration.h"
#include "io/text/number_text.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::fem {
namespace {

using meshes::LoadCaseKind;

/// A state from which paths continue.
struct Anchor {
  PathPoint point;
  BodyState state;
};

constexpr double vacuum_share = 0.98;  ///< part of the vacuum at which walls touch, so that they do not

class CaseRun {
 public:
  CaseRun(const CaseRequest& request, const StudyMaterial& material, const CaseOptions& options)
      : kind_(request.load_case.kind),
        request_(request),
        options_(options),
        body_(request.load_case, material, request.elements, options.communicator) {
    response_.elements = body_.element_count();
    response_.unknowns = body_.unknowns();
    response_.linear = body_.equilibrium().linear_choice().method;
  }

  CaseResponse run() {
    response_.pressures_Pa = request_.load_case.pressures_Pa;
    if (response_.pressures_Pa.empty()) find_pressures();
    if (!is_stopped()) from_rest();
    std::sort(response_.rows.begin(), response_.rows.end());
    return std::move(response_);
  }

 private:
  using Reached = std::function<void(double value, const Anchor& anchor)>;

  [[nodiscard]] bool is_stopped() const { return response_.status == io::RunStatus::stopped; }

  void find_pressures() {
    const PressureRange range = find_pressure_range(body_, request_.largest_pressure_Pa, options_.stop);
    response_.limit_pressure_Pa = range.limit_pressure_Pa;
    response_.contact_pressure_Pa = range.contact_pressure_Pa;
    response_.reason = range.reason;
    if (range.stopped) {
      response_.status = io::RunStatus::stopped;
      return;
    }
    const double lowest = vacuum_share * range.lowest_pressure_Pa;
    const double highest = range.limit_pressure_Pa ? safe_share * *range.limit_pressure_Pa : range.highest_pressure_Pa;
    response_.pressures_Pa = pressures_between(lowest, highest, request_.state_count);
  }

  void from_rest() {
    Anchor rest;
    const auto keep = [&](const PathPoint& point, const BodyState& state, const PathRestart&) { rest = {point, state}; };
    const PathReport report = follow_path(body_.equilibrium(), body_.at_rest(), {}, keep, options_.stop);
    if (report.status != io::RunStatus::completed) {
      end_early(report.status, report.reason, "at rest");
      return;
    }
    std::vector<double> up;
    std::vector<double> down;
    for (const double pressure_Pa : response_.pressures_Pa) {
      if (pressure_Pa > 0.0) up.push_back(pressure_Pa);
      if (pressure_Pa < 0.0) down.insert(down.begin(), pressure_Pa);
      if (pressure_Pa == 0.0) at_pressure(0.0, rest);
    }
    for (const std::vector<double>& targets : {up, down}) {
      const auto drives = [&](double last) {
        PathDrives leg = body_.at_rest();
        leg.plena.front().values = {0.0, last};
        return leg;
      };
      follow(rest, targets, drives, "pressure_Pa",
             [&](double pressure_Pa, const Anchor& anchor) { pressed_.emplace_back(pressure_Pa, anchor); });
      for (const auto& [pressure_Pa, anchor] : pressed_) at_pressure(pressure_Pa, anchor);
      pressed_.clear();
    }
  }

  /// Computes all states at a pressure.
  void at_pressure(double pressure_Pa, const Anchor& anchor) {
    if (is_stopped()) return;
    if (kind_ == LoadCaseKind::modes) {
      add_modes(pressure_Pa, anchor);
      return;
    }
    if (meshes::abscissa_count(kind_) == 1) {
      add_row({pressure_Pa}, anchor);
      return;
    }
    std::vector<double> up;
    std::vector<double> down;
    for (const double value : request_.load_case.imposed) {
      if (value > 0.0) up.push_back(value);
      if (value < 0.0) down.insert(down.begin(), value);
      if (value == 0.0) add_row({pressure_Pa, 0.0}, anchor);
    }
    for (const std::vector<double>& targets : {up, down}) {
      const auto drives = [&](double last) {
        PathDrives leg = body_.impose(last);
        leg.plena.front().values = {pressure_Pa};
        return leg;
      };
      follow(anchor, targets, drives, "pressure_Pa = " + io::number_text(pressure_Pa) + ", " + meshes::imposed_key(kind_),
             [&](double value, const Anchor& reached) {
               add_row({pressure_Pa, value}, reached);
             });
    }
  }

  /// Follows a path from a state through targets, which lie at increasing distance from zero on one side.
  template <class Drives>
  void follow(const Anchor& from, const std::vector<double>& targets, const Drives& drives, const std::string& what,
              const Reached& reached) {
    if (targets.empty() || is_stopped()) return;
    PathOptions path;
    for (const double target : targets) path.stations.push_back(target / targets.back());
    PathRestart start{.s = {0.0}, .states = {from.state}, .points = {from.point}, .next_step = path.first_step};
    start.points.front().s = 0.0;
    std::size_t next = 0;
    const auto keep = [&](const PathPoint& point, const BodyState& state, const PathRestart&) {
      if (next < targets.size() && std::abs(point.s - path.stations[next]) < 1e-12) reached(targets[next++], {point, state});
    };
    const PathReport report = follow_path(body_.equilibrium(), drives(targets.back()), path, keep, options_.stop, &start);
    if (report.status == io::RunStatus::completed || next == targets.size()) return;
    end_early(report.status, report.reason, what + " = " + io::number_text(targets[next]) + " was not reached");
  }

  void end_early(io::RunStatus status, const std::string& reason, const std::string& where) {
    if (response_.status == io::RunStatus::completed || status == io::RunStatus::stopped) response_.status = status;
    response_.reason += (response_.reason.empty() ? "" : "; ") + where + ": " + reason;
  }

  void add_row(std::vector<double> row, const Anchor& anchor) {
    const std::vector<double> ordinates = body_.ordinates(anchor.point, anchor.state);
    row.insert(row.end(), ordinates.begin(), ordinates.end());
    add(std::move(row), anchor);
  }

  void add_modes(double pressure_Pa, const Anchor& anchor) {
    constexpr std::size_t mode_count = 3;
    const VibrationReport report =
        vibrations(body_.equilibrium(), anchor.state, 0.0, {.mode_count = static_cast<int>(mode_count)});
    if (report.status != io::RunStatus::completed || report.frequencies_Hz.size() < mode_count) {
      const bool too_few = report.status == io::RunStatus::completed;
      end_early(too_few ? io::RunStatus::not_converged : report.status, too_few ? "too few modes were found" : report.reason,
                "pressure_Pa = " + io::number_text(pressure_Pa));
      return;
    }
    add({pressure_Pa, report.frequencies_Hz[0], report.frequencies_Hz[1], report.frequencies_Hz[2]}, anchor);
  }

  /// Returns the index of a row among the states that were asked for.
  [[nodiscard]] std::size_t place_of(const std::vector<double>& row) const {
    const auto place = [](const std::vector<double>& values, double value) {
      return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
    };
    const std::size_t pressure = place(response_.pressures_Pa, row[0]);
    if (meshes::abscissa_count(kind_) == 1) return pressure;
    return pressure * request_.load_case.imposed.size() + place(request_.load_case.imposed, row[1]);
  }

  void add(std::vector<double> row, const Anchor& anchor) {
    if (options_.observer) options_.observer(place_of(row), body_.equilibrium(), anchor.point, anchor.state);
    response_.rows.push_back(std::move(row));
    if (!options_.progress) return;
    const std::size_t inner = meshes::abscissa_count(kind_) == 1 ? 1 : request_.load_case.imposed.size();
    const auto total = static_cast<double>(response_.pressures_Pa.size() * inner);
    options_.progress(static_cast<double>(response_.rows.size()) / total,
                      std::to_string(response_.rows.size()) + " of " + std::to_string(static_cast<int>(total)) + " states");
  }

  LoadCaseKind kind_;
  const CaseRequest& request_;
  const CaseOptions& options_;
  LoadCaseBody body_;
  std::vector<std::pair<double, Anchor>> pressed_;
  CaseResponse response_;
};

}  // namespace

CaseResponse run_load_case(const CaseRequest& request, const StudyMaterial& material, const CaseOptions& options) {
  assert(!request.load_case.pressures_Pa.empty() || request.load_case.kind == LoadCaseKind::inflation);
  return CaseRun(request, material, options).run();
}

}  // namespace menger::fem
