#pragma once

#include "io/cli/mpi/mpi_ranks.h"
#include "io/cli/scene/sweep_program.h"
#include "io/cli/words/streams.h"

namespace viscard {

// How rank 0 has left the others.
enum class RanksEnd {
  kNotStarted,  // they wait
  kEnded,       // they wait for this rank in MPI_Finalize
  kStandingBy   // some are lost, so this process must not wait for them: they are to quit
};

// Rank 0: hands the points of the job out to the other ranks and keeps their answers. With few ranks it
// answers points itself, too. Ranks that are silent for longer than lost_after_s count as lost, and others
// answer their points. Reports on `streams` which ranks were lost or see another study.
// Throws std::runtime_error if points are left that nobody could answer; all others are kept.
// end: set as soon as it changes, also if this throws.
StudyOutcome dispatch_study(const SweepJob& job, double lost_after_s, MpiRanks& ranks,
                            Streams& streams, RanksEnd& end);

}  // namespace viscard
