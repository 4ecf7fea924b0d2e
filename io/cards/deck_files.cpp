// One-element models in the dialects of deck.h. All are unit cubes from the origin with their lower
// faces on rollers, pulled in z.
#include "io/cards/calculix_deck.h"
#include "io/cards/card_lines.h"
#include "io/cards/deck.h"
#include "io/cards/number_text.h"

#include <fmt/format.h>

namespace viscard {
namespace {

bool is_creep(const DeckInput& input) {
  return input.test.kind == ElementTestKind::kCreep;
}

std::string number(double value) {
  return number_within(value, 20);
}

constexpr const char* kKeywordMesh =
    "*NODE, NSET=NALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n"
    "5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n"
    "*NSET, NSET=BASE\n1, 2, 3, 4\n*NSET, NSET=TOP\n5, 6, 7, 8\n";

}  // namespace

double in_card_time(const DeckInput& input, double time_s) {
  return to_card(time_s, input.units.time_exponent);
}

std::string abaqus_deck(const DeckInput& input) {
  const std::vector<std::string> names = material_names(input.card.text);
  std::string out = kKeywordMesh;
  out += "*ELEMENT, TYPE=C3D8H, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n" + input.card.text;
  out += "*SOLID SECTION, ELSET=E, MATERIAL=" + (names.empty() ? "" : names[0]) + "\n,\n";
  out += "*BOUNDARY\nBASE, 3, 3\n1, 1, 2\n4, 1, 1\n5, 1, 2\n8, 1, 1\n2, 2, 2\n6, 2, 2\n";
  out += fmt::format("*AMPLITUDE, NAME=RAMP, TIME=TOTAL TIME\n0., 0., {}, 1.\n{}, 1.\n",
                     number(in_card_time(input, input.test.ramp_s)),
                     number(2.0 * in_card_time(input, input.test.end_s())));
  double from_s = 0.0;
  for (const TimeBlock& block : input.test.blocks) {
    const double length = in_card_time(input, block.end_s - from_s);
    out += fmt::format("*STEP, INC=1000000\n*VISCO\n{0}, {1}, {0}, {0}\n",
                       number(length / block.increments), number(length));
    if (is_creep(input)) {
      out += "*CLOAD, AMPLITUDE=RAMP\nTOP, 3, " + number(0.25 * input.stress) + "\n";
      out += "*NODE PRINT, NSET=TOP\nU3\n";
    } else {
      out += "*BOUNDARY, AMPLITUDE=RAMP\nTOP, 3, 3, " + number(input.test.amplitude) + "\n";
      out += "*NODE PRINT, NSET=BASE, TOTALS=YES\nRF3\n";
    }
    out += "*END STEP\n";
    from_s = block.end_s;
  }
  return out;
}

std::string ansys_deck(const DeckInput& input) {
  std::string out = "/PREP7\nET,1,SOLID185\nKEYOPT,1,6,1\n" + input.card.text;
  out +=
      "BLOCK,0,1,0,1,0,1\nESIZE,1\nVMESH,1\nNSEL,S,LOC,X,0\nD,ALL,UX,0\nNSEL,S,LOC,Y,0\n"
      "D,ALL,UY,0\nNSEL,S,LOC,Z,0\nD,ALL,UZ,0\nALLSEL\nFINISH\n/SOLU\nANTYPE,STATIC\n"
      "NLGEOM,OFF\nKBC,0\nOUTRES,ALL,ALL\nNSEL,S,LOC,Z,1\n";
  out += is_creep(input) ? "F,ALL,FZ," + number(0.25 * input.stress) + "\n"
                         : "D,ALL,UZ," + number(input.test.amplitude) + "\n";
  out += "ALLSEL\n";
  for (const TimeBlock& block : input.test.blocks) {
    out +=
        fmt::format("TIME,{}\nNSUBST,{},{},{}\nSOLVE\n", number(in_card_time(input, block.end_s)),
                    block.increments, block.increments, block.increments);
  }
  out += "FINISH\n/POST26\n";
  out += is_creep(input) ? "NSOL,2,NODE(1,1,1),U,Z,UZ\nPRVAR,2\n"
                         : "NSEL,S,LOC,Z,0\n! the sum of the FZ of these nodes is the force\n"
                           "RFORCE,2,NODE(0,0,0),F,Z,FZ\nPRVAR,2\n";
  return out + "FINISH\n";
}

// FEBio 4 format specification: every <Step> has its own <Control>, steps follow each other.
std::string febio_deck(const DeckInput& input) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n"
      "<Module type=\"solid\"/>\n<Material>\n" +
      input.card.text + "</Material>\n";
  std::string name = "MATERIAL";
  const std::size_t at = input.card.text.find("name=\"");
  if (at != std::string::npos) {
    name = input.card.text.substr(at + 6, input.card.text.find('"', at + 6) - at - 6);
  }
  out += "<Mesh>\n<Nodes name=\"nodes\">\n";
  const char* corners[] = {"0,0,0", "1,0,0", "1,1,0", "0,1,0", "0,0,1", "1,0,1", "1,1,1", "0,1,1"};
  for (int i = 0; i < 8; ++i) out += fmt::format("<node id=\"{}\">{}</node>\n", i + 1, corners[i]);
  out +=
      "</Nodes>\n<Elements type=\"hex8\" name=\"cube\"><elem id=\"1\">1,2,3,4,5,6,7,8</elem>"
      "</Elements>\n<NodeSet name=\"x0\">1,4,5,8</NodeSet>\n<NodeSet "
      "name=\"y0\">1,2,5,6</NodeSet>\n"
      "<NodeSet name=\"z0\">1,2,3,4</NodeSet>\n<NodeSet name=\"z1\">5,6,7,8</NodeSet>\n</Mesh>\n"
      "<MeshDomains><SolidDomain name=\"cube\" mat=\"" +
      name + "\"/></MeshDomains>\n<Boundary>\n";
  for (const char axis : {'x', 'y', 'z'}) {
    out += fmt::format(
        "<bc name=\"fix {0}\" node_set=\"{0}0\" type=\"zero displacement\">"
        "<x_dof>{1}</x_dof><y_dof>{2}</y_dof><z_dof>{3}</z_dof></bc>\n",
        axis, axis == 'x' ? 1 : 0, axis == 'y' ? 1 : 0, axis == 'z' ? 1 : 0);
  }
  if (is_creep(input)) {
    out +=
        "</Boundary>\n<Loads>\n<nodal_load name=\"pull\" node_set=\"z1\" type=\"nodal_load\">"
        "<dof>z</dof><scale lc=\"1\">" +
        shortest_number(0.25 * input.stress) + "</scale></nodal_load>\n</Loads>\n";
  } else {
    out +=
        "<bc name=\"pull\" node_set=\"z1\" type=\"prescribed displacement\"><dof>z</dof>"
        "<value lc=\"1\">" +
        shortest_number(input.test.amplitude) +
        "</value><relative>0</relative></bc>\n</Boundary>\n";
  }
  out += fmt::format(
      "<LoadData><load_controller id=\"1\" type=\"loadcurve\">"
      "<interpolate>LINEAR</interpolate><extend>CONSTANT</extend>"
      "<points><pt>0,0</pt><pt>{},1</pt><pt>{},1</pt></points></load_controller>"
      "</LoadData>\n<Step>\n",
      shortest_number(in_card_time(input, input.test.ramp_s)),
      shortest_number(2.0 * in_card_time(input, input.test.end_s())));
  double from_s = 0.0;
  int id = 0;
  for (const TimeBlock& block : input.test.blocks) {
    const double size = in_card_time(input, block.end_s - from_s) / block.increments;
    out += fmt::format(
        "<step id=\"{0}\" name=\"block {0}\"><Control><analysis>STATIC</analysis>"
        "<time_steps>{1}</time_steps><step_size>{2}</step_size>"
        "<solver type=\"solid\"><dtol>1e-9</dtol><etol>1e-12</etol><rtol>0</rtol>"
        "</solver></Control></step>\n",
        ++id, block.increments, shortest_number(size));
    from_s = block.end_s;
  }
  out += "</Step>\n<Output><logfile>";
  out += is_creep(input) ? "<node_data data=\"uz\" file=\"uz.txt\">7</node_data>"
                         : "<element_data data=\"sz\" file=\"sz.txt\">1</element_data>";
  return out + "</logfile></Output>\n</febio_spec>\n";
}

