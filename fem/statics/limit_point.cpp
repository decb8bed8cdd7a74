#include "fem/statics/limit_point.h"

#include <cmath>

namespace menger::fem {

namespace {

/// p = p0 + slope (V - V0) + curvature (V - V0)^2 through three points, V0 being the last.
struct Parabola {
  double volume;
  double pressure;
  double slope;
  double curvature;
};

std::optional<Parabola> parabola_through(const PathPoint& first, const PathPoint& second, const PathPoint& third,
                                         std::size_t plenum) {
  const double v1 = first.plenum_volumes_m3[plenum] - third.plenum_volumes_m3[plenum];
  const double v2 = second.plenum_volumes_m3[plenum] - third.plenum_volumes_m3[plenum];
  const double p1 = first.pressures_Pa[plenum] - third.pressures_Pa[plenum];
  const double p2 = second.pressures_Pa[plenum] - third.pressures_Pa[plenum];
  if (v1 == 0.0 || v2 == 0.0 || v1 == v2) return std::nullopt;
  const double curvature = (p1 / v1 - p2 / v2) / (v1 - v2);
  return Parabola{third.plenum_volumes_m3[plenum], third.pressures_Pa[plenum], p2 / v2 - curvature * v2, curvature};
}

LimitPoint top_of(const Parabola& parabola, std::size_t plenum, bool passed) {
  const double distance = -0.5 * parabola.slope / parabola.curvature;
  return {plenum, parabola.pressure + 0.5 * parabola.slope * distance, parabola.volume + distance, passed};
}

}  // namespace

std::optional<LimitPoint> pressure_extremum(const PathPoint& first, const PathPoint& second, const PathPoint& third,
                                            std::size_t plenum) {
  const double before = second.pressures_Pa[plenum] - first.pressures_Pa[plenum];
  const double after = third.pressures_Pa[plenum] - second.pressures_Pa[plenum];
  const double volume_before = second.plenum_volumes_m3[plenum] - first.plenum_volumes_m3[plenum];
  const double volume_after = third.plenum_volumes_m3[plenum] - second.plenum_volumes_m3[plenum];
  if (!(before * after < 0.0) || !(volume_before * volume_after > 0.0)) return std::nullopt;  // the drive itself may turn back
  const auto parabola = parabola_through(first, second, third, plenum);
  if (!parabola) return std::nullopt;
  return top_of(*parabola, plenum, true);
}

std::optional<LimitPoint> extrapolated_limit(const PathPoint& first, const PathPoint& second, const PathPoint& third,
                                             std::size_t plenum) {
  const auto parabola = parabola_through(first, second, third, plenum);
  if (!parabola || parabola->curvature == 0.0) return std::nullopt;
  const LimitPoint top = top_of(*parabola, plenum, false);
  const double last_step = third.pressures_Pa[plenum] - second.pressures_Pa[plenum];
  const double ahead = top.pressure_Pa - third.pressures_Pa[plenum];
  const double last_growth = third.plenum_volumes_m3[plenum] - second.plenum_volumes_m3[plenum];
  if (last_growth * (top.volume_m3 - third.plenum_volumes_m3[plenum]) < 0.0) return std::nullopt;
  if (last_step * ahead < 0.0 || std::abs(ahead) > 5.0 * std::abs(last_step)) return std::nullopt;
  return top;
}

}  // namespace menger::fem
