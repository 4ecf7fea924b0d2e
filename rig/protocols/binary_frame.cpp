#include "rig/protocols/binary_frame.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kLongestFrame = 256;
constexpr std::size_t kMostSkipped = 256;  // bytes that are kept of what belongs to no frame

[[noreturn]] void refuse_field(const std::string& word, const std::string& expected) {
  throw std::invalid_argument("'" + word +
                              "' in frame under [load_cell] of the rig file: " + expected);
}

bool is_hex_byte(const std::string& word) {
  return word.size() == 2 && std::isxdigit(static_cast<unsigned char>(word[0])) != 0 &&
         std::isxdigit(static_cast<unsigned char>(word[1])) != 0;
}

std::uint32_t unsigned_of(std::string_view bytes, bool is_little) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t at = is_little ? bytes.size() - 1 - i : i;
    value = value << 8 | static_cast<unsigned char>(bytes[at]);
  }
  return value;
}

std::string bytes_from(std::uint32_t value, std::size_t size, bool is_little) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t at = is_little ? i : size - 1 - i;
    bytes[at] = static_cast<char>(value >> (8 * i) & 0xff);
  }
  return bytes;
}

// Bytewise CRC; the low bit goes first if is_reflected.
std::uint32_t crc(std::string_view bytes, std::uint32_t polynomial, std::uint32_t start,
                  unsigned n_bits, bool is_reflected) {
  const std::uint32_t top = 1U << (n_bits - 1), mask = (top << 1) - 1;
  std::uint32_t state = start;
  for (const char c : bytes) {
    const std::uint32_t byte = static_cast<unsigned char>(c);
    state ^= is_reflected ? byte : byte << (n_bits - 8);
    for (int bit = 0; bit < 8; ++bit) {
      const bool is_out = (state & (is_reflected ? 1U : top)) != 0;
      state = (is_reflected ? state >> 1 : state << 1) & mask;
      if (is_out) state ^= polynomial;
    }
  }
  return state;
}

}  // namespace

std::uint32_t FrameFormat::check_of(std::string_view bytes, Check check) {
  std::uint32_t sum = 0, parity = 0;
  for (const char c : bytes) {
    sum += static_cast<unsigned char>(c);
    parity ^= static_cast<unsigned char>(c);
  }
  switch (check) {
    case Check::kSum8:
      return sum & 0xff;
    case Check::kXor8:
      return parity;
    case Check::kCrc8:
      return crc(bytes, 0x07, 0, 8, false);
    case Check::kCrc16:
      return crc(bytes, 0x1021, 0xffff, 16, false);
    case Check::kModbus:
      break;
  }
  return crc(bytes, 0xa001, 0xffff, 16, true);
}

FrameFormat::Field FrameFormat::check_field(const std::string& type, const std::string& word) {
  static constexpr std::array<std::pair<const char*, Check>, 5> kChecks{
      {{"sum8", Check::kSum8},
       {"xor8", Check::kXor8},
       {"crc8", Check::kCrc8},
       {"crc16", Check::kCrc16},
       {"crc16-modbus", Check::kModbus}}};
  for (const auto& [name, check] : kChecks) {
    if (type != name) continue;
    const bool is_long = check == Check::kCrc16 || check == Check::kModbus;
    return {.kind = Kind::kCheck,
            .size = is_long ? 2U : 1U,
            .is_little = check == Check::kModbus,
            .check = check};
  }
  refuse_field(word, "choose sum8, xor8, crc8, crc16, crc16-modbus");
}

