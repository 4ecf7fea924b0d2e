#pragma once

#include <stdexcept>

namespace viscard {

// The value of an option is not allowed, or options exclude each other. The command line names the
// option as --max-terms; the Python module writes the same words with its own name, max_terms.
class OptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace viscard
