#pragma once

#include "models/experiment/rig_config.h"
#include "rig/lines/line_splitter.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_clock.h"
#include "rig/lines/transport.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A thermometer beside the specimen: one that sends lines by itself, one that is queried (SCPI), or
// one whose lines come between those of the load cell. Sources: rig/protocols/temperature_text.h.
// It never ends a run: no call throws because of it. A problem is reported by an event
// "thermometer" and stays in trouble(). A reading that jumps is handed out only if the next one
// agrees with it, because text carries no checksum.
class Thermometer {
 public:
  // line: nothing if it could not be opened (trouble: why), or if the thermometer shares the port of
  // the load cell.
  Thermometer(std::unique_ptr<Transport> line, const std::string& trouble,
              const ThermometerConfig& config, const RigClock& clock, RecordSink sink);

  // Reads what has arrived and asks the next question if it is due. Call often.
  void service();
  // For a thermometer on the load cell's port: true if the line was one of its own.
  bool take_shared_line(const ReceivedLine& line);
  // For poll(); nullptr if it has no port of its own, or has lost it.
  const Transport* transport() const { return line_.get(); }

  bool is_shared() const { return config_.driver == "load-cell"; }
  std::string name() const { return name_; }
  const std::vector<double>& readings_C() const { return readings_C_; }
  std::optional<double> newest_C() const;
  double newest_s() const { return newest_s_; }  // rig time of the newest reading
  // Longest time without a reading, from the first service() to the last, rig time.
  double longest_silence_s() const { return longest_silence_s_; }
  // Why there are no readings, or none any more; empty if all is well.
  const std::string& trouble() const { return trouble_; }

 private:
  Chunk received();
  void ask_if_due(double now_s);
  void watch_silence(double now_s);
  void take_line(const ReceivedLine& line);
  void take_reading(double temperature_C, double time_s);
  void note_unreadable(const std::string& value, const std::string& text, double time_s);
  void hand_out(double temperature_C, double time_s);
  void note_trouble(const std::string& value, const std::string& text, double time_s);

  std::unique_ptr<Transport> line_;
  ThermometerConfig config_;
  const RigClock& clock_;
  RecordSink sink_;
  int baud_;
  std::string name_;
  std::string trouble_;
  LineSplitter splitter_;
  bool is_past_first_line_ = false;
  std::optional<double> asked_s_;
  std::optional<double> begun_s_;   // first service()
  std::optional<double> jumped_C_;  // a reading that the next one must confirm
  double jumped_s_ = 0.0;
  std::vector<double> readings_C_;
  double newest_s_ = 0.0;
  double longest_silence_s_ = 0.0;
  bool is_silent_ = false;
  std::size_t n_unreadable_ = 0;
};

// Throws RigError on an unknown driver or unit under [thermometer].
void check_thermometer_words(const ThermometerConfig& config);

}  // namespace viscard
