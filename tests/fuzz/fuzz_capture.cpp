// Every file is read as a capture or refused by one exception with a text. The input is either the
// file itself, or it overwrites single bytes of a whole capture (two bytes of position, one of
// value), so that the damage reaches deep.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_export.h"
#include "io/capture/capture_file.h"
#include "tests/fuzz/fuzz_folder.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace {

using namespace viscard;

const std::string& whole_capture() {
  static const std::string bytes = [] {
    CapturedRun about;
    about.rig.calibration.volts_per_newton = 0.7255;
    about.rig.calibration.capacity_N = 2.45;
    about.plan.depth_m = 1e-4;
    about.specimen.id = "fuzz";
    about.specimen.modulus_guess_Pa = 1e6;
    about.specimen.contact.punch_radius_m = 2e-3;
    const auto path = fuzz_folder() / "whole.viscap";
    CaptureWriter writer(path, about);
    for (int i = 0; i < 300; ++i) writer.append(LoadSample{.index = i, .counts = 1.0 * i});
    writer.append(RawBytes{Device::kStage, false, 0.0, std::string(9000, 'x')});
    writer.append(StageReport{0.0, 0.0, "Idle"});
    writer.append(RunEvent{0.0, "phase", "hold", "text"});
    writer.finish("finished");
    return read_file(path);
  }();
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 2 == 0) {
    bytes = whole_capture();
    for (std::size_t i = 1; i + 2 < size; i += 3) {
      const std::size_t place = (data[i] << 8U | data[i + 1]) % bytes.size();
      bytes[place] = static_cast<char>(data[i + 2]);
    }
    if (data[0] % 4 == 0) bytes.resize(bytes.size() * data[0] / 256);
  }
  const auto path = fuzz_folder() / "fuzz.viscap";
  write_file(path, bytes, true);
  try {
    (void)csv_from_capture(read_capture(path));
    (void)check_capture(path);
    read_raw_bytes(path, [](const RawBytes&) {});
  } catch (const std::runtime_error&) {
  }
  return 0;
}
