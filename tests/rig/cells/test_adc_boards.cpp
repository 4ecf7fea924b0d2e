// Boards with 24-bit converters (ADS1256, ADS1232, NAU7802) that send text or binary frames.
#include "models/experiment/converter.h"
#include "rig/protocols/binary_frame.h"
#include "rig/protocols/line_columns.h"
#include "tests/rig/cells/instrument_faults.h"

#include <iostream>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

constexpr const char* kFrame = "a5 5a seq:u8 micros:u32le counts:i24be check:crc16";

// A bridge of 1 mV/N behind an ADS1232 with 5 V of excitation and a gain of 128.
EmulatedRigOptions board(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options("grbl", driver);
  options.truth.surface_position_m = 0.1e-3;
  options.config.calibration.volts_per_newton = 1e-3;
  LoadCellConfig& cell = options.config.load_cell;
  cell.converter = "ads1232";
  cell.gain = 128.0;
  cell.reference_V = 5.0;
  cell.volts_per_count = volts_per_count_of(cell);
  cell.line_format = "auto";
  cell.frame = kFrame;
  options.amplifier.format = AmplifierFormat::kCounts;
  options.keeps_lines = true;
  return options;
}

// The volts of every frame that was sent.
std::vector<double> volts_sent(DeviceFixture& rig) {
  const FrameFormat format(rig.config.load_cell.frame);
  std::vector<double> volts;
  for (const std::string& bytes : rig.emulated.sent_lines()) {
    if (const auto frame = format.parse(bytes)) {
      volts.push_back(frame->counts * rig.config.load_cell.volts_per_count);
    }
  }
  return volts;
}

}  // namespace

TEST_CASE("the volts of a count follow from converter, gain and reference", "[rig]") {
  LoadCellConfig cell;
  const auto volts = [&](const char* name, double gain, double reference_V) {
    cell.converter = name;
    cell.gain = gain;
    cell.reference_V = reference_V;
    return volts_per_count_of(cell);
  };
  // Full scale by the data sheets: +-2 V_ref/gain, +-0.5 V_ref/gain, and 20 mV for the HX711 at 5 V.
  CHECK(8388607.0 * volts("ads1256", 1.0, 2.5) == Approx(5.0).epsilon(1e-14));
  CHECK(8388607.0 * volts("ads1256", 64.0, 2.5) == Approx(5.0 / 64.0).epsilon(1e-14));
  CHECK(8388607.0 * volts("ads1232", 128.0, 5.0) == Approx(2.5 / 128.0).epsilon(1e-14));
  CHECK(8388608.0 * volts("nau7802", 128.0, 3.0) == Approx(1.5 / 128.0).epsilon(1e-14));
  CHECK(8388608.0 * volts("hx711", 128.0, 5.12) == Approx(20e-3).epsilon(1e-14));
  CHECK_THROWS_WITH(volts("ads1232", 16.0, 5.0), Contains("gain of 1, 2, 64, 128"));
  CHECK_THROWS_WITH(volts("ads1115", 1.0, 5.0), Contains("ads1256, ads1232, nau7802"));
  CHECK_THROWS_WITH(volts("nau7802", 128.0, 0.0), Contains("0.1 to 6 V"));
}

TEST_CASE("lines that published libraries print are read", "[rig]") {
  // SparkFun_Qwiic_Scale_NAU7802, Adafruit_NAU7802, adienakhmad/ADS1256.
  CHECK(*parse_hx711_line("Reading: 43122", false)->value == 43122.0);
  CHECK(*parse_hx711_line("Read -43122", false)->value == -43122.0);
  CHECK(*parse_hx711_line("0.0012345678", false)->value == 0.0012345678);
  CHECK(is_hx711_fault("Scale not detected. Please check wiring. Freezing..."));
  CHECK(is_hx711_fault("Failed to find NAU7802"));
  for (const char* line : {"Found NAU7802", "Gain set to 128", "LDO voltage set to 3.0V",
                           "Calibrated internal offset", "Qwiic Scale Example"}) {
    CAPTURE(line);
    CHECK_FALSE(parse_hx711_line(line, false).has_value());
    CHECK_FALSE(is_hx711_fault(line));
  }
}

