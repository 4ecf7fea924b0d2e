// Files of a capture that are cut or deleted while the run writes them.
#include "io/capture/capture_file.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

namespace viscard {
namespace {

namespace fs = std::filesystem;

using test::contains;
using test::demo_run;
using test::error_text;
using test::sample;
using test::ScratchFolder;

struct Harm {
  const char* what;
  std::function<void(const fs::path& file, const fs::path& log)> change;
};

const std::vector<Harm>& harms() {
  static const std::vector<Harm> all{
      {"run.viscap was cut from ",
       [](const fs::path& file, const fs::path&) { fs::resize_file(file, 0); }},
      {"run.viscap was cut from ",
       [](const fs::path& file, const fs::path&) { fs::resize_file(file, 8192); }},
      {"run.viscap-wal was cut from ",
       [](const fs::path&, const fs::path& log) { fs::resize_file(log, 0); }},
      {"run.viscap-wal was cut from ",
       [](const fs::path&, const fs::path& log) { fs::resize_file(log, 8192); }},
      {"run.viscap-wal was deleted", [](const fs::path&, const fs::path& log) { fs::remove(log); }},
      {"run.viscap-wal was replaced", [](const fs::path&, const fs::path& log) {
         fs::copy_file(log, log.string() + ".copy");
         fs::rename(log.string() + ".copy", log);
       }}};
  return all;
}

// The first error of append() after some time, or that of finish().
std::string error_of_rest(CaptureWriter& writer, bool appends) {
  for (int i = 100; appends && i < 1000; ++i) {
    const std::string error = error_text([&] { writer.append(sample(i)); });
    if (!error.empty()) return error;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return error_text([&] { writer.finish("finished"); });
}

TEST_CASE("a capture whose files are cut or deleted during its run does not end as finished",
          "[io][capture]") {
  const std::size_t number = GENERATE(range(0, 6));
  const bool appends = GENERATE(true, false);
  const Harm& harm = harms().at(number);
  const ScratchFolder folder;
  const fs::path file = folder / "run.viscap", log = folder / "run.viscap-wal";
  CaptureWriter writer(file, demo_run());
  for (int i = 0; i < 100; ++i) writer.append(sample(i));
  writer.sync();
  harm.change(file, log);
  const std::string error = error_of_rest(writer, appends);
  CAPTURE(error);
  CHECK(contains(error, harm.what));
  CHECK(contains(error, "while the run was writing it; the capture stops here"));
  CHECK_FALSE(error_text([&] { writer.finish("finished"); }).empty());
  std::string status = "refused";
  (void)error_text([&] { status = read_capture(file, {.accepts_damage = true}).status; });
  CHECK(status != "finished");
}

TEST_CASE("what was recorded before its log was deleted is merged into the capture",
          "[io][capture]") {
  const ScratchFolder folder;
  const fs::path file = folder / "run.viscap";
  {
    CaptureWriter writer(file, demo_run());
    for (int i = 0; i < 100; ++i) writer.append(sample(i));
    writer.sync();
    fs::remove(folder / "run.viscap-wal");
    CHECK_FALSE(error_text([&] { writer.finish("finished"); }).empty());
  }
  CHECK(read_capture(file).load_samples.size() == 100);
}

TEST_CASE("a hole in the log that its size does not show is noticed at the end of the run",
          "[io][capture]") {
  const ScratchFolder folder;
  const fs::path file = folder / "run.viscap";
  CaptureWriter writer(file, demo_run());
  for (int i = 0; i < 100; ++i) {
    writer.append(sample(i));
    if (i % 20 == 19) writer.sync();
  }
  {
    std::fstream log(folder / "run.viscap-wal", std::ios::in | std::ios::out | std::ios::binary);
    log.seekp(32 + 24 + 4096);  // the second frame
    log << std::string(24 + 4096, '\0');
  }
  CHECK(contains(error_text([&] { writer.finish("finished"); }), "run.viscap-wal was changed"));
  CHECK(contains(error_text([&] { read_capture(file); }), "is damaged"));
}

TEST_CASE("a run whose log is begun anew many times ends as finished", "[io][capture]") {
  const ScratchFolder folder;
  const fs::path file = folder / "run.viscap";
  CaptureWriter writer(file, demo_run());
  // Each thousand pages SQLite merges the log.
  for (int i = 0; i < 5000; ++i) {
    writer.append(RawBytes{Device::kLoadCell, false, 0.001 * i, std::string(4000, 'x')});
    if (i % 100 == 99) writer.sync();
  }
  CHECK_NOTHROW(writer.finish("finished"));
  CHECK(read_capture(file).status == "finished");
}

}  // namespace
}  // namespace viscard
