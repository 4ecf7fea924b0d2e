#include "io/cli/rig/capture_summary.h"

#include "io/cli/rig/live_view.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <ostream>

namespace viscard {
namespace {

constexpr std::size_t kPictureWidth = 60;

std::string depth_text(const RunOutcome& outcome) {
  if (outcome.depth_is == "measured") return "measured by the stage";
  if (outcome.depth_is == "counted") return "counted in steps, not measured";
  return fmt::format("counted in steps; right within {:.1f} um when homed after it",
                     outcome.count->within_m * 1e6);
}

}  // namespace

void print_text(const CaptureOutcome& capture, std::ostream& out) {
  const RunOutcome& outcome = capture.run;
  const StreamCounts& stream = outcome.stream;
  const bool is_doubtful = !outcome.doubts.empty();
  out << fmt::format("{}: {}{}\n", capture.file, outcome.status, is_doubtful ? ", doubtful" : "");
  for (const std::string& doubt : outcome.doubts) out << "  doubt           " << doubt << "\n";
  out << (outcome.line_format.empty() ? std::string()
                                      : fmt::format("  lines read as   {}\n", outcome.line_format))
      << fmt::format("  peak force      {:.4f} N (expected at most {:.4f}, limit {:.4f})\n",
                     outcome.peak_force_N, outcome.expected.peak_force_N, outcome.expected.limit_N)
      << (outcome.contact_position_m
              ? fmt::format("  depth reached   {:.4f} mm ({})\n", outcome.achieved_depth_m * 1e3,
                            depth_text(outcome))
              : std::string("  depth reached   none: no contact was found\n"))
      << fmt::format("  noise           {:.3f} mN per reading\n", outcome.noise_N * 1e3)
      << fmt::format(
             "  readings        expected {}, received {}, missing {}, duplicate {}, glitch {}, "
             "unreadable {}, implausible {}\n",
             stream.expected(), stream.received, stream.missing, stream.duplicate, stream.glitch,
             stream.unreadable, stream.implausible)
      << fmt::format("  longest gap     {:.4f} s, at {:.1f} s\n", stream.longest_gap_s,
                     stream.longest_gap_at_s);
  if (outcome.hidden_error_N > 0.0) {
    out << fmt::format(
        "  checked         against neighbours: errors above {:.3f} mN would show at rest\n",
        outcome.hidden_error_N * 1e3);
  }
  if (outcome.temperature) {
    out << fmt::format("  temperature     {:.2f} C, from {:.2f} to {:.2f} C\n",
                       outcome.temperature->mean_C, outcome.temperature->min_C,
                       outcome.temperature->max_C);
  }
  if (outcome.n_late > 0) {
    out << fmt::format("  computer        late by up to {:.2f} s, {} in all: not watched then\n",
                       outcome.longest_late_s,
                       counted(static_cast<std::size_t>(outcome.n_late), "time"));
  }
  if (!capture.force_N.empty()) {
    out << "  force           " << sparkline(capture.force_N, kPictureWidth) << "\n";
  }
}

}  // namespace viscard
