#include "io/capture/integrity_notes.h"

#include "io/config/config_file.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace viscard {
namespace {

constexpr std::string_view kDamageMark = "damage: ";
constexpr std::string_view kNoteNames[] = {
    "unverified",     "samples-damaged",   "reports-damaged",   "temperatures-damaged",
    "side-file-torn", "side-file-missing", "calibration-edited"};

}  // namespace

std::vector<IntegrityNote> integrity_notes(const CapturedRun& run, CapturePart part) {
  const RecordIntegrity& integrity = run.integrity;
  std::vector<IntegrityNote> notes;
  if (!integrity.has_checksums) {
    notes.push_back({"unchecked",
                     "the capture was written before captures carried checksums, so damage to it "
                     "cannot be noticed"});
  }
  if (integrity.is_damage_accepted) {
    notes.push_back({"unverified", "the capture is damaged and was read with --unverified: " +
                                       integrity.faults.front()});
  }
  if (run.rig.calibration.id.ends_with(kEditedMark) || run.rig.frame.id.ends_with(kEditedMark)) {
    notes.push_back(
        {"calibration-edited",
         "the record of its load cell or frame was edited since viscard calibrate wrote it"});
  }
  const auto left_out = [&notes](const char* name, std::size_t count, const char* what) {
    if (count == 0) return;
    notes.push_back(
        {name,
         counted(count, what) +
             (count == 1 ? " of the capture was left out: its checksum shows that it is "
                         : " of the capture were left out: their checksums show that they are ") +
             "not what was written"});
  };
  if (part == CapturePart::kRawBytes) {
    left_out("raw-bytes-damaged", integrity.n_left_out_raw, "raw message");
  } else {
    left_out("samples-damaged", integrity.n_left_out_samples, "reading");
    left_out("reports-damaged", integrity.n_left_out_reports, "report of the stage");
    left_out("temperatures-damaged", integrity.n_left_out_temperatures, "temperature");
  }
  if (integrity.has_torn_log) notes.push_back({"side-file-torn", kTornLogText});
  if (integrity.has_lost_log) {
    notes.push_back({"side-file-missing",
                     "the run was interrupted, and the side file *-wal that may hold its last "
                     "seconds, or all of it, is missing: copy it with the capture"});
  }
  return notes;
}

std::string line_in_head(const IntegrityNote& note) {
  return std::string(kDamageMark) + note.name + ": " + note.text;
}

// Tables of before the name was written count as "unverified".
std::optional<IntegrityNote> note_in_head(const std::string& line) {
  if (!line.starts_with(kDamageMark)) return std::nullopt;
  const std::string text = line.substr(kDamageMark.size());
  const std::size_t end = text.find(": ");
  const auto name = std::find(std::begin(kNoteNames), std::end(kNoteNames), text.substr(0, end));
  if (end == std::string::npos || name == std::end(kNoteNames))
    return IntegrityNote{"unverified", text};
  return IntegrityNote{std::string(*name), text.substr(end + 2)};
}

}  // namespace viscard
