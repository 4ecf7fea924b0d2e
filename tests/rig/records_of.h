#pragma once

#include "models/experiment/run_record.h"

#include <variant>
#include <vector>

namespace viscard {

// The records of one kind.
template <class Record>
std::vector<Record> records_of(const std::vector<RunRecord>& records) {
  std::vector<Record> found;
  for (const RunRecord& record : records) {
    if (const auto* one = std::get_if<Record>(&record)) found.push_back(*one);
  }
  return found;
}

}  // namespace viscard
