// Any line or bytes from a Zaber or APT stage, a multimeter or a force gauge is understood or refused.
#include "rig/protocols/apt_protocol.h"
#include "rig/protocols/gauge_protocols.h"
#include "rig/protocols/zaber_protocol.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

void check(const std::optional<viscard::GaugeAnswer>& answer) {
  if (!answer) return;
  for (const auto& value : {answer->volts, answer->force_N}) {
    if (value && !std::isfinite(*value)) std::abort();
  }
}

// However reads split them, the same bytes hold the same messages.
void check_apt(std::string_view bytes) {
  viscard::AptSplitter whole, split;
  whole.feed(bytes, 0.0, 1.0);
  for (const char c : bytes) split.feed(std::string_view(&c, 1), 0.0, 1.0);
  while (const auto message = whole.next()) {
    const auto same = split.next();
    if (!same || same->id != message->id || same->data != message->data) std::abort();
    (void)viscard::parse_apt_info(*message);
    (void)viscard::parse_apt_status(*message);
    (void)viscard::parse_apt_velocity(*message);
    (void)viscard::parse_apt_error(*message);
  }
  if (split.next()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check(viscard::parse_scpi_reading(text));
  check(viscard::parse_mark10_reading(text, "N"));
  check(viscard::parse_sauter_reading(text, "N"));
  (void)viscard::parse_scpi_error(text);
  check_apt(text);
  const auto message = viscard::parse_zaber_message(text);
  if (message && (message->device < 0 || message->axis < 0)) std::abort();
  return 0;
}
