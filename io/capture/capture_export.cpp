#include "io/capture/capture_export.h"

#include "io/basics/number_text.h"
#include "io/basics/program.h"
#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/capture/capture_file.h"
#include "io/capture/integrity_notes.h"
#include "models/experiment/calibration.h"
#include "models/experiment/motion_profile.h"
#include "models/experiment/sample_force.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

namespace viscard {
namespace {

using Buffer = fmt::memory_buffer;

// The last event of that name, as a number in SI.
std::optional<double> number_of_event(const CapturedRun& run, const std::string& name) {
  std::optional<double> found;
  for (const RunEvent& event : run.events) {
    if (event.name != name) continue;
    try {
      found = si_from_text(event.value, "1");
    } catch (const std::invalid_argument&) {
      // An event without a number is ignored here.
    }
  }
  return found;
}

void append_line(Buffer& out, const std::string& text) {
  fmt::format_to(std::back_inserter(out), "# {}\n", utf8_on_one_line(text));
}

void append_damage(Buffer& out, const CapturedRun& run, CapturePart part) {
  if (!run.integrity.has_checksums) return;
  for (const IntegrityNote& note : integrity_notes(run, part)) {
    append_line(out, line_in_head(note));
  }
}

void append_head(Buffer& out, const CapturedRun& run, const RunTiming& timing, double tare_N) {
  const auto line = [&out](const std::string& text) { append_line(out, text); };
  line(kExportedHead + program_with_version());
  line("captured: " + run.started_at + " by " + run.program + ": " + run.command);
  line("status: " + run.status +
       (run.status == "finished" ? "" : " (not the whole test: everything recorded is below)"));
  line("specimen: " + run.specimen.id + ", " + run.specimen.material);
  line("rig: " + run.rig.name + ", calibration " + run.rig.calibration.id + " of " +
       run.rig.calibration.date);
  line("force_N = " + std::string(run.rig.load_cell.compression_is_positive ? "" : "-") +
       "(volts - " + text_from_number(run.rig.calibration.zero_volts) + " V)/(" +
       text_from_number(run.rig.calibration.volts_per_newton) + " V/N) - tare " +
       text_from_number(tare_N) + " N");
  append_damage(out, run, CapturePart::kReadings);
  if (!timing.description.empty()) line(timing.description);
  for (const RunEvent& event : run.events) {
    line(fmt::format("event at {:.3f} s: {} {} {}", event.host_time_s, event.name, event.value,
                     event.text));
  }
}

void append_cell(Buffer& out, const std::optional<double>& value) {
  if (value && std::isfinite(*value)) fmt::format_to(std::back_inserter(out), "{}", *value);
  out.push_back(',');
}

std::string quoted_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

// Turns samples into rows, with force, position, depth and phase at the time of the sample.
class SampleRows {
 public:
  SampleRows(const CapturedRun& run, const RunTiming& timing)
      : run_(run),
        timing_(timing),
        tare_N_(number_of_event(run, "tare").value_or(0.0)),
        contact_m_(number_of_event(run, "contact")) {
    for (const CommandedMove& move : run.moves) moves_.push_back(move.move);
    if (timing.move_start_s.empty()) return;
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      moves_[i].start_time_s = timing.move_start_s.at(i);
      moves_[i].speed_m_s *= timing.move_speed;
      moves_[i].acceleration_m_s2 *= timing.move_speed * timing.move_speed;
    }
  }

  double tare_N() const { return tare_N_; }
  bool has_depth() const { return contact_m_.has_value() && !moves_.empty(); }
  bool has_temperature() const { return !run_.temperatures.empty(); }

  void append(Buffer& out, std::size_t row) {
    const LoadSample& sample = run_.load_samples[row];
    const double time_s = timing_.sample_s.empty() ? sample.host_time_s : timing_.sample_s.at(row);
    const std::optional<double> volts = volts_of(sample);
    const std::optional<double> force_N = force_of(sample);
    append_cell(out, time_s);
    append_cell(out, sample.host_time_s);
    append_cell(out, sample.device_time_s);
    append_cell(out, sample.counts);
    append_cell(out, volts);
    append_cell(out, force_N);
    std::optional<double> stage_m;
    if (!moves_.empty()) stage_m = position_m(moves_, time_s);
    append_cell(out, stage_m);
    if (has_depth()) append_cell(out, depth_of(*stage_m, force_N));
    if (has_temperature()) append_cell(out, temperature_at(sample.host_time_s));
    fmt::format_to(std::back_inserter(out), "{},{},{}\n", phase_at(time_s),
                   sample.is_saturated ? 1 : 0, sample.is_glitch ? 1 : 0);
  }

