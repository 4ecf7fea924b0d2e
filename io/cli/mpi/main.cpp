// viscard-mpi: a sweep on many machines. Rank 0 reads the words and keeps the answers, the others answer.
#include "io/basics/program.h"
#include "io/cli/command.h"
#include "io/cli/help/documents.h"
#include "io/cli/mpi/mpi_dispatch.h"
#include "io/cli/mpi/mpi_worker.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/printable_stream.h"
#include "io/cli/words/terminal.h"

#include <signal.h>
#include <unistd.h>

#include <iostream>

namespace {

using namespace viscard;

constexpr const char* kUsage = "mpirun -n N viscard-mpi sweep STUDY.toml [OPTIONS]";
constexpr const char* kSummary = "answer a scene at many values of its parameters on many machines";

constexpr double kLostAfter_s = 60.0;

// All but the work.
SweepProgram described_program(double& lost_after_s) {
  SweepProgram program{
      kUsage,
      "Answers the points of a study as viscard sweep does, on all ranks that mpirun or srun has "
      "started. Rank 0 hands out one point after the other and keeps each answer as it arrives, in "
      "a file that viscard sweep reads, too; the answers are the same bit for bit. A sweep that "
      "was stopped continues where it was. A rank that dies ends all others, unless mpirun was "
      "called with --enable-recovery: then others answer its point.",
      "mpirun -n 2 viscard-mpi sweep data/studies/pillar.toml --out study.sqlite --csv study.csv"};
  program.add_options = [&lost_after_s](OptionList& options) {
    options.add("lost-after", &lost_after_s, "a rank that is silent for so long counts as lost")
        .of("s")
        .by_default("60 s");
  };
  return program;
}

SweepProgram program_of(double& lost_after_s, MpiRanks& ranks, Streams& streams, RanksEnd& end) {
  SweepProgram program = described_program(lost_after_s);
  program.run = [&](const SweepJob& job) {
    if (!(lost_after_s >= 1.0)) throw UsageError("--lost-after must be at least 1 s");
    return dispatch_study(job, lost_after_s, ranks, streams, end);
  };
  return program;
}

int run_words(const Words& words, Streams& streams, MpiRanks& ranks, RanksEnd& end) {
  double lost_after_s = kLostAfter_s;
  const SweepProgram program = program_of(lost_after_s, ranks, streams, end);
  if (words.empty()) {
    throw UsageError(std::string("no study given; usage: ") + kUsage);
  }
  if (words[0] == "--version") {
    streams.out << "viscard-mpi " << program_version() << "\n";
    return kDone;
  }
  if (words[0] == "--help" || words[0] == "-h") {
    return run_sweep_program(program, {"--help"}, streams);
  }
  if (words[0] != "sweep") {
    throw UsageError("there is no command '" + words[0] + "', only sweep; usage: " + kUsage);
  }
  return run_sweep_program(program, {words.begin() + 1, words.end()}, streams);
}

// The source of viscard-mpi.1, for which no ranks are needed.
int print_manual_page() {
  Streams streams{std::cout, std::cerr};
  streams.on_help = [](const CommandSyntax& syntax) {
    std::cout << manual_page({"mpi", kSummary, syntax});
  };
  double lost_after_s = kLostAfter_s;
  return run_sweep_program(described_program(lost_after_s), {"--help"}, streams);
}

// Words, work and messages of rank 0. Returns the exit status.
int run_rank_0(const Words& words, MpiRanks& ranks) {
  PrintableStream err(std::cerr);
  Streams streams{std::cout, err, is_drawable(STDERR_FILENO)};
  streams.columns = columns_of(STDOUT_FILENO);
  streams.is_out_coloured = is_coloured(words, STDOUT_FILENO);
  streams.is_err_coloured = is_coloured(words, STDERR_FILENO);
  RanksEnd end = RanksEnd::kNotStarted;
  const int status = with_exit_status("viscard-mpi", words, streams,
                                      [&] { return run_words(words, streams, ranks, end); });
  std::cout.flush();
  std::cerr.flush();
  if (end == RanksEnd::kNotStarted) ranks.send_to_all_others(RankTag::kEnd);
  if (end == RanksEnd::kStandingBy) {
    ranks.send_to_all_others(RankTag::kQuit);
    MpiRanks::quit(status);  // MPI_Finalize would wait for the ranks that are lost
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGXFSZ,
           SIG_IGN);  // writes beyond a file size limit then fail like writes to a full disk
  const Words words{argv + 1, argv + argc};
  if (words == Words{"--man"}) return print_manual_page();
  MpiRanks ranks(argc, argv);
  return ranks.rank() == 0 ? run_rank_0(words, ranks) : run_worker(ranks);
}
