#pragma once

#include "models/experiment/captured_run.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What the checksums of a capture say against its record.
struct IntegrityNote {
  std::string name;  // of the flag in a result: "unverified", "samples-damaged", ...
  std::string text;  // for a person
};

// Of a side file with a hole at its end.
inline constexpr const char* kTornLogText =
    "the newest records in the side file *-wal cannot be read, as a power cut leaves them: the "
    "last second of the run may "
    "be missing";

// What is made of a capture: results and tables of its readings, or the table of its raw bytes.
enum class CapturePart { kReadings, kRawBytes };

// Empty for a record that is what was written.
std::vector<IntegrityNote> integrity_notes(const CapturedRun& run,
                                           CapturePart part = CapturePart::kReadings);

// A note as a line in the head of a table, and back; nothing if the line is none.
std::string line_in_head(const IntegrityNote& note);
std::optional<IntegrityNote> note_in_head(const std::string& line);

}  // namespace viscard