 private:
  std::optional<double> volts_of(const LoadSample& sample) const {
    return sample.force_N ? std::nullopt : reading_from_sample(sample, run_.rig.load_cell);
  }
  std::optional<double> force_of(const LoadSample& sample) const {
    const std::optional<double> force_N = force_N_from_sample(sample, run_.rig);
    return force_N ? std::optional(*force_N - tare_N_) : std::nullopt;
  }
  std::optional<double> depth_of(double stage_m, const std::optional<double>& force_N) const {
    if (!force_N) return std::nullopt;
    const double frame_N_m = run_.rig.frame.stiffness_N_m;
    return stage_m - *contact_m_ - (frame_N_m > 0.0 ? *force_N / frame_N_m : 0.0);
  }
  // The newest temperature; nothing before the first one, or while the thermometer was silent.
  std::optional<double> temperature_at(double host_time_s) {
    while (next_temperature_ < run_.temperatures.size() &&
           run_.temperatures[next_temperature_].host_time_s <= host_time_s) {
      ++next_temperature_;
    }
    if (next_temperature_ == 0) return std::nullopt;
    const TemperatureSample& newest = run_.temperatures[next_temperature_ - 1];
    const double age_s = host_time_s - newest.host_time_s;
    if (age_s > silent_after_s(run_.rig.thermometer)) return std::nullopt;
    return newest.temperature_C;
  }
  // The times rise but for swapped neighbours, so the events are read only once.
  const std::string& phase_at(double time_s) {
    while (next_event_ < run_.events.size() && run_.events[next_event_].host_time_s <= time_s) {
      const RunEvent& event = run_.events[next_event_++];
      if (event.name == "phase") phase_ = quoted_cell(event.value);
    }
    return phase_;
  }

  const CapturedRun& run_;
  const RunTiming& timing_;
  double tare_N_;
  std::optional<double> contact_m_;
  std::vector<StageMove> moves_;
  std::size_t next_event_ = 0;
  std::size_t next_temperature_ = 0;
  std::string phase_;
};

std::string escaped(const std::string& bytes) {
  constexpr std::string_view kSpecial = "\r\n\\";
  constexpr const char* kEscapes[] = {"\\r", "\\n", "\\\\"};
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const std::size_t special = kSpecial.find(c);
    if (special != std::string_view::npos) {
      out += kEscapes[special];
    } else {
      out += byte < 0x20 || byte >= 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
    }
  }
  return out;
}

}  // namespace

std::string csv_from_capture(const CapturedRun& run, const RunTiming& timing) {
  SampleRows rows(run, timing);
  Buffer out;
  append_head(out, run, timing, rows.tare_N());
  fmt::format_to(std::back_inserter(out),
                 "time_s,host_time_s,device_time_s,counts,volts,force_N,stage_position_m,{}{}phase,"
                 "is_saturated,is_glitch\n",
                 rows.has_depth() ? "depth_m," : "",
                 rows.has_temperature() ? "temperature_C," : "");
  for (std::size_t row = 0; row < run.load_samples.size(); ++row) rows.append(out, row);
  return fmt::to_string(out);
}

std::string csv_from_raw_bytes(const std::filesystem::path& capture, const CapturedRun& run) {
  Buffer out;
  append_damage(out, run, CapturePart::kRawBytes);
  fmt::format_to(std::back_inserter(out), "host_time_s,device,direction,bytes\n");
  read_raw_bytes(capture, [&out](const RawBytes& raw) {
    fmt::format_to(std::back_inserter(out), "{},{},{},{}\n", raw.host_time_s, word_of(raw.device),
                   raw.is_sent ? "sent" : "received", quoted_cell(escaped(raw.bytes)));
  });
  return fmt::to_string(out);
}

}  // namespace viscard