// counts:i24be, seq:u8, micros:u32le: codes have a sign, numbers and clocks have none.
FrameFormat::Field FrameFormat::number_field(Kind kind, const std::string& type,
                                             const std::string& word) {
  static constexpr std::array<std::pair<const char*, std::size_t>, 6> kTypes{
      {{"u8", 1}, {"u16", 2}, {"u32", 4}, {"i16", 2}, {"i24", 3}, {"i32", 4}}};
  const std::string order = type.size() > 2 ? type.substr(type.size() - 2) : "";
  const bool has_order = order == "be" || order == "le";
  const std::string plain = has_order ? type.substr(0, type.size() - 2) : type;
  for (const auto& [name, size] : kTypes) {
    const bool fits = plain == name && (plain[0] == 'i') == (kind == Kind::kCounts) &&
                      has_order == (size > 1) && (kind != Kind::kClock || size == 4);
    if (fits) return {.kind = kind, .size = size, .is_little = order == "le"};
  }
  refuse_field(word,
               "expected a type and the order of its bytes, such as counts:i24be, seq:u8, "
               "seq:u16le or micros:u32le");
}

FrameFormat::Field FrameFormat::field_from(const std::string& word) {
  if (is_hex_byte(word)) {
    return {.kind = Kind::kConstant,
            .constant = static_cast<std::uint8_t>(std::stoul(word, nullptr, 16))};
  }
  const std::size_t colon = word.find(':');
  const std::string name = word.substr(0, colon);
  const std::string type = colon == std::string::npos ? "" : word.substr(colon + 1);
  if (name == "skip") {
    const auto n = integer_from_text(type);
    if (!n || *n < 1 || *n > 200) refuse_field(word, "expected a number of bytes, such as skip:3");
    return {.kind = Kind::kSkip, .size = static_cast<std::size_t>(*n)};
  }
  if (name == "check") return check_field(type, word);
  if (name == "counts") return number_field(Kind::kCounts, type, word);
  if (name == "seq") return number_field(Kind::kSeq, type, word);
  if (name == "micros" || name == "millis") {
    Field field = number_field(Kind::kClock, type, word);
    field.tick_s = name == "micros" ? 1e-6 : 1e-3;
    return field;
  }
  refuse_field(word, "expected a byte such as a5, or counts, seq, micros, millis, skip, check");
}

void FrameFormat::check_fields() const {
  const auto n_of = [&](Kind kind) {
    return std::count_if(fields_.begin(), fields_.end(),
                         [&](const Field& field) { return field.kind == kind; });
  };
  const std::string where = "frame under [load_cell] of the rig file ";
  if (fields_.empty() || fields_.front().kind != Kind::kConstant) {
    throw std::invalid_argument(where +
                                "must begin with a byte that is always the same, such as a5");
  }
  if (n_of(Kind::kCounts) != 1) {
    throw std::invalid_argument(where + "needs one field counts, such as counts:i24be");
  }
  if (n_of(Kind::kSeq) > 1 || n_of(Kind::kClock) > 1 || n_of(Kind::kCheck) > 1) {
    throw std::invalid_argument(where + "has seq, a clock or check twice");
  }
  if (n_of(Kind::kCheck) == 0 && n_of(Kind::kConstant) < 2) {
    throw std::invalid_argument(
        where +
        "has neither a check nor a second byte that is always the same: its "
        "frames cannot be found for certain");
  }
  if (size_ > kLongestFrame) throw std::invalid_argument(where + "is longer than 256 bytes");
}

FrameFormat::FrameFormat(const std::string& description) {
  for (const std::string_view part : split(description, ' ')) {
    const std::string word(trimmed(part));
    if (word.empty()) continue;
    const Field field = field_from(word);
    size_ += field.size;
    if (field.kind == Kind::kClock) tick_s_ = field.tick_s;
    if (field.kind == Kind::kSeq) seq_bits_ = static_cast<unsigned>(8 * field.size);
    if (field.kind == Kind::kCounts) count_bits_ = static_cast<unsigned>(8 * field.size);
    if (field.kind == Kind::kCheck) has_check_ = true;
    fields_.push_back(field);
  }
  check_fields();
}

std::uint32_t FrameFormat::seq_step(std::uint32_t from, std::uint32_t to) const {
  const std::uint32_t step = to - from;
  return seq_bits_ >= 32 ? step : step & ((1U << seq_bits_) - 1);
}

