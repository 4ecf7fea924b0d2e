#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Writes and reads messages of the Thorlabs APT protocol; knows no port. Sources: "APT Controllers
// Host-Controller Communications Protocol" (Thorlabs); yaq-project/thorlabs-apt-protocol.
//   short  id u16, p1 u8, p2 u8, dest u8, source u8
//   long   id u16, length u16, dest|0x80, source u8, data
// Little-endian and without a checksum. The host is 0x01, a unit on USB 0x50; channel 1.
namespace apt {
inline constexpr std::uint16_t kDisconnect = 0x0002;  // the unit is about to vanish
inline constexpr std::uint16_t kAskInfo = 0x0005, kInfo = 0x0006;
inline constexpr std::uint16_t kStopUpdates = 0x0012, kNoFlashProgramming = 0x0018;
inline constexpr std::uint16_t kError = 0x0080, kErrorText = 0x0081;
inline constexpr std::uint16_t kEnable = 0x0210;
inline constexpr std::uint16_t kSetVelocity = 0x0413, kAskVelocity = 0x0414, kVelocity = 0x0415;
inline constexpr std::uint16_t kSetHome = 0x0440, kAskHome = 0x0441, kHome = 0x0442;
inline constexpr std::uint16_t kGoHome = 0x0443, kHomed = 0x0444;
inline constexpr std::uint16_t kMoveAbsolute = 0x0453, kMoveCompleted = 0x0464;
inline constexpr std::uint16_t kStop = 0x0465, kStopped = 0x0466;
inline constexpr std::uint16_t kAskStepperStatus = 0x0480, kStepperStatus = 0x0481;
inline constexpr std::uint16_t kAskServoStatus = 0x0490, kServoStatus = 0x0491;

inline constexpr std::uint8_t kAtOnce = 1, kWithRamp = 2;  // second parameter of kStop

// Status bits. Makers of software disagree on which of two limit bits is "forward".
inline constexpr std::uint32_t kAnyLimit = 0xf, kMoving = 0x2f0;  // also jogging and homing
inline constexpr std::uint32_t kIsHomed = 0x400, kIsEnabled = 0x80000000U;
inline constexpr std::uint32_t kMotionError = 0x4000, kOvercurrent = 0x04000000U;
inline constexpr std::uint32_t kAnyError = 0x40000000U | kMotionError | kOvercurrent;
}  // namespace apt

struct AptMessage {
  std::uint16_t id = 0;
  std::uint8_t p1 = 0, p2 = 0;  // of a short message
  std::string data;             // of a long one
  double time_s = 0.0;          // when its last byte was read
};

// The bytes of a message from the host to the unit, or back.
std::string format_apt(std::uint16_t id, std::uint8_t p1, std::uint8_t p2, bool is_to_host = false);
std::string format_apt(std::uint16_t id, std::string_view data, bool is_to_host = false);
std::string format_apt_move(std::int32_t counts);

// Cuts a byte stream into messages, however reads split it. Only what a motor unit sends counts as a
// message, with its length and with another one behind it if anything is, so that after lost bytes
// the stream comes into step again.
class AptSplitter {
 public:
  // A message whose rest is missing for longer than patience_s is dropped.
  void feed(std::string_view bytes, double time_s, double patience_s);
  std::optional<AptMessage> next();
  std::size_t n_skipped() const { return n_skipped_; }  // bytes that belong to no message

 private:
  std::string buffer_;
  std::deque<AptMessage> messages_;
  double fed_s_ = 0.0;
  std::size_t n_skipped_ = 0;
};

struct AptInfo {
  std::string model;  // "KDC101"
  std::uint32_t serial = 0;
  std::string firmware;  // "2.1.5"
};
std::optional<AptInfo> parse_apt_info(const AptMessage& message);

struct AptStatus {
  std::int32_t position = 0;  // counts
  std::uint32_t bits = 0;
};
// Of a servo or a stepper, of channel 1.
std::optional<AptStatus> parse_apt_status(const AptMessage& message);

struct AptVelocity {
  std::int32_t acceleration = 0, speed = 0;  // words, see AptUnits
  bool operator==(const AptVelocity&) const = default;
};
std::optional<AptVelocity> parse_apt_velocity(const AptMessage& message);
std::string format_apt_velocity(const AptVelocity& velocity);

// kErrorText: the number and the words of an error.
std::optional<std::string> parse_apt_error(const AptMessage& message);

// Little-endian numbers within a message; at + 4 (or 2) <= data.size().
std::int32_t apt_i32(std::string_view data, std::size_t at);
std::uint16_t apt_u16(std::string_view data, std::size_t at);
std::string apt_bytes(std::uint32_t value, int n_bytes);

// Words for speeds and accelerations, by the model's name.
struct AptUnits {
  bool is_stepper = false;
  double speed_word = 1.0;         // words per count/s
  double acceleration_word = 1.0;  // words per count/s^2
};
std::optional<AptUnits> apt_units(std::string_view model);
// "KDC, TDC, KST, TST, LTS".
std::string apt_models();

// What the error bits of a status mean and what to do about it.
std::string apt_error_text(std::uint32_t bits);

}  // namespace viscard
