#include "models/pillar/time/transient_stops.h"

#include <algorithm>
#include <cmath>

namespace viscard {

double factor_at(const TransientRequest& r, double time_s, bool after) {
  const auto& t = r.corner_time_s;
  const auto next = after ? std::upper_bound(t.begin(), t.end(), time_s)
                          : std::lower_bound(t.begin(), t.end(), time_s);
  if (next == t.begin()) return after || t.front() > time_s ? 0.0 : r.corner_value.front();
  const auto i = static_cast<std::size_t>(next - t.begin());
  if (next == t.end()) return r.corner_value.back();
  const double share = (time_s - t[i - 1]) / (t[i] - t[i - 1]);
  return r.corner_value[i - 1] + share * (r.corner_value[i] - r.corner_value[i - 1]);
}

std::vector<TransientStop> stops_of(const TransientRequest& r) {
  const double spacing_s = r.end_s / r.outputs;
  std::vector<TransientStop> stops;
  for (int i = 1; i <= r.outputs; ++i) stops.push_back({spacing_s * i, true});
  for (const double corner_s : r.corner_time_s) {
    const double nearest_s = spacing_s * std::round(corner_s / spacing_s);
    const bool is_new = corner_s > 0.0 && corner_s < r.end_s;
    if (is_new && std::abs(corner_s - nearest_s) > 1e-9 * spacing_s) {
      stops.push_back({corner_s, false});
    }
  }
  std::sort(stops.begin(), stops.end(),
            [](const TransientStop& a, const TransientStop& b) { return a.time_s < b.time_s; });
  return stops;
}

std::vector<TransientPiece> pieces_of(const TransientRequest& r) {
  const double spacing_s = r.end_s / r.outputs;
  std::vector<TransientPiece> pieces;
  double at_s = 0.0;
  for (const TransientStop& stop : stops_of(r)) {
    double length_s = stop.time_s - at_s;
    if (length_s <= 0.0) continue;  // a jump between outputs appears twice
    if (std::abs(length_s - spacing_s) <= 1e-9 * spacing_s) length_s = spacing_s;
    pieces.push_back({length_s, factor_at(r, at_s * (1.0 + 1e-12), true),
                      factor_at(r, stop.time_s * (1.0 - 1e-12), false), stop.is_output});
    at_s = stop.time_s;
  }
  return pieces;
}

}  // namespace viscard
