#include "io/cli/rig/calibrate_words.h"

#include "io/basics/option_use.h"
#include "io/flow/damaged_table.h"
#include "models/maths/text_of_number.h"
#include "rig/emulator/demo_rig.h"

#include <ostream>
#include <utility>

namespace viscard {

RigConfig calibrate_rig(const CalibrateWords& words) {
  RigConfig rig = !words.rig_file       ? demo_rig()
                  : words.is_compliance ? read_rig(*words.rig_file, words.plausible)
                                        : read_rig_to_calibrate(*words.rig_file, words.plausible);
  if (words.is_emulated) {
    rig.clock_speed = words.speed;
    if (rig.load_cell.volts_per_count == 0.0) {
      rig.load_cell.volts_per_count = demo_rig().load_cell.volts_per_count;
    }
  }
  return rig;
}

EmulatedTruth calibrate_truth(const CalibrateWords& words) {
  return words.truth_file ? read_truth(*words.truth_file) : demo_truth(10.0, 1);
}

CsvTable complete_rows(CsvTable table, bool is_block, Streams& streams) {
  std::size_t n_left_out = 0;
  CsvTable complete = complete_rows(std::move(table), is_block, n_left_out);
  if (n_left_out > 0) {
    streams.err << "viscard: " << complete.file << ": " << counted(n_left_out, "row")
                << " without a number left out\n";
  }
  return complete;
}

void refuse_unverified(const CsvTable& table, const CalibrateWords& words) {
  refuse_idle<UsageError>(
      {{table.file + ": --unverified", words.accepts_unverified, is_exported(table),
        "captures, and tables that viscard exported from them"}});
}

Words inputs_of(const CalibrateWords& words) {
  Words inputs;
  for (const auto* file : {&words.rig_file, &words.data_file, &words.truth_file}) {
    if (*file) inputs.push_back(**file);
  }
  return inputs;
}

}  // namespace viscard
