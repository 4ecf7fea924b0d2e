#include "io/basics/timestamp.h"
#include "io/flow/calibrate.h"
#include "io/tables/column_map.h"
#include "models/experiment/calibration_check.h"
#include "models/maths/result_visitor.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {

BlockPoints block_points_from_table(const CsvTable& table) {
  return {column_SI(table, "position_m"), column_SI(table, "force_N"), {}};
}

double gain_relative_u(const BlockPoints& points, const RigConfig* rig) {
  if (rig == nullptr || points.force_N.empty()) return 0.0;
  return gain_relative_u(rig->calibration,
                         *std::max_element(points.force_N.begin(), points.force_N.end()));
}

FrameCalibration calibrated_frame(const BlockPoints& points, double relative_u_of_gain,
                                  const CalibrationRequest& request) {
  FrameCalibration out{fit_frame_stiffness(points, relative_u_of_gain), {}};
  const std::string id = request.id.empty() ? "frame " + today() : request.id;
  const FrameConfig frame{out.fit.stiffness_N_m, out.fit.relative_u, id, today(), {}};
  if (const std::string fault = frame_fault(frame); !fault.empty())
    throw std::runtime_error(request.where + fault + ". Nothing was written");
  out.record.frame = frame;
  return out;
}

void show_keys(ResultVisitor& v, const FrameCalibration& frame, const std::string& file) {
  const FrameStiffnessFit& fit = frame.fit;
  const FrameConfig record = frame.record.frame.value_or(FrameConfig{});
  v("file", file, "the record that was written; empty: none");
  v("id", record.id, "name of the record");
  v("date", record.date, "day of the measurement");
  v("stiffness_N_m", fit.stiffness_N_m, "of the frame");
  v("stiffness_relative_u", fit.relative_u, "relative standard uncertainty");
  v("stiffness_interval_95", Interval{fit.low_N_m, fit.high_N_m},
    "95 % interval in N/m, [low, high]");
  v("curvature_m", fit.curvature_m, "largest deviation from a straight line");
  v("seating_m", fit.seating_m, "depth by which the block settled at first; left out of the fit");
  v("n_points", fit.n_points, "points of the line");
}

}  // namespace viscard