TEST_CASE("of a line with several columns the named ones are read", "[rig]") {
  const auto picked = [](const char* word, const char* line) {
    return picked_columns(line, *line_columns_from_word(word)).value_or("none");
  };
  CHECK(picked("-,counts", "1001,2002") == "2002");
  CHECK(picked("-,counts", "1001      2002      3003") == "2002");
  CHECK(picked("counts,-", "1001\t2002") == "1001");
  CHECK(picked("micros,-,counts", "123456;7;2002") == "123456,2002");
  CHECK(picked("counts,micros", "2002,123456") == "123456,2002");
  CHECK(picked("-,volts", "channels: 0.5, 0.25") == "0.25");
  CHECK(picked("-,counts", "1001") == "none");
  CHECK(line_columns_from_word("counts,micros")->format == Hx711Format::kMicrosCounts);
  for (const char* word : {"", "auto", "-", "counts,counts", "counts,weight", "micros,volts"}) {
    CAPTURE(word);
    CHECK_FALSE(line_columns_from_word(word).has_value());
  }
}

TEST_CASE("a frame is described by its fields, and a description that is wrong is refused",
          "[rig]") {
  const FrameFormat format(kFrame);
  CHECK(format.size() == 12);
  const std::string bytes = format.bytes_of({.counts = -2.0, .seq = 255, .ticks = 66051.0});
  CHECK(bytes.substr(0, 10) == std::string("\xa5\x5a\xff\x03\x02\x01\0\xff\xff\xfe", 10));
  const auto frame = format.parse(bytes);
  REQUIRE(frame.has_value());
  CHECK(frame->counts == -2.0);
  CHECK(*frame->seq == 255);
  CHECK(*frame->ticks == 66051.0);
  CHECK(format.seq_step(255, 0) == 1);
  CHECK(format.highest() == 8388607.0);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string garbled = bytes;
    garbled[i] = static_cast<char>(garbled[i] ^ 4);
    CHECK_FALSE(format.parse(garbled).has_value());
  }
  // Published check values for "123456789": CRC-16/CCITT-FALSE 0x29B1, CRC-16/MODBUS 0x4B37 and
  // CRC-8/SMBUS 0xF4 (catalogue of parametrised CRC algorithms, G. Cook).
  const std::string nine = "31 32 33 34 35 36 37 counts:i16be ";
  const double counts = 0x3839;
  CHECK(FrameFormat(nine + "check:crc16").bytes_of({counts, {}, {}}).substr(9) == "\x29\xb1");
  CHECK(FrameFormat(nine + "check:crc16-modbus").bytes_of({counts, {}, {}}).substr(9) ==
        "\x37\x4b");
  CHECK(FrameFormat(nine + "check:crc8").bytes_of({counts, {}, {}}).substr(9) == "\xf4");
  CHECK(FrameFormat("a0 seq:u8 counts:i24be skip:27 c0").size() == 33);  // OpenBCI Cyton
  const auto refused = [](const std::string& text) {
    try {
      const FrameFormat made(text);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refused(""), Contains("must begin with a byte"));
  CHECK_THAT(refused("counts:i24be a5"), Contains("must begin with a byte"));
  CHECK_THAT(refused("a5 5a seq:u8"), Contains("needs one field counts"));
  CHECK_THAT(refused("a5 counts:i24be"), Contains("neither a check nor a second byte"));
  CHECK_THAT(refused("a5 counts:i24 check:crc16"), Contains("the order of its bytes"));
  CHECK_THAT(refused("a5 counts:u24be check:crc16"), Contains("counts:u24be"));
  CHECK_THAT(refused("a5 counts:i24be check:md5"), Contains("choose sum8"));
  CHECK_THAT(refused("a5 weight:i24be check:sum8"), Contains("'weight:i24be'"));
}