// MTest drives one material point; the behaviour needs no material property.
std::string mtest_deck(const DeckInput& input) {
  std::string name = "MATERIAL";
  const std::size_t at = input.card.text.find("@Behaviour ");
  if (at != std::string::npos) {
    name = input.card.text.substr(at + 11, input.card.text.find(';', at) - at - 11);
  }
  std::string out =
      "@ModellingHypothesis 'Tridimensional';\n"
      "@Behaviour<generic> 'src/libBehaviour.so' '" +
      name +
      "';\n"
      "@ExternalStateVariable 'Temperature' 293.15;\n";
  const double amplitude = is_creep(input) ? input.stress : input.test.amplitude;
  out += fmt::format(
      "@Imposed{} {{0. : 0., {} : {}, {} : {}}};\n",
      is_creep(input) ? "Stress<evolution> 'SZZ'" : "Strain<evolution> 'EZZ'",
      shortest_number(in_card_time(input, input.test.ramp_s)), shortest_number(amplitude),
      shortest_number(2.0 * in_card_time(input, input.test.end_s())), shortest_number(amplitude));
  out += fmt::format("@StrainEpsilon {};\n@StressEpsilon {};\n",
                     shortest_number(1e-11 * input.test.amplitude),
                     shortest_number(1e-11 * input.stress));
  out += "@Times {0.";
  for (const TimeBlock& block : input.test.blocks) {
    out += fmt::format(", {} in {}", shortest_number(in_card_time(input, block.end_s)),
                       block.increments);
  }
  return out + "};\n";
}

