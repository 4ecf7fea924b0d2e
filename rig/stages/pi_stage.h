#pragma once

#include "rig/protocols/pi_protocol.h"
#include "rig/stages/asked_stage.h"

#include <optional>
#include <string>

namespace viscard {

// A stage behind a PI controller with GCS 2, such as C-863 or E-861 (rig/protocols/pi_protocol.h).
// rig/stages/README.md lists the rules that the driver relies on.
class PiStage final : public AskedStage {
 public:
  PiStage(Transport& transport, const StageConfig& config, const RigClock& clock, RecordSink sink);
  ~PiStage() override { restore_speed(); }

  std::vector<std::string> advice() const override;
  bool measures_position() const override { return true; }  // the servo is closed over an encoder

 private:
  std::string bytes_of(const std::string& words) const override;
  bool is_question(const std::string& words) const override;
  bool is_name(const std::string& line) const override { return is_pi_identity(line); }
  std::optional<std::string> answer_in(const std::string& question,
                                       const std::string& line) const override;
  std::string speed_words(double speed_mm_s) const override;
  std::string move_words(double target_mm) const override;
  std::string trouble_in(const std::string& answer) const override;
  void plan_round() override;
  void take_state(const std::string& question, const std::string& answer) override;
  void set_up(const Pump& pump) override;
  void set_free(const Pump& pump) override;

  std::string of_axis(const std::string& words) const;
  double parameter(const std::string& id, double otherwise, const Pump& pump);
  void read_dynamics(const Pump& pump);
  void switch_on(const Pump& pump);
  void home(const Pump& pump);

  std::string axis_;
  bool is_zero_declared_ = false;  // by POS instead of a reference move
};

}  // namespace viscard
