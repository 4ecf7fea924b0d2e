#include "io/flow/table_from_capture.h"

#include "fit/indentation_from_capture.h"
#include "fit/run_timing.h"
#include "io/capture/capture_export.h"

#include <algorithm>
#include <cstddef>

namespace viscard {

std::string table_from_capture(const CapturedRun& run) {
  return csv_from_capture(run, timing_from_capture(run));
}

ContactCurve contact_curve(const CapturedRun& run) {
  constexpr double kShare = 0.004;
  const IndentationData data = indentation_from_capture(run);
  ContactCurve curve;
  curve.contact_s = data.contact_from_s;
  std::size_t first = 0;
  for (; first < data.time_s.size() && data.time_s[first] < data.contact_from_s; ++first) {
    curve.zero_N += data.force_N[first];
  }
  if (first > 0) curve.zero_N /= static_cast<double>(first);
  std::size_t next_move = 0;
  for (std::size_t begin = first; begin < data.time_s.size();) {
    const double from_s = data.time_s[begin];
    if (from_s > data.contact_to_s) break;
    while (next_move < data.moves.size() && data.moves[next_move].start_time_s <= from_s) {
      ++next_move;
    }
    const double last_s =
        next_move == 0 ? data.contact_from_s : data.moves[next_move - 1].start_time_s;
    const double next_s =
        next_move < data.moves.size() ? data.moves[next_move].start_time_s : data.contact_to_s;
    const double to_s = std::min(from_s + kShare * (from_s - last_s), next_s);
    double time_s = 0.0, force_N = 0.0;
    std::size_t end = begin;
    do {
      time_s += data.time_s[end] - data.contact_from_s;
      force_N += data.force_N[end] - curve.zero_N;
    } while (++end < data.time_s.size() && data.time_s[end] < to_s);
    const auto count = static_cast<double>(end - begin);
    curve.time_s.push_back(time_s / count);
    curve.force_N.push_back(force_N / count);
    begin = end;
  }
  return curve;
}

}  // namespace viscard
