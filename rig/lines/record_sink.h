#pragma once

#include "models/experiment/run_record.h"

#include <functional>
#include <memory>
#include <utility>

namespace viscard {

// Takes everything a run hands out, in order. It must return at once (queue and go): the force
// limit is watched by the thread that calls it. What it throws stops the run safely.
using RecordSink = std::function<void(const RunRecord&)>;

// The same sink, which after its first exception takes no more: the run that ends then still has to
// stop the stage, and the devices go on reporting meanwhile.
inline RecordSink failing_once(RecordSink sink) {
  auto has_failed = std::make_shared<bool>(false);
  return [sink = std::move(sink), has_failed](const RunRecord& record) {
    if (*has_failed) return;
    try {
      sink(record);
    } catch (...) {
      *has_failed = true;
      throw;
    }
  };
}

// Waits a moment and serves every device that has something to say; what device classes call while
// they wait for an answer, so that the force is watched meanwhile.
using Pump = std::function<void()>;

}  // namespace viscard
