#include "rig/protocols/apt_protocol.h"

#include <algorithm>
#include <array>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kHeader = 6;
constexpr unsigned char kHost = 0x01, kUnit = 0x50, kHasData = 0x80;

// What a unit sends, and with how many bytes of data. Events come with or without a status.
struct Kind {
  std::uint16_t id;
  std::size_t n_data;
};
constexpr std::array<Kind, 15> kKinds{{{apt::kDisconnect, 0},
                                       {apt::kInfo, 84},
                                       {apt::kError, 0},
                                       {apt::kErrorText, 68},
                                       {apt::kVelocity, 14},
                                       {apt::kHome, 14},
                                       {apt::kHomed, 0},
                                       {apt::kMoveCompleted, 0},
                                       {apt::kMoveCompleted, 14},
                                       {apt::kStopped, 0},
                                       {apt::kStopped, 14},
                                       {apt::kStepperStatus, 14},
                                       {apt::kServoStatus, 14},
                                       {0x0212, 0},
                                       {0x0412, 6}}};

unsigned byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

// The number of data bytes if a message of a unit begins here. Precondition: a whole header.
std::optional<std::size_t> data_size(std::string_view text) {
  const bool has_data = byte_at(text, 4) == (kHost | kHasData);
  if ((!has_data && byte_at(text, 4) != kHost) || byte_at(text, 5) != kUnit) return std::nullopt;
  const std::size_t n_data = has_data ? apt_u16(text, 2) : 0;
  for (const Kind& kind : kKinds) {
    if (kind.id == apt_u16(text, 0) && kind.n_data == n_data) return n_data;
  }
  return std::nullopt;
}

// False if no message of a unit begins with these bytes, or the first of them.
bool may_begin(std::string_view text) {
  if (text.size() >= kHeader) return data_size(text).has_value();
  const std::size_t n = std::min<std::size_t>(text.size(), 2);
  return std::any_of(kKinds.begin(), kKinds.end(), [&](const Kind& kind) {
    return apt_bytes(kind.id, 2).substr(0, n) == text.substr(0, n);
  });
}

// Text up to the first NUL.
std::string text_of(std::string_view bytes) {
  return std::string(bytes.substr(0, bytes.find('\0')));
}

struct Model {
  std::string_view prefix;
  AptUnits units;
};
// Brushed servos work in periods of 2048/6 MHz; steppers since the KST101 in 53.68 words per
// microstep/s and periods of 204.94 us, older ones in microsteps (the maker's protocol, "Positions,
// velocities and accelerations"; pyLabLib, devices/Thorlabs/kinesis.py).
constexpr double kServo_s = 2048.0 / 6e6;
constexpr AptUnits kServo{false, kServo_s * 65536.0, kServo_s* kServo_s * 65536.0};
constexpr AptUnits kStepper{true, 53.68, 53.68 * 204.94e-6};
constexpr std::array<Model, 5> kModels{{{"KDC", kServo},
                                        {"TDC", kServo},
                                        {"KST", kStepper},
                                        {"TST", {true, 1.0, 1.0}},
                                        {"LTS", kStepper}}};

}  // namespace

std::int32_t apt_i32(std::string_view data, std::size_t at) {
  return static_cast<std::int32_t>(byte_at(data, at) | byte_at(data, at + 1) << 8 |
                                   byte_at(data, at + 2) << 16 | byte_at(data, at + 3) << 24);
}

std::uint16_t apt_u16(std::string_view data, std::size_t at) {
  return static_cast<std::uint16_t>(byte_at(data, at) | byte_at(data, at + 1) << 8);
}

std::string apt_bytes(std::uint32_t value, int n_bytes) {
  std::string bytes;
  for (int i = 0; i < n_bytes; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xffU);
  return bytes;
}

std::string format_apt(std::uint16_t id, std::uint8_t p1, std::uint8_t p2, bool is_to_host) {
  return apt_bytes(id, 2) + apt_bytes(p1, 1) + apt_bytes(p2, 1) +
         apt_bytes(is_to_host ? kHost : kUnit, 1) + apt_bytes(is_to_host ? kUnit : kHost, 1);
}

std::string format_apt(std::uint16_t id, std::string_view data, bool is_to_host) {
  return apt_bytes(id, 2) + apt_bytes(static_cast<std::uint32_t>(data.size()), 2) +
         apt_bytes((is_to_host ? kHost : kUnit) | kHasData, 1) +
         apt_bytes(is_to_host ? kUnit : kHost, 1) + std::string(data);
}

