#pragma once

#include "tests/support/scratch_folder.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace viscard::test {

// A folder for the files of one test of `viscard fit`; it is removed when the test ends.
class TableFolder {
 public:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
  }

 private:
  ScratchFolder folder_;
};

// 1.6 MPa + 0.2 MPa exp(-t/3 s), with a row of units. The last digits vary in place of noise.
inline std::string relaxation_table() {
  std::ostringstream text;
  text.precision(12);
  text << "t,E_relax\ns, MPa\n";
  for (int i = 0; i <= 100; ++i) {
    const double t = std::pow(10.0, -2.0 + 4.0 * i / 100.0);
    text << t << "," << 1.6 + 0.2 * std::exp(-t / 3.0) + 1e-6 * ((7 * i) % 11) << "\n";
  }
  return text.str();
}

}  // namespace viscard::test