TEST_CASE("frames are found however reads split them, and bytes between them are kept apart",
          "[rig]") {
  const std::string description =
      GENERATE(std::string(kFrame), std::string("a0 seq:u8 counts:i24be skip:3 c0"));
  const FrameFormat format(description);
  std::string stream = "ADS1256 ready\r\n";
  for (int i = 0; i < 20; ++i) {
    if (i == 8) stream += std::string("\xa5\xa0\x00\xff", 4);
    stream += format.bytes_of({1000.0 + i, static_cast<std::uint32_t>(i), {}});
  }
  const std::size_t piece = GENERATE(1, 5, 1000);
  FrameSplitter splitter(format);
  std::vector<double> counts;
  std::string skipped;
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    splitter.feed(std::string_view(stream).substr(at, piece), 0.01 * static_cast<double>(at), 0.0);
    while (const auto frame = splitter.next()) {
      counts.push_back(frame->frame.counts);
      skipped += frame->skipped;
    }
  }
  REQUIRE(counts.size() == 20);
  for (int i = 0; i < 20; ++i) CHECK(counts[static_cast<std::size_t>(i)] == 1000.0 + i);
  CHECK(skipped == "ADS1256 ready\r\n" + std::string("\xa5\xa0\x00\xff", 4));
}

TEST_CASE("a whole test runs on boards that send text or frames", "[rig][pty]") {
  const std::string kind = GENERATE("plain", "named", "columns", "frames", "frames without clock");
  const bool is_binary = kind.rfind("frames", 0) == 0;
  EmulatedRigOptions options = board(is_binary ? "adc-frames" : "adc");
  if (kind == "named") options.amplifier.before = "Read ";
  if (kind == "columns") {
    options.amplifier.before = "77,";
    options.config.load_cell.line_format = "-,counts";
  }
  if (kind == "frames without clock") {
    options.config.load_cell.frame = "a0 seq:u8 counts:i24be skip:27 c0";
  }
  DeviceFixture rig(options);
  const RunOutcome outcome = rig.run(shortest_test());
  INFO(kind << ": " << outcome.reason);
  REQUIRE(outcome.status == "finished");
  const EmulatedOutcome bench = rig.emulated.outcome();
  CHECK(bench.peak_depth_m == Approx(0.13e-3).margin(8e-6));
  CHECK(outcome.peak_force_N == Approx(bench.peak_force_N).margin(5e-3));
  CHECK(outcome.stream.missing == 0);
  CHECK(outcome.stream.unreadable == 0);
  CHECK(outcome.doubts.empty());
  CHECK(rig.all<LoadSample>().back().counts.has_value());
  CHECK(rig.all<LoadSample>().back().device_time_s.has_value() == (kind == "frames"));
}

TEST_CASE("frames that are lost are counted, and other bytes are no frames", "[rig][pty]") {
  EmulatedRigOptions options = board("adc-frames");
  LineFaults faults;
  faults.cell.seed = 3;
  faults.cell.to_host.drop = 0.01;
  SECTION("by their numbers") {
    options.config.load_cell.frame = "a5 5a seq:u16le counts:i32le check:crc16-modbus";
  }
  SECTION("by the clock") {}
  DeviceFixture rig(options, faults);
  rig.devices.load_cell->connect(rig.pump());
  rig.pump_for(20.0);
  const StreamCounts& counts = rig.devices.load_cell->counts();
  CHECK(counts.missing > 3);
  CHECK(counts.unreadable > 3);
  CHECK(static_cast<double>(counts.expected()) == Approx(1600.0).margin(12.0));
  DeviceFixture wrong(board("adc"));  // it sends text
  RigConfig config = wrong.config;
  config.load_cell.driver = "adc-frames";
  const auto cell = make_load_cell(*wrong.devices.cell_line, config.load_cell, wrong.clock,
                                   [](const RunRecord&) {});
  CHECK_THROWS_WITH(cell->connect([&] {
    wait_readable({wrong.devices.cell_line.get()}, wrong.clock, 0.01);
    cell->service();
  }),
                    Contains("no frame of 'a5 5a"));
}

TEST_CASE("12 runs of a board with checked frames over disturbed lines have no wrong reading",
          "[rig][pty][faults]") {
  FaultTally tally;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    run_disturbed(board("adc-frames"), seed, volts_sent, tally);
  }
  std::cout << "12 runs of checked frames over disturbed lines, " << tally.faults
            << " faults: " << tally.finished << " finished, " << tally.ended
            << " ended with a reason, " << tally.refused << " refused to start; of "
            << tally.readings << " readings " << tally.wrong << " were wrong and not marked\n";
  CHECK(tally.wrong == 0);
  CHECK(tally.faults > 12);
  CHECK(tally.finished > 3);
}

}  // namespace viscard
