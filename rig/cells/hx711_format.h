#pragma once

#include "models/experiment/rig_config.h"
#include "rig/lines/line_splitter.h"
#include "rig/protocols/hx711_protocol.h"
#include "rig/protocols/line_columns.h"

#include <deque>
#include <optional>
#include <string>

namespace viscard {

// The columns that the line_format of a rig file names; nothing for a word of one format.
std::optional<LineColumns> declared_columns(const LoadCellConfig& config);

// The line_format of a rig file, or that of its columns. Throws RigError on an unknown word.
Hx711Format declared_hx711_format(const LoadCellConfig& config);

// The format that these lines have, or nothing while that is uncertain. "12,34" is a decimal comma
// or "time,counts": it counts as a clock if most of its steps fit the expected rate of the readings
// (or, in a full window, the times of arrival), and as a decimal comma if many do not grow. Single
// steps prove nothing, because a board may reset or its counter wrap among the lines.
std::optional<Hx711Format> learnt_hx711_format(const std::deque<ReceivedLine>& lines,
                                               double rate_Hz);

// Finds the format of an amplifier's lines from the first of them. The newest 16 are judged, or as
// few as 6 if they are clear.
class Hx711Learner {
 public:
  explicit Hx711Learner(const LoadCellConfig& config);

  // Returns the format once it is certain; that is the declared one if there is one. Throws
  // RigError, which names the right format, if the declared one cannot be right.
  std::optional<Hx711Format> take(const ReceivedLine& line);

  const std::string& newest_text() const;

 private:
  bool has_declared_shape() const;
  bool contradicts_declared(Hx711Format learnt) const;

  Hx711Format declared_;
  bool has_unit_;
  double rate_Hz_;
  std::deque<ReceivedLine> lines_;
};

}  // namespace viscard