std::string format_apt_move(std::int32_t counts) {
  return format_apt(apt::kMoveAbsolute,
                    apt_bytes(1, 2) + apt_bytes(static_cast<std::uint32_t>(counts), 4));
}

std::string format_apt_velocity(const AptVelocity& velocity) {
  return format_apt(apt::kSetVelocity,
                    apt_bytes(1, 2) + apt_bytes(0, 4) +
                        apt_bytes(static_cast<std::uint32_t>(velocity.acceleration), 4) +
                        apt_bytes(static_cast<std::uint32_t>(velocity.speed), 4));
}

void AptSplitter::feed(std::string_view bytes, double time_s, double patience_s) {
  if (!buffer_.empty() && time_s - fed_s_ > patience_s) {
    n_skipped_ += buffer_.size();
    buffer_.clear();
  }
  fed_s_ = time_s;
  buffer_ += bytes;
  std::size_t at = 0;
  while (buffer_.size() - at >= kHeader) {
    const std::string_view rest = std::string_view(buffer_).substr(at);
    const auto n_data = data_size(rest);
    if (n_data && rest.size() < kHeader + *n_data) break;
    if (!n_data || !may_begin(rest.substr(kHeader + *n_data))) {
      ++at;
      ++n_skipped_;
      continue;
    }
    AptMessage message{apt_u16(rest, 0), 0, 0, std::string(rest.substr(kHeader, *n_data)), time_s};
    if (*n_data == 0) {
      message.p1 = static_cast<std::uint8_t>(byte_at(rest, 2));
      message.p2 = static_cast<std::uint8_t>(byte_at(rest, 3));
    }
    messages_.push_back(std::move(message));
    at += kHeader + *n_data;
  }
  buffer_.erase(0, at);
}

std::optional<AptMessage> AptSplitter::next() {
  if (messages_.empty()) return std::nullopt;
  AptMessage message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

std::optional<AptInfo> parse_apt_info(const AptMessage& message) {
  if (message.id != apt::kInfo || message.data.size() != 84) return std::nullopt;
  const std::string_view data = message.data;
  // Offsets in the data; the maker counts from the header.
  return AptInfo{text_of(data.substr(4, 8)), static_cast<std::uint32_t>(apt_i32(data, 0)),
                 std::to_string(byte_at(data, 16)) + "." + std::to_string(byte_at(data, 15)) + "." +
                     std::to_string(byte_at(data, 14))};
}

std::optional<AptStatus> parse_apt_status(const AptMessage& message) {
  const bool is_status = message.id == apt::kServoStatus || message.id == apt::kStepperStatus;
  if (!is_status || message.data.size() != 14 || apt_u16(message.data, 0) != 1) return std::nullopt;
  return AptStatus{apt_i32(message.data, 2), static_cast<std::uint32_t>(apt_i32(message.data, 10))};
}

std::optional<AptVelocity> parse_apt_velocity(const AptMessage& message) {
  const bool is_velocity = message.id == apt::kVelocity && message.data.size() == 14;
  if (!is_velocity || apt_u16(message.data, 0) != 1) return std::nullopt;
  return AptVelocity{apt_i32(message.data, 6), apt_i32(message.data, 10)};
}

std::optional<std::string> parse_apt_error(const AptMessage& message) {
  if (message.id != apt::kErrorText || message.data.size() != 68) return std::nullopt;
  return std::to_string(apt_u16(message.data, 2)) + " " + text_of(message.data.substr(4));
}

std::optional<AptUnits> apt_units(std::string_view model) {
  for (const Model& one : kModels) {
    if (model.substr(0, one.prefix.size()) == one.prefix) return one.units;
  }
  return std::nullopt;
}

std::string apt_models() {
  std::string names;
  for (const Model& one : kModels) names += (names.empty() ? "" : ", ") + std::string(one.prefix);
  return names;
}

std::string apt_error_text(std::uint32_t bits) {
  if ((bits & apt::kMotionError) != 0) {
    return "a motion error (it does not follow its course; look for an obstacle, and switch it off "
           "and on)";
  }
  if ((bits & apt::kOvercurrent) != 0) return "overcurrent (look for an obstacle)";
  return "an error (its display may name it; switch it off and on)";
}

}  // namespace viscard
