// Any line or bytes from a stage other than GRBL, a multimeter or a force gauge is understood or
// refused.
#include "rig/protocols/apt_protocol.h"
#include "rig/protocols/gauge_protocols.h"
#include "rig/protocols/marlin_protocol.h"
#include "rig/protocols/pi_protocol.h"
#include "rig/protocols/smc_protocol.h"
#include "rig/protocols/zaber_protocol.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

namespace {

void check(const std::optional<viscard::GaugeAnswer>& answer) {
  if (!answer) return;
  for (const auto& value : {answer->volts, answer->force_N}) {
    if (value && !std::isfinite(*value)) std::abort();
  }
}

// However reads split them, no byte is in two messages.
void check_apt(std::string_view bytes, std::size_t read_size) {
  viscard::AptSplitter splitter;
  for (std::size_t at = 0; at < bytes.size(); at += read_size) {
    splitter.feed(bytes.substr(at, read_size), 0.0, 1.0);
  }
  std::size_t n_used = splitter.n_skipped();
  while (const auto message = splitter.next()) {
    constexpr std::size_t kHeader = 6;
    n_used += kHeader + message->data.size();
    (void)viscard::parse_apt_info(*message);
    (void)viscard::parse_apt_status(*message);
    (void)viscard::parse_apt_velocity(*message);
    (void)viscard::parse_apt_error(*message);
  }
  if (n_used > bytes.size()) std::abort();
}

void check_marlin(std::string_view line) {
  if (viscard::parse_marlin_resend(line).value_or(0) < 0) std::abort();
  (void)viscard::parse_marlin_count(line, 'Z');
  (void)viscard::parse_marlin_error(line);
  (void)viscard::parse_marlin_echo(line);
  (void)viscard::parse_marlin_firmware(line);
  std::map<std::string, double> settings;
  viscard::add_marlin_settings(line, settings);
  for (const auto& [name, value] : settings) {
    if (!std::isfinite(value)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check(viscard::parse_scpi_reading(text));
  check(viscard::parse_mark10_reading(text, "N"));
  check(viscard::parse_sauter_reading(text, "N"));
  (void)viscard::parse_scpi_error(text);
  check_apt(text, 1);
  check_apt(text, 64);
  check_marlin(text);
  const auto message = viscard::parse_zaber_message(text);
  if (message && (message->device < 0 || message->axis < 0)) std::abort();
  const auto answer = viscard::pi_answer_text(text, 3);
  if (answer) (void)viscard::pi_value_of_axis(*answer, 1);
  (void)viscard::parse_pi_moving(text, 32);
  (void)viscard::parse_pi_ready(text);
  const auto error = viscard::parse_pi_error(text);
  if (error && viscard::pi_error_text(*error).empty()) std::abort();
  const auto value = viscard::smc_answer_text(text, 1, "TS");
  const auto state = viscard::parse_smc_state(value ? *value : text);
  if (state && viscard::is_smc_ready(*state) && viscard::is_smc_moving(*state)) std::abort();
  if (state) (void)viscard::smc_fault_text(state->faults);
  (void)viscard::smc_error_text(text);
  return 0;
}
