#pragma once

#include "models/experiment/run_record.h"

#include <functional>
#include <memory>
#include <utility>

namespace viscard {

// Receives every record of a run, in order. It must return at once (for instance queue the record),
// because the calling thread also watches the force limit. An exception from it stops the run
// safely.
using RecordSink = std::function<void(const RunRecord&)>;

// The same sink, but after its first exception it ignores all records: the run that ends then still
// has to stop the stage, and the devices report meanwhile.
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

// Waits a moment and serves every device from which bytes have arrived. Device classes call it
// while they wait for an answer, so that the force is watched meanwhile.
using Pump = std::function<void()>;

}  // namespace viscard
