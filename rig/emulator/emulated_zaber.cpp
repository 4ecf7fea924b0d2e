#include "rig/emulator/emulated_zaber.h"

#include "models/maths/text_of_number.h"
#include "rig/protocols/zaber_protocol.h"

#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr long long kLimit_microsteps = 1'000'000'000;
constexpr double kEmergency = 10.0;  // deceleration of estop over the acceleration

std::string two_digits(int number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (const std::string_view word : split(text, ' ')) {
    if (!word.empty()) words.emplace_back(word);
  }
  return words;
}

}  // namespace

EmulatedZaber::EmulatedZaber(const EmulatedTruth& truth, int toward_specimen, int device,
                             const ZaberHabits& habits)
    : EmulatedController(truth.steps_per_m),
      habits_(habits),
      microstep_m_(1.0 / truth.steps_per_m),
      toward_(toward_specimen < 0 ? -1.0 : 1.0),
      device_(device),
      max_speed_data_(
          static_cast<double>(zaber_speed_data(truth.max_rate_m_s * truth.steps_per_m))),
      acceleration_data_(std::round(truth.acceleration_m_s2 * truth.steps_per_m * 1.6384e-4)),
      has_reference_(habits.has_reference) {}

double EmulatedZaber::speed_m_s() const {
  return microsteps_s_from_zaber(max_speed_data_) * microstep_m_;
}
double EmulatedZaber::acceleration_m_s2() const {
  return microsteps_s2_from_zaber(acceleration_data_) * microstep_m_;
}
long long EmulatedZaber::microsteps(double time_s) const {
  return std::llround(toward_ * (motion_.position_m(time_s) - origin_m_) / microstep_m_);
}

// Opening the port does not reset a Zaber controller, and a move goes on.
void EmulatedZaber::reset(double time_s) {
  begun_.clear();
  answers_.clear();
  if (!std::exchange(has_started_, true) || !habits_.loses_power) return;
  motion_.stop_at_once(time_s);
  has_reference_ = is_stalled_ = is_interrupted_ = false;
  origin_m_ = motion_.position_m(time_s);
}

void EmulatedZaber::hit_limit(double time_s) {
  motion_.stop_at_once(time_s);
  is_stalled_ = true;
}

void EmulatedZaber::receive(std::string_view bytes, double time_s) {
  for (const char c : bytes) {
    if (c != '\n' && c != '\r') {
      begun_ += c;
      continue;
    }
    if (!begun_.empty()) line(std::exchange(begun_, ""), time_s);
  }
}

void EmulatedZaber::line(std::string_view text, double time_s) {
  if (text.front() != '/') return;
  text.remove_prefix(1);
  const std::size_t colon = text.rfind(':');
  if (colon != std::string_view::npos) {
    if (text.substr(colon + 1) != zaber_checksum(text.substr(0, colon))) return;
    text = text.substr(0, colon);
  }
  std::vector<std::string> words = words_of(text);
  if (words.size() < 3 || words[0] != std::to_string(device_)) return;
  const std::string id = words[2];
  words.erase(words.begin(), words.begin() + 3);
  rejection_ = "BADCOMMAND";
  reply(id, obey(words, time_s), time_s);
}

std::optional<std::string> EmulatedZaber::obey(const std::vector<std::string>& words,
                                               double time_s) {
  if (words.empty()) return "0";
  const std::string& verb = words[0];
  if (verb == "get" && words.size() == 2) return get(words[1], time_s);
  if (verb == "set" && words.size() == 3) {
    return set(words[1], number_from_text(words[2]).value_or(-1.0));
  }
  if (verb == "move") return move(words, time_s);
  if (verb == "stop" || (verb == "estop" && habits_.knows_estop)) {
    is_interrupted_ = motion_.is_moving(time_s);
    motion_.stop_gently(time_s, acceleration_m_s2() * (verb == "estop" ? kEmergency : 1.0));
    return "0";
  }
  if (verb == "home") {
    motion_.start(time_s, 0.0, speed_m_s(), acceleration_m_s2());
    origin_m_ = 0.0;
    has_reference_ = true;
    return "0";
  }
  if (verb == "warnings") {
    if (words.size() == 2 && words[1] == "clear") is_stalled_ = is_interrupted_ = false;
    return is_stalled_ ? "01 FS" : "00";
  }
  if (verb == "driver") return "0";
  return std::nullopt;
}

std::optional<std::string> EmulatedZaber::get(const std::string& setting, double time_s) const {
  if (setting == "pos") return std::to_string(microsteps(time_s));
  if (setting == "version") return "6.14";
  if (setting == "deviceid") return "50081";
  if (setting == "maxspeed") return text_from_number(max_speed_data_, 0);
  if (setting == "accel") return text_from_number(acceleration_data_, 0);
  if (setting == "resolution") return "64";
  return std::nullopt;
}

std::optional<std::string> EmulatedZaber::set(const std::string& setting, double value) {
  rejection_ = "BADDATA";
  if (!(value >= 1.0) || value != std::floor(value)) return std::nullopt;
  if (setting == "maxspeed") {
    max_speed_data_ = value;
  } else if (setting == "accel") {
    acceleration_data_ = value;
  } else {
    rejection_ = "BADCOMMAND";
    return std::nullopt;
  }
  return "0";
}

std::optional<std::string> EmulatedZaber::move(const std::vector<std::string>& words,
                                               double time_s) {
  const auto number = words.size() == 3 ? integer_from_text(words[2]) : std::nullopt;
  if (!number || words[1] != "abs") return std::nullopt;
  rejection_ = "BADDATA";
  if (std::llabs(*number) > kLimit_microsteps) return std::nullopt;
  rejection_ = "STATUSBUSY";
  if (motion_.is_moving(time_s)) return std::nullopt;
  is_interrupted_ = false;
  motion_.start(time_s, origin_m_ + toward_ * static_cast<double>(*number) * microstep_m_,
                speed_m_s(), acceleration_m_s2());
  return "0";
}

std::string EmulatedZaber::flag() const {
  if (is_stalled_) return "FS";
  if (!has_reference_) return "WR";
  return is_interrupted_ ? "NI" : "--";
}

void EmulatedZaber::reply(const std::string& id, const std::optional<std::string>& data,
                          double time_s) {
  ++n_replies_;
  const auto is_nth = [&](int every) { return every > 0 && n_replies_ % every == 0; };
  if (is_nth(habits_.lose_reply_every)) return;
  std::string text = two_digits(device_) + " 1 " + id + (data ? " OK " : " RJ ") +
                     (motion_.is_moving(time_s) ? "BUSY " : "IDLE ") + flag() + " " +
                     data.value_or(rejection_);
  std::string line = "@" + text;
  if (habits_.sends_checksums) line += ":" + zaber_checksum(text);
  if (is_nth(habits_.garble_reply_every)) line[line.size() - 4] ^= 1;  // a digit of the data
  if (habits_.has_neighbour) say("@02 1 " + id + " OK IDLE -- 999999", time_s);
  say(line, time_s + habits_.reply_delay_s);
}

void EmulatedZaber::say(std::string text, double due_s) {
  answers_.add(due_s, std::move(text) + "\r\n");
}

void EmulatedZaber::tick(double time_s) {
  const bool is_moving_now = motion_.is_moving(time_s);
  if (was_moving_ && !is_moving_now && habits_.sends_alerts) {
    say("!" + two_digits(device_) + " 1 IDLE " + flag(), time_s);
  }
  was_moving_ = is_moving_now;
  output_ += answers_.take_due(time_s);
}

}  // namespace viscard
