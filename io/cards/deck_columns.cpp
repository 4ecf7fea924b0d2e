// One-element models of the fixed-column dialects. Field orders: LS-DYNA Keyword User's Manual,
// vol. I (*CONTROL_IMPLICIT_*, *BOUNDARY_*, *DEFINE_CURVE); Radioss Reference Guide (/PROP/TYPE14,
// /IMPDISP, /CLOAD, /TH). Neither solver has run them here.
#include "io/cards/deck.h"
#include "io/cards/number_text.h"

#include <fmt/format.h>

namespace viscard {
namespace {

bool is_creep(const DeckInput& input) {
  return input.test.kind == ElementTestKind::kCreep;
}

// The corners of the unit cube, bottom counter-clockwise, then top.
constexpr int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
// Nodes on the faces x = 0, y = 0, z = 0, which slide on rollers, and on z = 1, which is pulled.
constexpr int kFaces[4][4] = {{1, 4, 5, 8}, {1, 2, 5, 6}, {1, 2, 3, 4}, {5, 6, 7, 8}};

std::string real(double value, int width) {
  return fmt::format("{:>{}}", nearest_number(value, width - 1), width);
}

std::string face_nodes(int face) {
  std::string out;
  for (const int node : kFaces[face]) out += fmt::format("{:10d}", node);
  return out + "\n";
}

// Linear rise to `top` at the end of the ramp, then constant.
std::string ramp_points(const DeckInput& input, double top) {
  const double ramp = in_card_time(input, input.test.ramp_s);
  const double end = 2.0 * in_card_time(input, input.test.end_s());
  std::string out;
  for (const auto& [time, value] : {std::pair{0.0, 0.0}, std::pair{ramp, top}, std::pair{end, top}})
    out += real(time, 20) + real(value, 20) + "\n";
  return out;
}

// Size of the increment against time: two points per block, a step between blocks.
std::string increment_points(const DeckInput& input) {
  std::string out;
  double from_s = 0.0;
  for (const TimeBlock& block : input.test.blocks) {
    const double size = in_card_time(input, (block.end_s - from_s) / block.increments);
    out += real(in_card_time(input, from_s == 0.0 ? 0.0 : from_s * (1.0 + 1e-9)), 20) +
           real(size, 20) + "\n";
    out += real(in_card_time(input, block.end_s), 20) + real(size, 20) + "\n";
    from_s = block.end_s;
  }
  return out;
}

}  // namespace

std::string lsdyna_deck(const DeckInput& input) {
  const double first =
      in_card_time(input, input.test.blocks[0].end_s) / input.test.blocks[0].increments;
  std::string out =
      "*KEYWORD\n*CONTROL_TERMINATION\n" + real(in_card_time(input, input.test.end_s()), 10) +
      "\n*CONTROL_IMPLICIT_GENERAL\n$   IMFLAG       DT0\n         1" + real(first, 10) + "\n";
  // DTMAX = -2: the increments follow curve 2.
  out +=
      "*CONTROL_IMPLICIT_AUTO\n$    IAUTO    ITEOPT    ITEWIN     DTMIN     DTMAX\n"
      "         1        11         5       0.0      -2.0\n"
      "*CONTROL_IMPLICIT_SOLUTION\n$   NSOLVR    ILIMIT    MAXREF     DCTOL     ECTOL\n"
      "        12         1        15   1.0E-10   1.0E-10\n";
  out += "*DATABASE_ELOUT\n" + real(first, 10) + "\n*DATABASE_NODOUT\n" + real(first, 10) +
         "\n*DATABASE_HISTORY_SOLID\n         1\n*DATABASE_HISTORY_NODE\n         7\n" +
         input.card.text;
  out +=
      "*SECTION_SOLID\n$    SECID    ELFORM\n         1         2\n*PART\ncube\n"
      "$      PID     SECID       MID\n         1         1         1\n*NODE\n";
  for (int node = 1; node <= 8; ++node) {
    out += fmt::format("{:8d}", node);
    for (const int x : kCorners[node - 1]) out += fmt::format("{:16.1f}", static_cast<double>(x));
    out += "\n";
  }
  out +=
      "*ELEMENT_SOLID\n       1       1       1       2       3       4       5       6       7"
      "       8\n";
  for (int face = 0; face < 4; ++face) {
    out += fmt::format("*SET_NODE_LIST\n{:10d}\n", face + 1) + face_nodes(face);
  }
  for (int face = 0; face < 3; ++face) {
    out += fmt::format("*BOUNDARY_SPC_SET\n{:10d}         0{:10d}{:10d}{:10d}\n", face + 1,
                       face == 0 ? 1 : 0, face == 1 ? 1 : 0, face == 2 ? 1 : 0);
  }
  const double top = is_creep(input) ? 0.25 * input.stress : input.test.amplitude;
  out += is_creep(input) ? "*LOAD_NODE_SET\n         4         3         1       1.0\n"
                         : "*BOUNDARY_PRESCRIBED_MOTION_SET\n"
                           "         4         3         2         1       1.0\n";
  out += "*DEFINE_CURVE\n         1\n" + ramp_points(input, top);
  return out + "*DEFINE_CURVE\n         2\n" + increment_points(input) + "*END\n";
}

// Explicit: about (end time) * (wave speed) / (edge) cycles, half a minute for a few seconds of
// PDMS on one element of a unit edge in millimetres.
std::string openradioss_starter(const DeckInput& input, const std::string& run_name) {
  const UnitSystem& units = input.units;
  const std::string unit_line =
      fmt::format("{:>20}{:>20}{:>20}\n", units.mass, units.length, units.time);
  std::string out = "#RADIOSS STARTER\n/BEGIN\n" + run_name + "\n      2022         0\n" +
                    unit_line + unit_line + input.card.text + "/NODE\n";
  for (int node = 1; node <= 8; ++node) {
    out += fmt::format("{:10d}", node);
    for (const int x : kCorners[node - 1]) out += fmt::format("{:20.1f}", static_cast<double>(x));
    out += "\n";
  }
  out += "/BRICK/1\n         1";
  for (int node = 1; node <= 8; ++node) out += fmt::format("{:10d}", node);
  out +=
      "\n/PART/1\ncube\n#  prop_ID    mat_ID subset_ID\n         1         1         0\n"
      "/PROP/TYPE14/1\nsolid\n"
      "#   Isolid    Ismstr               Icpre  Itetra10     Inpts   Itetra4    Iframe"
      "                  dn\n"
      "        17         1                   0         0         0         0         0"
      "                 0.0\n"
      "                 1.1                0.05                 0.0                 0.0"
      "                 0.0\n"
      "                 0.0                 0.0                 0.0                 0.0"
      "                 0.0\n"
      "         0         0         0\n";
  for (int face = 0; face < 4; ++face) {
    out += fmt::format("/GRNOD/NODE/{0}\nface {0}\n", face + 1) + face_nodes(face);
  }
  const char* codes[] = {"100", "010", "001"};
  for (int face = 0; face < 3; ++face) {
    out +=
        fmt::format("/BCS/{0}\nroller {0}\n   {1} 000         0{0:10d}\n", face + 1, codes[face]);
  }
  const double top = is_creep(input) ? 0.25 * input.stress : input.test.amplitude;
  out += "/FUNCT/1\nramp and hold\n" + ramp_points(input, top);
  out += is_creep(input)
             ? "/CLOAD/1\npull\n"
               "#  funct_ID       Dir   skew_ID sensor_ID  grnod_ID            Ascale_x"
               "            Fscale_Y\n"
               "         1         Z         0         0         4                 1.0"
               "                 1.0\n"
             : "/IMPDISP/1\npull\n"
               "#  funct_ID       Dir   skew_ID sensor_ID  grnod_ID  frame_ID\n"
               "         1         Z         0         0         4         0\n"
               "                 1.0                 1.0                 0.0              1.0E30\n";
  return out +
         "/TH/NODE/1\nlength\nDZ\n         7         0\n/TH/BRIC/2\nstress\nSZ\n         1\n/END\n";
}

std::string openradioss_engine(const DeckInput& input, const std::string& run_name) {
  const double end = in_card_time(input, input.test.end_s());
  return "#RADIOSS ENGINE\n/RUN/" + run_name + "/1\n" + real(end, 20) + "\n/VERS/2022\n/TFILE\n" +
         real(end / 1000.0, 20) + "\n/PRINT/-100000\n";
}

}  // namespace viscard
