#include "io/cli/scene/tolerance_option.h"

#include "io/cli/words/streams.h"

#include <string>

namespace po = boost::program_options;

namespace viscard {

void add_tolerance_option(po::options_description& options) {
  options.add_options()("tol", po::value<double>(),
                        "relative error allowed, instead of the scene's");
}

void apply_tolerance(const po::variables_map& values, Scene& scene) {
  if (values.count("tol") == 0) return;
  const double tolerance = values["tol"].as<double>();
  const ToleranceRange& range = tolerances_of(scene);
  if (!range.contains(tolerance)) {
    throw UsageError(std::string("--tol must lie between ") + range.words);
  }
  common(scene).tolerance = tolerance;
}

}  // namespace viscard