std::string frontistr_mesh() {
  std::string out = "!HEADER\n one element\n!NODE\n";
  const char* corners[] = {"0., 0., 0.", "1., 0., 0.", "1., 1., 0.", "0., 1., 0.",
                           "0., 0., 1.", "1., 0., 1.", "1., 1., 1.", "0., 1., 1."};
  for (int i = 0; i < 8; ++i) out += fmt::format(" {}, {}\n", i + 1, corners[i]);
  return out +
         "!ELEMENT, TYPE=361, EGRP=E\n 1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "!SECTION, TYPE=SOLID, EGRP=E, MATERIAL=M\n!MATERIAL, NAME=M, ITEM=1\n!ITEM=1, SUBITEM=2\n"
         " 1.0, 0.3\n!NGROUP, NGRP=X0\n 1, 4, 5, 8\n!NGROUP, NGRP=Y0\n 1, 2, 5, 6\n"
         "!NGROUP, NGRP=Z0\n 1, 2, 3, 4\n!NGROUP, NGRP=Z1\n 5, 6, 7, 8\n!END\n";
}

std::string frontistr_control(const DeckInput& input) {
  std::string card = input.card.text;
  // The name of the section's material in the mesh.
  const std::size_t at = card.find("!MATERIAL, NAME=");
  if (at != std::string::npos) card.replace(at, card.find('\n', at) - at, "!MATERIAL, NAME=M");
  std::string out = "!VERSION\n 3\n!SOLUTION, TYPE=NLSTATIC\n!WRITE, RESULT\n" + card;
  const double amplitude = is_creep(input) ? 0.25 * input.stress : input.test.amplitude;
  out += "!AMPLITUDE, NAME=RAMP, VALUE=RELATIVE\n";
  out += fmt::format(" 0.0, 0.0, 1.0, {}, 1.0, {}\n",
                     shortest_number(in_card_time(input, input.test.ramp_s)),
                     shortest_number(2.0 * in_card_time(input, input.test.end_s())));
  out += "!BOUNDARY, GRPID=1\n X0, 1, 1, 0.0\n Y0, 2, 2, 0.0\n Z0, 3, 3, 0.0\n";
  out += is_creep(input)
             ? "!CLOAD, GRPID=1, AMP=RAMP\n Z1, 3, " + shortest_number(amplitude) + "\n"
             : "!BOUNDARY, GRPID=1, AMP=RAMP\n Z1, 3, 3, " + shortest_number(amplitude) + "\n";
  double from_s = 0.0;
  for (const TimeBlock& block : input.test.blocks) {
    const double length = in_card_time(input, block.end_s - from_s);
    out += fmt::format("!STEP, TYPE=VISCO, CONVERG=1.0E-10\n {}, {}\n BOUNDARY, 1\n{}",
                       shortest_number(length / block.increments), shortest_number(length),
                       is_creep(input) ? " LOAD, 1\n" : "");
    from_s = block.end_s;
  }
  return out + "!SOLVER, METHOD=DIRECT\n 10000, 1\n 1.0E-12, 1.0, 0.0\n!END\n";
}

}  // namespace viscard
