#include "io/cli/command.h"
#include "io/cli/words/printable_stream.h"
#include "io/cli/words/terminal.h"
#include "models/maths/failure_text.h"
#include "models/maths/kept_memory.h"

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <new>

// The least memory that any command needs.
constexpr std::size_t kLeast_B = std::size_t{8} << 20;

int main(int argc, char** argv) {
  try {
    viscard::require_spare_memory(kLeast_B);
  } catch (const std::bad_alloc&) {
    std::fputs(
        "viscard: memory does not suffice to start; close other programs or raise the limit\n",
        stderr);
    return viscard::kFailed;
  }
  viscard::keep_freed_memory();
  ::signal(SIGXFSZ,
           SIG_IGN);  // writes beyond a file size limit then fail like writes to a full disk
  std::ios::sync_with_stdio(false);
  viscard::PrintableStream err(std::cerr), shown_out(std::cout, /*is_buffered=*/true);
  // Tables and cards that go to a file keep every byte.
  std::ostream& out = ::isatty(STDOUT_FILENO) == 1 ? shown_out : std::cout;
  viscard::Streams streams{out, err, viscard::is_drawable(STDERR_FILENO)};
  const viscard::Words words{argv + 1, argv + argc};
  streams.columns = viscard::columns_of(STDOUT_FILENO);
  streams.is_out_coloured = viscard::is_coloured(words, STDOUT_FILENO);
  streams.is_err_coloured = viscard::is_coloured(words, STDERR_FILENO);
  const int status = viscard::run_viscard(words, streams);
  std::cout.flush();
  if (!std::cout && status == viscard::kDone) {
    std::cerr << "viscard: standard output could not be written; check for a full disk or a closed "
                 "pipe\n";
    return viscard::kFailed;
  }
  return status;
}
