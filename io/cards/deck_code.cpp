// One-element models of the dialects that read like programs. MOOSE: objects as in the solid
// mechanics module's test gen_maxwell_relax.i; COMSOL: the Java interface's calls as model files
// exported by it show them. Neither solver has run them here.
#include "io/cards/deck.h"
#include "io/cards/number_text.h"

#include <fmt/format.h>

namespace viscard {
namespace {

bool is_creep(const DeckInput& input) {
  return input.test.kind == ElementTestKind::kCreep;
}

std::string time_text(const DeckInput& input, double time_s) {
  return shortest_number(in_card_time(input, time_s));
}

// "[name]\n  key = value\n ...[]\n"
std::string block(const std::string& name, const std::string& lines) {
  return "  [" + name + "]\n" + lines + "  []\n";
}

std::string moose_displacements(std::string (*entry)(char axis)) {
  std::string out;
  for (const char axis : {'x', 'y', 'z'}) out += entry(axis);
  return out;
}

std::string moose_steps(const DeckInput& input) {
  std::string times = "0", sizes;
  double from_s = 0.0;
  for (const TimeBlock& part : input.test.blocks) {
    const std::string size = time_text(input, (part.end_s - from_s) / part.increments);
    // The size in force at the start of a step decides: constant up to just before the next block.
    sizes += (sizes.empty() ? "" : " ") + size + " " + size;
    times += " " + time_text(input, part.end_s * (1.0 - 1e-9));
    if (&part != &input.test.blocks.back()) {
      times += " " + time_text(input, part.end_s * (1.0 - 0.5e-9));
    }
    from_s = part.end_s;
  }
  return "    type = PiecewiseLinear\n    x = '" + times + "'\n    y = '" + sizes + "'\n";
}

}  // namespace

std::string moose_deck(const DeckInput& input) {
  std::string out =
      "[Mesh]\n  type = GeneratedMesh\n  dim = 3\n  nx = 1\n  ny = 1\n  nz = 1\n"
      "  elem_type = HEX8\n[]\n[GlobalParams]\n  displacements = 'disp_x disp_y disp_z'\n[]\n"
      "[Variables]\n";
  out += moose_displacements([](char axis) { return fmt::format("  [disp_{}]\n  []\n", axis); });
  out += "[]\n[Kernels]\n";
  out += moose_displacements([](char axis) {
    return block(fmt::format("balance_{}", axis),
                 fmt::format("    type = StressDivergenceTensors\n    variable = disp_{}\n"
                             "    component = {}\n",
                             axis, axis - 'x'));
  });
  out +=
      "[]\n[AuxVariables]\n  [stress_zz]\n    order = CONSTANT\n    family = MONOMIAL\n  []\n[]\n"
      "[AuxKernels]\n" +
      block("stress_zz",
            "    type = RankTwoAux\n    variable = stress_zz\n    rank_two_tensor = stress\n"
            "    index_i = 2\n    index_j = 2\n    execute_on = timestep_end\n") +
      "[]\n[Functions]\n" +
      block("ramp",
            fmt::format("    type = PiecewiseLinear\n    x = '0 {} {}'\n    y = '0 {} {}'\n",
                        time_text(input, input.test.ramp_s),
                        time_text(input, 2.0 * input.test.end_s()),
                        shortest_number(is_creep(input) ? input.stress : input.test.amplitude),
                        shortest_number(is_creep(input) ? input.stress : input.test.amplitude))) +
      block("step_size", moose_steps(input)) + "[]\n[BCs]\n";
  // GeneratedMesh names the faces x = 0 left, y = 0 bottom, z = 0 back, z = 1 front.
  const char* faces[] = {"left", "bottom", "back"};
  for (int i = 0; i < 3; ++i) {
    const char axis = static_cast<char>('x' + i);
    out += block(fmt::format("roller_{}", axis),
                 fmt::format("    type = DirichletBC\n    variable = disp_{}\n    boundary = {}\n"
                             "    value = 0\n",
                             axis, faces[i]));
  }
  out += block("pull", fmt::format("    type = Function{}BC\n    variable = disp_z\n"
                                   "    boundary = front\n    function = ramp\n",
                                   is_creep(input) ? "Neumann" : "Dirichlet"));
  out += "[]\n" + input.card.text + "[Postprocessors]\n" +
         block("stress", "    type = ElementAverageValue\n    variable = stress_zz\n") +
         block("strain",
               "    type = SideAverageValue\n    variable = disp_z\n    boundary = front\n") +
         "[]\n[Executioner]\n  type = Transient\n  solve_type = NEWTON\n"
         "  petsc_options_iname = '-pc_type'\n  petsc_options_value = 'lu'\n"
         "  nl_rel_tol = 1e-12\n  nl_abs_tol = 1e-30\n  end_time = " +
         time_text(input, input.test.end_s()) +
         "\n  [TimeStepper]\n    type = FunctionDT\n    function = step_size\n  []\n[]\n"
         "[Outputs]\n  csv = true\n[]\n";
  return out;
}

std::string comsol_model(const DeckInput& input, const std::string& class_name) {
  const Material& written = input.card.written;
  std::string names;
  for (const char* what : {"G", "tau"}) {
    names += fmt::format("    String[] {} = {{", *what == 'G' ? "moduli" : "times");
    for (std::size_t i = 1; i <= written.terms.size(); ++i) {
      names += fmt::format("{}prefix + \"_{}{}\"", i == 1 ? "" : ", ", what, i);
    }
    names += "};\n";
  }
  const std::string prefix = input.card.text.substr(0, input.card.text.find("_Einf"));
  const std::string name = prefix.substr(prefix.find_last_of('\n') + 1);
  std::string times;
  for (const TimeBlock& part : input.test.blocks) {
    times += (times.empty() ? "0 " : " ") + shortest_number(part.end_s);
  }
  const bool creep = is_creep(input);
  std::string out = "import com.comsol.model.*;\nimport com.comsol.model.util.*;\n\npublic class " +
                    class_name + " {\n  public static Model run() {\n    String prefix = \"" +
                    name + "\";\n" + names;
  out += fmt::format(
      "    Model model = ModelUtil.create(\"Model\");\n"
      "    model.param().loadFile(\"card.txt\");\n"
      "    model.param().set(\"amplitude\", \"{}\");\n"
      "    model.param().set(\"rise\", \"{}[s]\");\n"
      "    model.param().set(\"E0\", \"{}[Pa]\");\n",
      shortest_number(input.test.amplitude), shortest_number(input.test.ramp_s),
      shortest_number(written.E0_Pa));
  out +=
      "    model.component().create(\"comp1\", true);\n"
      "    model.component(\"comp1\").geom().create(\"geom1\", 3);\n"
      "    model.component(\"comp1\").geom(\"geom1\").create(\"blk1\", \"Block\");\n"
      "    model.component(\"comp1\").geom(\"geom1\").run();\n"
      "    model.component(\"comp1\").mesh().create(\"mesh1\");\n"
      "    model.component(\"comp1\").physics().create(\"solid\", \"SolidMechanics\", \"geom1\");\n"
      "    PhysicsFeature elastic = "
      "model.component(\"comp1\").physics(\"solid\").feature(\"lemm1\");\n"
      "    elastic.set(\"E_mat\", \"userdef\");\n"
      "    elastic.set(\"E\", prefix + \"_Einf\");\n"
      "    elastic.set(\"nu_mat\", \"userdef\");\n"
      "    elastic.set(\"nu\", prefix + \"_nuinf\");\n"
      "    elastic.set(\"rho_mat\", \"userdef\");\n"
      "    elastic.set(\"rho\", prefix + \"_rho\");\n"
      "    elastic.create(\"vis1\", \"Viscoelasticity\", 3);\n"
      "    elastic.feature(\"vis1\").set(\"Gvm\", moduli);\n"
      "    elastic.feature(\"vis1\").set(\"tauvm\", times);\n"
      "    model.component(\"comp1\").physics(\"solid\").create(\"roll1\", \"Roller\", 2);\n"
      "    model.component(\"comp1\").physics(\"solid\").feature(\"roll1\").selection().set(1, 2, "
      "3);\n";
  out += creep ? "    model.component(\"comp1\").physics(\"solid\").create(\"pull\", "
                 "\"BoundaryLoad\", 2);\n"
                 "    model.component(\"comp1\").physics(\"solid\").feature(\"pull\").set("
                 "\"FperArea\", new String[]{\"0\", \"0\", \"amplitude*E0*min(t/rise,1)\"});\n"
               : "    model.component(\"comp1\").physics(\"solid\").create(\"pull\", "
                 "\"Displacement2\", 2);\n"
                 "    model.component(\"comp1\").physics(\"solid\").feature(\"pull\").set("
                 "\"Direction\", new String[]{\"free\", \"free\", \"prescribed\"});\n"
                 "    model.component(\"comp1\").physics(\"solid\").feature(\"pull\").set("
                 "\"U0\", new String[]{\"0\", \"0\", \"amplitude*min(t/rise,1)*1[m]\"});\n";
  // A block's faces are numbered x = 0, y = 0, z = 0, z = 1, y = 1, x = 1.
  out +=
      "    model.component(\"comp1\").physics(\"solid\").feature(\"pull\").selection().set(4);\n"
      "    model.component(\"comp1\").physics(\"solid\").prop(\"StructuralTransientBehavior\")"
      ".set(\"StructuralTransientBehavior\", \"Quasistatic\");\n"
      "    model.study().create(\"std1\");\n"
      "    model.study(\"std1\").create(\"time\", \"Transient\");\n"
      "    model.study(\"std1\").feature(\"time\").set(\"tlist\", \"" +
      times +
      "\");\n"
      "    model.study(\"std1\").feature(\"time\").set(\"usertol\", true);\n"
      "    model.study(\"std1\").feature(\"time\").set(\"rtol\", \"1e-6\");\n"
      "    model.study(\"std1\").run();\n";
  out += creep ? "    // compare w/(amplitude*1[m]) of the face z = 1 with the expected curve\n"
               : "    // compare solid.sz/(amplitude*E0) with the expected curve\n";
  return out +
         "    return model;\n  }\n\n  public static void main(String[] args) {\n    run();\n"
         "  }\n}\n";
}

}  // namespace viscard
