#pragma once

#include "rig/protocols/smc_protocol.h"
#include "rig/stages/asked_stage.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A stage behind a Newport SMC100CC or SMC100PP (rig/protocols/smc_protocol.h).
// rig/stages/README.md lists the rules that the driver relies on.
class SmcStage final : public AskedStage {
 public:
  SmcStage(Transport& transport, const StageConfig& config, const RigClock& clock, RecordSink sink);
  ~SmcStage() override { restore_speed(); }

  std::vector<std::string> advice() const override;
  bool measures_position() const override { return has_encoder_; }

 private:
  void split(const Chunk& chunk) override;
  bool may_write() override;
  std::string bytes_of(const std::string& words) const override;
  bool is_question(const std::string& words) const override;
  bool is_name(const std::string& line) const override;
  std::optional<std::string> answer_in(const std::string& question,
                                       const std::string& line) const override;
  std::string speed_words(double speed_mm_s) const override;
  std::string move_words(double target_mm) const override;
  std::string trouble_in(const std::string& answer) const override;
  void plan_round() override;
  void take_state(const std::string& question, const std::string& answer) override;
  void set_up(const Pump& pump) override;
  void set_free(const Pump& pump) override;

  SmcState state(const Pump& pump);
  void home(const Pump& pump);
  void switch_on(const Pump& pump);
  void read_dynamics(const Pump& pump);

  std::optional<double> held_since_s_;  // the controller has sent XOFF
  bool has_encoder_ = false;
  double jerk_time_s_ = 0.0;
};

}  // namespace viscard
