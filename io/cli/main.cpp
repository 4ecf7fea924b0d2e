#include "io/cli/command.h"

#include <signal.h>
#include <unistd.h>

#include <iostream>

int main(int argc, char** argv) {
  ::signal(SIGXFSZ,
           SIG_IGN);  // writes beyond a file size limit then fail like writes to a full disk
  std::ios::sync_with_stdio(false);
  viscard::Streams streams{std::cout, std::cerr, isatty(STDERR_FILENO) == 1};
  const int status = viscard::run_viscard({argv + 1, argv + argc}, streams);
  std::cout.flush();
  if (!std::cout && status == viscard::kDone) {
    std::cerr << "viscard: standard output could not be written; check for a full disk or a closed "
                 "pipe\n";
    return viscard::kFailed;
  }
  return status;
}