// A converter of 24 bits in a field of 32 ends at 24.
double FrameFormat::highest() const {
  return std::ldexp(1.0, static_cast<int>(std::min(count_bits_, 24U)) - 1) - 1.0;
}
double FrameFormat::lowest() const {
  return -highest() - 1.0;
}

std::optional<FrameFormat::Frame> FrameFormat::parse(std::string_view bytes) const {
  if (bytes.size() != size_) return std::nullopt;
  Frame frame;
  std::size_t at = 0;
  for (const Field& field : fields_) {
    const std::string_view part = bytes.substr(at, field.size);
    const std::uint32_t value = field.size <= 4 ? unsigned_of(part, field.is_little) : 0;
    switch (field.kind) {
      case Kind::kConstant:
        if (value != field.constant) return std::nullopt;
        break;
      case Kind::kCheck:
        if (value != check_of(bytes.substr(0, at), field.check)) return std::nullopt;
        break;
      case Kind::kCounts: {
        const double range = std::ldexp(1.0, static_cast<int>(count_bits_));
        frame.counts = value >= range / 2.0 ? value - range : value;
        break;
      }
      case Kind::kSeq:
        frame.seq = value;
        break;
      case Kind::kClock:
        frame.ticks = value;
        break;
      case Kind::kSkip:
        break;
    }
    at += field.size;
  }
  return frame;
}

std::string FrameFormat::bytes_of(const Frame& frame) const {
  std::string bytes;
  for (const Field& field : fields_) {
    std::uint32_t value = 0;
    switch (field.kind) {
      case Kind::kConstant:
        value = field.constant;
        break;
      case Kind::kCounts:
        value = static_cast<std::uint32_t>(static_cast<std::int64_t>(frame.counts));
        break;
      case Kind::kSeq:
        value = frame.seq.value_or(0);
        break;
      case Kind::kClock:
        value = static_cast<std::uint32_t>(frame.ticks.value_or(0.0));
        break;
      case Kind::kCheck:
        value = check_of(bytes, field.check);
        break;
      case Kind::kSkip:
        bytes += std::string(field.size, '\0');
        continue;
    }
    bytes += bytes_from(value, field.size, field.is_little);
  }
  return bytes;
}

void FrameSplitter::feed(std::string_view bytes, double time_s, double byte_s) {
  if (bytes.empty()) return;
  buffer_ += bytes;
  n_bytes_ += bytes.size();
  arrivals_.push_back({n_bytes_, time_s, byte_s});
}

// When the stream had so many bytes.
double FrameSplitter::arrival_s(std::size_t n_bytes) {
  while (arrivals_.size() > 1 && arrivals_.front().n_bytes < n_bytes) arrivals_.pop_front();
  const Arrival& arrival = arrivals_.front();
  const double after = static_cast<double>(arrival.n_bytes - std::min(arrival.n_bytes, n_bytes));
  last_s_ = std::max(last_s_, arrival.time_s - arrival.byte_s * after);
  return last_s_;
}

std::optional<ReceivedFrame> FrameSplitter::next() {
  const std::size_t size = format_.size();
  std::optional<FrameFormat::Frame> found;
  std::size_t at = 0;
  for (; !found; ++at) {
    const bool needs_two = !format_.has_check() && !(is_in_step_ && at == 0);
    if (buffer_.size() < at + (needs_two ? 2 * size : size)) break;
    const std::string_view rest = std::string_view(buffer_).substr(at);
    found = format_.parse(rest.substr(0, size));
    if (needs_two && !format_.parse(rest.substr(size, size))) found.reset();
  }
  if (found) --at;
  if (at > 0) is_in_step_ = false;
  skipped_ += buffer_.substr(0, at);
  if (skipped_.size() > kMostSkipped) skipped_.erase(0, skipped_.size() - kMostSkipped);
  buffer_.erase(0, found ? at + size : at);
  if (!found) return std::nullopt;
  is_in_step_ = true;
  return ReceivedFrame{*found, arrival_s(n_bytes_ - buffer_.size()), std::exchange(skipped_, "")};
}

}  // namespace viscard
