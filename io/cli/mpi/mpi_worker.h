#pragma once

#include "io/cli/mpi/mpi_ranks.h"
#include "io/flow/sweep/study.h"

#include <string>

namespace viscard {

// What rank 0 sends with RankTag::kStart, as text.
struct WorkerStart {
  std::string study_path;
  std::string fingerprint;    // of the study as rank 0 sees it
  double lost_after_s = 0.0;  // silence after which ranks count as lost
};
std::string text_from(const WorkerStart& start);
WorkerStart start_from(const std::string& text);

// A rank other than 0: answers the points that rank 0 sends until that ends the work. Returns the exit
// status.
int run_worker(MpiRanks& ranks);

}  // namespace viscard
