// The one-element model of COMSOL: the Java calls are those of published exported model files, and
// COMSOL has not run it here.
#include "io/cards/targets/comsol_deck.h"

#include <fmt/format.h>

namespace viscard {
namespace {

// The parameter names of a branch number, as a Java array: {prefix + "_G1", prefix + "_G2"}.
std::string java_names(const char* array, const char* number, std::size_t branches,
                       const char* factor) {
  std::string out = std::string("    String[] ") + array + " = {";
  for (std::size_t i = 1; i <= branches; ++i) {
    out += fmt::format("{}prefix + \"_{}{}{}\"", i == 1 ? "" : ", ", number, i, factor);
  }
  return out + "};\n";
}

// The shift factor as a parameter of the temperature, which the model holds at the reference: the
// published files show the property shiftFunction of Viscoelasticity, but not the names of all its
// constants. Temperatures are absolute: COMSOL converts [degC].
std::string java_shift(const TemperatureShift& shift) {
  const char* factor =
      shift.law == ShiftLaw::kWlf
          ? "\"10^(-\" + prefix + \"_C1*(temperature-\" + prefix + \"_Tref)/(\" + prefix + "
            "\"_C2+temperature-\" + prefix + \"_Tref))\""
          : "\"exp(\" + prefix + \"_Q/R_const*(1/temperature-1/\" + prefix + \"_Tref))\"";
  return fmt::format(
      "    // In a model with a temperature field use Viscoelasticity > Shift function: {}\n"
      "    model.param().set(\"temperature\", prefix + \"_Tref\");\n"
      "    model.param().set(\"aT\", {});\n",
      shift.law == ShiftLaw::kWlf ? "Williams-Landel-Ferry" : "Arrhenius", factor);
}

// Calls before the load: parameters, block, material, rollers.
constexpr const char* kSetup = R"java(    Model model = ModelUtil.create("Model");
    model.param().loadFile("card.txt");
    model.param().set("amplitude", "{}");
    model.param().set("rise", "{}[s]");
    model.param().set("E0", "{}[Pa]");
{}    model.component().create("comp1", true);
    model.component("comp1").geom().create("geom1", 3);
    model.component("comp1").geom("geom1").create("blk1", "Block");
    model.component("comp1").geom("geom1").run();
    model.component("comp1").mesh().create("mesh1");
    model.component("comp1").physics().create("solid", "SolidMechanics", "geom1");
    PhysicsFeature elastic = model.component("comp1").physics("solid").feature("lemm1");
    elastic.set("E_mat", "userdef");
    elastic.set("E", prefix + "_Einf");
    elastic.set("nu_mat", "userdef");
    elastic.set("nu", prefix + "_nuinf");
{}    elastic.create("vis1", "Viscoelasticity", 3);
    elastic.feature("vis1").set("Gvm", moduli);
    elastic.feature("vis1").set("tauvm", times);
    model.component("comp1").physics("solid").create("roll1", "Roller", 2);
    model.component("comp1").physics("solid").feature("roll1").selection().set(1, 2, 3);
)java";

constexpr const char* kForce =
    R"java(    model.component("comp1").physics("solid").create("pull", "BoundaryLoad", 2);
    model.component("comp1").physics("solid").feature("pull").set("FperArea", new String[]{"0", "0", "amplitude*E0*min(t/rise,1)"});
)java";
constexpr const char* kDisplacement =
    R"java(    model.component("comp1").physics("solid").create("pull", "Displacement2", 2);
    model.component("comp1").physics("solid").feature("pull").set("Direction", new String[]{"free", "free", "prescribed"});
    model.component("comp1").physics("solid").feature("pull").set("U0", new String[]{"0", "0", "amplitude*min(t/rise,1)*1[m]"});
)java";

// A block's faces are numbered x = 0, y = 0, z = 0, z = 1, y = 1, x = 1.
constexpr const char* kStudy =
    R"java(    model.component("comp1").physics("solid").feature("pull").selection().set(4);
    model.component("comp1").physics("solid").prop("StructuralTransientBehavior").set("StructuralTransientBehavior", "Quasistatic");
    model.study().create("std1");
    model.study("std1").create("time", "Transient");
    model.study("std1").feature("time").set("tlist", "{}");
    model.study("std1").feature("time").set("usertol", true);
    model.study("std1").feature("time").set("rtol", "1e-6");
    model.study("std1").run();
    // compare {} with the expected curve
    return model;
  }}

  public static void main(String[] args) {{
    run();
  }}
}}
)java";

}  // namespace

std::vector<DeckFile> comsol_deck(const DeckInput& input, const std::string& name) {
  const Material& written = input.card.written;
  std::string times = "0";
  for (const TimeBlock& part : input.test.blocks) times += fmt::format(" {}", part.end_s);
  std::string out = fmt::format(
      "import com.comsol.model.*;\nimport com.comsol.model.util.*;\n\npublic class {} {{\n"
      "  public static Model run() {{\n    String prefix = \"{}\";\n",
      name, input.card.name);
  out += java_names("moduli", "G", written.terms.size(), "");
  out += java_names("times", "tau", written.terms.size(), written.shift ? "*aT" : "");
  const char* density =
      "    elastic.set(\"rho_mat\", \"userdef\");\n    elastic.set(\"rho\", prefix + \"_rho\");\n";
  out += fmt::format(kSetup, input.test.amplitude, input.test.ramp_s, written.E0_Pa,
                     written.shift ? java_shift(*written.shift) : "",
                     written.rho_kg_m3 > 0.0 ? density : "");
  out += input.is_creep() ? kForce : kDisplacement;
  out += fmt::format(
      kStudy, times,
      input.is_creep() ? "w/(amplitude*1[m]) of the face z = 1" : "solid.sz/(amplitude*E0)");
  return {{name + ".java", out}, {"card.txt", input.card.text}};
}

}  // namespace viscard
