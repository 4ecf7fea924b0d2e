#pragma once

#include <filesystem>

namespace viscard {

struct CaptureSetup;

// The captures of one specimen of a series: run.viscap, and run.2.viscap, run.3.viscap ... for
// further attempts. Nothing is overwritten or continued in the middle.

// The n-th file, from 1.
std::filesystem::path attempt_path(const std::filesystem::path& first, int n);

// The largest n of a file that is there; 0: none. Those between may have been taken away.
int last_attempt(const std::filesystem::path& first);

// Where the next capture goes.
struct NextCapture {
  std::filesystem::path file;      // does not exist yet; empty if there is a finished capture
  std::filesystem::path finished;  // the first finished capture, or empty
};

// An empty or damaged capture, or one with damaged readings, counts as unfinished. Throws std::runtime_error if another
// program is writing one of the captures, and if `asked` has another test or specimen than a finished capture, naming
// its file and what differs.
NextCapture next_capture(const std::filesystem::path& first, const CaptureSetup* asked = nullptr);

// The file after the last one, also if there is a finished capture. Throws likewise.
std::filesystem::path further_capture(const std::filesystem::path& first);

}  // namespace viscard
