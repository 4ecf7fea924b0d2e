#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace viscard {

// Binary frames of fixed length that a converter's board sends, described by the rig file. No maker
// has a standard for them: every published sketch has its own. A description lists the fields in
// their order, separated by blanks:
//   a5            a byte that is always the same, in hexadecimal; the first field must be one
//   counts:i24be  the converter's code: i16, i24 or i32, big-endian (be) or little-endian (le)
//   seq:u8        number of the frame: u8, u16le, u32be ...
//   micros:u32le  the processor's clock; or millis
//   skip:3        three bytes of no interest (other channels, status)
//   check:crc16   over all bytes before it: sum8, xor8, crc8 (polynomial 0x07), crc16 (CCITT-FALSE:
//                 polynomial 0x1021, start 0xFFFF, high byte first), crc16-modbus (low byte first)
// Examples: "a5 5a seq:u8 micros:u32le counts:i24be check:crc16"; OpenBCI Cyton (docs.openbci.com,
// "Cyton Data Format"): "a0 seq:u8 counts:i24be skip:27 c0"; ProtoCentral OpenView packets
// (github.com/Protocentral, examples of the ADS1292R): "0a fa skip:2 02 skip:2 counts:i32le skip:1 00
// 0b".
class FrameFormat {
 public:
  // Throws std::invalid_argument naming the field that is wrong.
  explicit FrameFormat(const std::string& description);

  struct Frame {
    double counts = 0.0;
    std::optional<std::uint32_t> seq;
    std::optional<double> ticks;  // of the processor's clock
  };

  std::size_t size() const { return size_; }
  // Duration of one tick of the clock; 0 without a clock.
  double tick_s() const { return tick_s_; }
  // The number of frames from one seq to another, modulo its range; 1 for the next one.
  std::uint32_t seq_step(std::uint32_t from, std::uint32_t to) const;
  bool has_check() const { return has_check_; }
  // Nothing unless all constant bytes and the check are right. bytes has size() bytes.
  std::optional<Frame> parse(std::string_view bytes) const;
  // The bytes of a frame; what it does not have is 0.
  std::string bytes_of(const Frame& frame) const;
  // The largest and smallest code: the ends of the converter's range.
  double highest() const;
  double lowest() const;

 private:
  enum class Kind { kConstant, kCounts, kSeq, kClock, kSkip, kCheck };
  enum class Check { kSum8, kXor8, kCrc8, kCrc16, kModbus };
  struct Field {
    Kind kind = Kind::kSkip;
    std::size_t size = 1;
    bool is_little = false;
    std::uint8_t constant = 0;
    Check check = Check::kSum8;
    double tick_s = 0.0;  // of a clock
  };
  static Field field_from(const std::string& word);
  static Field check_field(const std::string& type, const std::string& word);
  static Field number_field(Kind kind, const std::string& type, const std::string& word);
  void check_fields() const;
  static std::uint32_t check_of(std::string_view bytes, Check check);

  std::vector<Field> fields_;
  std::size_t size_ = 0;
  double tick_s_ = 0.0;
  unsigned seq_bits_ = 0;
  unsigned count_bits_ = 24;
  bool has_check_ = false;
};

struct ReceivedFrame {
  FrameFormat::Frame frame;
  double time_s = 0.0;  // latest rig time at which its last byte can have arrived; ascending
  std::string skipped;  // bytes before it that belong to no frame
};

// Finds frames in a stream of bytes. Without a check a frame counts only if another one follows it
// directly, until the stream is in step.
class FrameSplitter {
 public:
  explicit FrameSplitter(FrameFormat format) : format_(std::move(format)) {}

  // As LineSplitter::feed().
  void feed(std::string_view bytes, double time_s, double byte_s);
  std::optional<ReceivedFrame> next();
  std::size_t n_bytes() const { return n_bytes_; }
  // The newest bytes that belong to no frame.
  const std::string& skipped() const { return skipped_; }

 private:
  struct Arrival {
    std::size_t n_bytes;  // of the stream up to and with this read
    double time_s, byte_s;
  };
  double arrival_s(std::size_t n_bytes);

  FrameFormat format_;
  std::string buffer_;
  std::string skipped_;
  std::deque<Arrival> arrivals_;
  std::size_t n_bytes_ = 0;  // received
  bool is_in_step_ = false;
  double last_s_ = -1e300;
};

}  // namespace viscard
