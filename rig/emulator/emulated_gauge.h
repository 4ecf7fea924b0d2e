#pragma once

#include "models/experiment/calibration.h"
#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/emulated_cell.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

namespace viscard {

// Habits of real instruments that a driver must live with. Times on the emulated clock.
struct GaugeHabits {
  int lose_answer_every = 0;  // every n-th question gets no answer
  int late_answer_every = 0;  // every n-th answer comes late_s late
  double late_s = 0.0;
  bool echoes = false;         // sends back what it hears
  bool hides_unit = false;     // Mark-10: unit switched off in its menu
  std::string unit = "N";      // Mark-10, Sauter
  int changes_unit_after = 0;  // Mark-10: somebody presses its button after so many readings
  bool refuses_setup = false;  // SCPI: an error waits in its queue
};

// A multimeter behind the amplifier, or a force gauge, that answers when asked
// (rig/scpi_protocol.h, rig/force_gauge_protocols.h). A reading takes 1/sample_rate of the truth.
class EmulatedGauge {
 public:
  // driver: "scpi", "mark10", "sauter".
  EmulatedGauge(const EmulatedTruth& truth, const LoadCellCalibration& calibration,
                std::string driver, const GaugeHabits& habits);

  void receive(std::string_view bytes, double time_s);
  // Time at which the next reading is made; infinity if none was asked for.
  double next_sample_s() const;
  // Makes it with the force acting then.
  void convert(double force_N, bool is_cell_broken);
  std::string take_output(double time_s);

 private:
  struct Answer {
    double due_s;
    std::string text;
  };
  void take_command(const std::string& command, double time_s);
  std::string text_of(double reading_N, bool is_overload) const;

  EmulatedTruth truth_;
  EmulatedCell cell_;
  LoadCellCalibration calibration_;
  std::string driver_;
  GaugeHabits habits_;
  std::string begun_;
  std::deque<double> due_s_;
  std::deque<Answer> answers_;
  std::int64_t n_readings_ = 0;
};

}  // namespace viscard
