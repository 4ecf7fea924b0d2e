#include "tests/flow/flow_support.h"

#include "io/cli/command.h"

#include <stdlib.h>

#include <sstream>
#include <stdexcept>

namespace viscard::test {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "viscard-flow-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

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
