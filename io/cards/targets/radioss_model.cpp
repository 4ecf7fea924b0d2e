// The input of OpenRadioss' starter. Source: Radioss Reference Guide and the files that read it,
// hm_cfg_files/config/CFG: radioss2022/PROP/prop_p14_solid.cfg, radioss110/LOADS/impdisp.cfg.
#include "io/cards/targets/radioss_model.h"

#include "io/cards/column_fields.h"

#include <fmt/format.h>

namespace viscard {
namespace {

std::string brick_rows(const RadiossModel& model) {
  std::string out = "/NODE\n";
  for (int node = 1; node <= 8; ++node) {
    out += right(std::to_string(node), 10);
    for (const int x : kCubeCorners[node - 1]) out += right(x == 0 ? "0.0" : model.edge, 20);
    out += "\n";
  }
  out += "/BRICK/1\n         1";
  for (int node = 1; node <= 8; ++node) out += fmt::format("{:10d}", node);
  return out + "\n";
}

std::string radioss_boundaries(const RadiossModel& model) {
  std::string out;
  for (int face = 0; face < kFaces; ++face) {
    out += fmt::format("/GRNOD/NODE/{0}\nface {0}\n", face + 1) + face_nodes(face);
  }
  const char* codes[] = {"100", "010", "001"};
  for (int face = 0; face < 3; ++face) {
    out +=
        fmt::format("/BCS/{0}\nroller {0}\n   {1} 000         0{0:10d}\n", face + 1, codes[face]);
  }
  if (model.is_confined) {
    out += "/GRNOD/NODE/6\nsides\n";
    for (int node = 1; node <= 8; ++node) out += fmt::format("{:10d}", node);
    out += fmt::format("\n/BCS/4\nsides\n   110 000         0{:10d}\n", 6);
  }
  out += "/FUNCT/1\nramp and hold\n" + model.curve;
  return out + (model.is_creep
                    ? "/CLOAD/1\npull\n"
                      "#  funct_ID       Dir   skew_ID sensor_ID  grnod_ID            Ascale_x"
                      "            Fscale_Y\n"
                      "         1         Z         0         0         4                 1.0"
                      "                 1.0\n"
                    : "/IMPDISP/1\npull\n"
                      "#  funct_ID       Dir   skew_ID sensor_ID  grnod_ID  frame_ID\n"
                      "         1         Z         0         0         4         0\n"
                      "                 1.0                 1.0                 0.0              "
                      "1.0E30\n");
}

// Of all eight nodes. C = alpha M + beta K (engine/source/assembly/damping.F).
std::string radioss_damping(const RadiossModel& model) {
  if (model.damping == 0.0) return "";
  std::string out = "/GRNOD/NODE/5\nall\n";
  for (int node = 1; node <= 8; ++node) out += fmt::format("{:10d}", node);
  return out +
         "\n/DAMP/1\nmass\n"
         "#              alpha                beta  grnod_ID   skew_ID              Tstart"
         "               Tstop\n" +
         real(model.damping, 20) +
         "                 0.0         5         0                 0.0              1.0E30\n";
}

}  // namespace

std::string radioss_starter(const RadiossModel& model) {
  return "#RADIOSS STARTER\n/BEGIN\n" + model.name + "\n      2022         0\n" + model.units +
         model.units + model.card + brick_rows(model) +
         "/PART/1\ncube\n#  prop_ID    mat_ID subset_ID\n         1" + right(model.material, 10) +
         "         0\n"
         "/PROP/TYPE14/1\nsolid\n"
         "#   Isolid    Ismstr               Icpre  Itetra10     Inpts   Itetra4    Iframe"
         "                  dn\n"
         "        17         1                   0         0         0         0         0"
         "                 0.0\n"
         "                 1.1                0.05                 0.0                 0.0"
         "                 0.0\n"
         "                 0.0                 0.0                 0.0                 0.0"
         "                 0.0\n"
         "         0         0         0\n" +
         radioss_boundaries(model) + radioss_damping(model) +
         "/TH/NODE/1\nlength\nDZ\n         7         0\n/TH/BRIC/2\nstress\nSZ\n         1\n"
         "/END\n";
}

}  // namespace viscard
