// Abaqus, ANSYS MAPDL, CalculiX, FrontISTR: keyword files with free-format numbers.
#include "io/cards/card_body.h"
#include "io/cards/number_text.h"

#include <fmt/format.h>

namespace viscard {
namespace {

// Abaqus and CalculiX read 20 characters of a number and drop the rest, exponent and all.
std::string number(double value) {
  return number_within(value, 20);
}

std::string ansys_table(const char* kind, const std::vector<CardBranch>& branches,
                        double CardBranch::*share) {
  std::string out = fmt::format("TB,PRONY,1,1,{},{}\n", branches.size(), kind);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    // The location always stands there: the same explicit one twice overwrites the earlier pair.
    out += fmt::format("TBDATA,{},{},{}\n", 2 * i + 1, number(branches[i].*share),
                       number(branches[i].time));
  }
  return out;
}

// T_ref, C1, C2: the order all three codes take.
std::string wlf_row(const TemperatureShift& shift) {
  return number(shift.T_ref_C) + ", " + number(shift.C1) + ", " + number(shift.C2_K) + "\n";
}

bool any_bulk(const std::vector<CardBranch>& branches) {
  for (const CardBranch& branch : branches) {
    if (branch.bulk != 0.0) return true;
  }
  return false;
}

std::string calculix_material(const std::string& name, double density, double share,
                              double poisson) {
  std::string out = "*MATERIAL, NAME=" + name + "\n";
  if (density > 0.0) out += "*DENSITY\n" + number(density) + "\n";
  return out + "*ELASTIC\n" + number(share) + ", " + number(poisson) + "\n";
}

std::string calculix_recipe(const std::string& name, std::size_t branches) {
  std::string out =
      "** Element copies: every element of the part once per material, on the same nodes, for\n"
      "** example for C3D8 element 1 with nodes 1-8:\n";
  for (std::size_t i = 0; i <= branches; ++i) {
    const std::string material = i == 0 ? name + "_INF" : fmt::format("{}_M{}", name, i);
    out += fmt::format(
        "** *ELEMENT, TYPE=C3D8, ELSET=E_{0}\n** {1}, 1, 2, 3, 4, 5, 6, 7, 8\n"
        "** *SOLID SECTION, ELSET=E_{0}, MATERIAL={0}\n",
        material, i + 1);
  }
  return out;
}

}  // namespace

// Abaqus Keywords Reference: *ELASTIC (MODULI defaults to LONG TERM), *VISCOELASTIC, TIME=PRONY
// with the data line g_i, k_i, tau_i.
std::string abaqus_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out = "*MATERIAL, NAME=" + body.name + "\n";
  if (numbers.density > 0.0) out += "*DENSITY\n" + number(numbers.density) + ",\n";
  out += "*ELASTIC, MODULI=INSTANTANEOUS\n" + number(numbers.young) + ", " +
         number(numbers.poisson) + "\n";
  if (!numbers.branches.empty()) out += "*VISCOELASTIC, TIME=PRONY\n";
  for (const CardBranch& branch : numbers.branches) {
    out += number(branch.shear) + ", " + number(branch.bulk) + ", " + number(branch.time) + "\n";
  }
  // log10 a_T = -C1 (T - T0)/(C2 + T - T0): Abaqus Analysis User's Manual, time domain
  // viscoelasticity, thermorheologically simple temperature effects.
  if (numbers.shift) out += "*TRS, DEFINITION=WLF\n" + wlf_row(*numbers.shift);
  return out;
}

// MAPDL Command Reference: TB,PRONY,MATID,NTEMP,NPTS,SHEAR|BULK, NPTS pairs alpha_i, tau_i. Without
// a BULK table the bulk modulus is constant.
std::string ansys_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out =
      "MP,EX,1," + number(numbers.young) + "\nMP,PRXY,1," + number(numbers.poisson) + "\n";
  if (numbers.density > 0.0) out += "MP,DENS,1," + number(numbers.density) + "\n";
  if (!numbers.branches.empty()) {
    out += ansys_table("SHEAR", numbers.branches, &CardBranch::shear);
    if (any_bulk(numbers.branches)) out += ansys_table("BULK", numbers.branches, &CardBranch::bulk);
  }
  // MAPDL multiplies time by A = 1/a_T, log10 A = C1 (T - Tref)/(C2 + T - Tref): the usual
  // constants go in with their sign. MAPDL Material Reference, viscoelasticity, shift functions.
  if (numbers.shift) {
    std::string row = wlf_row(*numbers.shift);
    std::erase(row, ' ');
    out += "TB,SHIFT,1,1,3,WLF\nTBDATA,1," + row;
  }
  return out;
}

// CalculiX has no Prony keyword: a generalised Maxwell solid is one elastic material and one per
// branch with linear Norton creep, on coincident elements. Norton flow is deviatoric, so the bulk
// modulus, the sum of all shares, stays constant. CalculiX manual: *CREEP, LAW=NORTON.
std::string calculix_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out =
      calculix_material(body.name + "_INF", numbers.density, numbers.equilibrium, numbers.poisson);
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    const CardBranch& branch = numbers.branches[i];
    // The mass stands in the first material alone; ccx wants a density in each if in any.
    out += calculix_material(fmt::format("{}_M{}", body.name, i + 1),
                             numbers.density > 0.0 ? 1e-30 : 0.0, branch.shear, numbers.poisson);
    out += "*CREEP, LAW=NORTON\n" + number(branch.time) + ", 1., 0.\n";
  }
  return out + calculix_recipe(body.name, numbers.branches.size());
}

// FrontISTR manual and reader (fstr_ctrl_material.f90): rows mu_i, tau_i; INFINITESIMAL because the
// default is a total Lagrangian formulation.
std::string frontistr_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out = "!MATERIAL, NAME=" + body.name + "\n!ELASTIC\n " +
                    shortest_number(numbers.young) + ", " + shortest_number(numbers.poisson) + "\n";
  if (numbers.density > 0.0) out += "!DENSITY\n " + shortest_number(numbers.density) + "\n";
  if (!numbers.branches.empty()) out += "!VISCOELASTIC, INFINITESIMAL\n";
  for (const CardBranch& branch : numbers.branches) {
    out += " " + shortest_number(branch.shear) + ", " + shortest_number(branch.time) + "\n";
  }
  if (numbers.shift) out += "!TRS, DEFINITION=WLF\n " + wlf_row(*numbers.shift);
  return out;
}

}  // namespace viscard
