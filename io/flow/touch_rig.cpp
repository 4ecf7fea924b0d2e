#include "io/flow/touch_rig.h"

#include "io/basics/atomic_file.h"
#include "io/flow/open_rig.h"
#include "rig/touch_cell.h"

#include <sstream>
#include <stdexcept>

namespace viscard {

double touch_rig(const RigConfig& rig, bool is_emulated, double wait_s,
                 const std::function<void()>& ready, const std::atomic<bool>* stop) {
  OpenRig open(rig, is_emulated);
  TouchOptions options;
  options.wait_s = wait_s;
  options.stop = stop;
  options.ready = [&] {
    if (ready) ready();
    if (open.emulated() != nullptr)
      open.emulated()->hang_weight(0.1 * open.config().calibration.capacity_N);
  };
  return await_touch(*open.devices().load_cell, open.config(), open.clock(), options);
}

void write_answer(const std::filesystem::path& rig_file, const std::string& day) {
  std::istringstream lines(read_file(rig_file));
  std::string out, line;
  bool is_inside = false, is_written = false;
  while (std::getline(lines, line)) {
    const std::size_t begin = line.find_first_not_of(" \t");
    const std::string rest = begin == std::string::npos ? "" : line.substr(begin);
    if (is_inside && rest.rfind("answered_on", 0) == 0) continue;
    out += line + "\n";
    if (rest.rfind('[', 0) != 0) continue;
    is_inside = rest.rfind("[load_cell]", 0) == 0;
    if (!is_inside) continue;
    out += "answered_on = " + day + "\n";
    is_written = true;
  }
  if (!is_written) {
    throw std::runtime_error(rig_file.string() +
                             ": has no section [load_cell]; write answered_on = " + day +
                             " where its load cell is described");
  }
  write_file(rig_file, out, true);
}

}  // namespace viscard
