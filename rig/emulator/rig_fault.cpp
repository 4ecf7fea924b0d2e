#include "rig/emulator/rig_fault.h"

#include "models/maths/leading_number.h"
#include "models/maths/text_of_number.h"

#include <array>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr std::array<std::pair<RigFaultKind, const char*>, 19> kFaults{
    {{RigFaultKind::kFrozen, "frozen"},
     {RigFaultKind::kZeros, "zeros"},
     {RigFaultKind::kOpenWire, "open-wire"},
     {RigFaultKind::kDriftingWire, "drifting-wire"},
     {RigFaultKind::kNoExcitation, "no-excitation"},
     {RigFaultKind::kHalfGain, "half-gain"},
     {RigFaultKind::kFiltered, "filtered"},
     {RigFaultKind::kSaturation, "saturation"},
     {RigFaultKind::kFastReadings, "fast-readings"},
     {RigFaultKind::kSlowReadings, "slow-readings"},
     {RigFaultKind::kDeadMotor, "dead-motor"},
     {RigFaultKind::kLostSteps, "lost-steps"},
     {RigFaultKind::kDirectionStuck, "direction-stuck"},
     {RigFaultKind::kSinks, "sinks"},
     {RigFaultKind::kPlay, "play"},
     {RigFaultKind::kStageStall, "stage-stall"},
     {RigFaultKind::kLoadCellPort, "load-cell-port"},
     {RigFaultKind::kStagePort, "stage-port"},
     {RigFaultKind::kStagePortBack, "stage-port-back"}}};

}  // namespace

std::vector<std::string> rig_fault_names() {
  std::vector<std::string> names;
  for (const auto& [kind, name] : kFaults) names.emplace_back(name);
  return names;
}

std::string name_of(RigFaultKind kind) {
  for (const auto& [known, name] : kFaults) {
    if (known == kind) return name;
  }
  return "none";
}

RigFault rig_fault_from_text(const std::string& text) {
  const std::size_t at = text.find('@');
  const std::string word = text.substr(0, at);
  RigFault fault;
  for (const auto& [kind, name] : kFaults) {
    if (word == name) fault.kind = kind;
  }
  if (fault.kind == RigFaultKind::kNone) {
    std::string known;
    for (const auto& [kind, name] : kFaults)
      known += (known.empty() ? "" : ", ") + std::string(name);
    throw std::invalid_argument("fault '" + word + "' is unknown; known are " + known);
  }
  if (at == std::string::npos) return fault;
  fault.phase = text.substr(at + 1);
  const std::size_t plus = fault.phase.find('+');
  if (plus != std::string::npos) {
    const auto after = number_from_text(fault.phase.substr(plus + 1));
    if (!after || !(*after >= 0.0)) {
      throw std::invalid_argument("fault '" + text +
                                  "': after + stands a number of seconds, such as hold+0.5");
    }
    fault.after_s = *after;
    fault.phase.resize(plus);
  }
  if (fault.phase.empty()) {
    throw std::invalid_argument("fault '" + text +
                                "': after @ stands a phase, such as frozen@hold");
  }
  return fault;
}

}  // namespace viscard
