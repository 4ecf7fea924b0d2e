#include "tests/flow/flow_support.h"

#include "io/cli/command.h"

#include <sstream>

namespace viscard::test {

CommandRun run_words(const std::vector<std::string>& words) {
  std::ostringstream out;
  std::ostringstream err;
  Streams streams{out, err, false};
  CommandRun run;
  run.status = run_viscard(words, streams);
  run.out = out.str();
  run.err = err.str();
  return run;
}

std::string demo_file(const std::string& name) {
  return std::string(VISCARD_DEMO_DATA "/") + name;
}

}  // namespace viscard::test
