#include "io/flow/table_from_capture.h"

#include "fit/run_timing.h"
#include "io/capture/capture_export.h"

namespace viscard {

std::string table_from_capture(const CapturedRun& run) {
  return csv_from_capture(run, timing_from_capture(run));
}

}  // namespace viscard
