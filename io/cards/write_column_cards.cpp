// LS-DYNA (10 columns) and OpenRadioss (20 columns): fixed fields.
#include "io/cards/card_body.h"
#include "io/cards/number_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <initializer_list>

namespace viscard {
namespace {

std::string right(const std::string& text, int columns) {
  return fmt::format("{:>{}}", text, columns);
}

// Nine of the ten columns while that costs no more than 1e-7, so that neighbours rarely touch and
// people can read them.
std::string field10(double value) {
  const std::string nine = nearest_number(value, 9);
  const bool is_near =
      std::abs(std::strtod(nine.c_str(), nullptr) - value) <= 1e-7 * std::abs(value);
  return right(is_near ? nine : nearest_number(value, 10), 10);
}

std::string fields10(std::initializer_list<double> values) {
  std::string out;
  for (const double value : values) out += field10(value);
  return out;
}

// Density 0 (not given) leaves a field LS-DYNA refuses; a blank one says so more clearly.
std::string density10(double density) {
  return density > 0.0 ? fields10({density}) : std::string(10, ' ');
}

std::string row20(const std::vector<double>& values) {
  std::string out;
  // 19 of the 20 columns, so that neighbours never touch.
  for (const double value : values) out += right(nearest_number(value, 19), 20);
  return out + "\n";
}

}  // namespace

// LS-DYNA Keyword User's Manual vol. II, *MAT_076: G(t) = sum G_i exp(-beta_i t), so the
// equilibrium modulus is a row with beta = 0. Card 2 (a fit by LS-DYNA itself) stays empty but must
// be there. KI is left blank: the bulk modulus is constant.
std::string lsdyna_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out = "*MAT_GENERAL_VISCOELASTIC_TITLE\n" + body.name + "\n";
  out += "$      MID        RO      BULK       PCF        EF      TREF         A         B\n";
  out += right("1", 10) + density10(numbers.density) + fields10({numbers.bulk}) + "\n";
  out += "$     LCID        NT    BSTART     TRAMP     LCIDK       NTK   BSTARTK    TRAMPK\n\n";
  out += "$       GI     BETAI        KI    BETAKI\n";
  out += fields10({numbers.equilibrium, 0.0}) + "\n";
  for (const CardBranch& branch : numbers.branches) {
    out += fields10({branch.shear, branch.time}) + "\n";
  }
  return out;
}

// *MAT_006: G(t) = GI + (G0 - GI) exp(-BETA t); GI is the long-term modulus, unlike in 076.
std::string lsdyna006_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const bool relaxes = !numbers.branches.empty();
  const double instantaneous = numbers.equilibrium + (relaxes ? numbers.branches[0].shear : 0.0);
  std::string out = "*MAT_VISCOELASTIC_TITLE\n" + body.name + "\n";
  out += "$      MID        RO      BULK        G0        GI      BETA\n";
  out += right("1", 10) + density10(numbers.density) + fields10({numbers.bulk, instantaneous}) +
         fields10({numbers.equilibrium, relaxes ? numbers.branches[0].time : 0.0}) + "\n";
  return out;
}

// Radioss Reference Guide, /MAT/LAW40 (KELVINMAX): K, long-term shear modulus, five branches. The
// only target that declares its units.
std::string openradioss_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const UnitSystem& units = body.units;
  std::vector<double> shear(5, 0.0), decay(5, 0.0);
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    shear[i] = numbers.branches[i].shear;
    decay[i] = numbers.branches[i].time;
  }
  std::string out = fmt::format("/UNIT/1\n{}\n", units.name);
  out += "#              MUNIT               LUNIT               TUNIT\n";
  out += right(units.mass, 20) + right(units.length, 20) + right(units.time, 20) + "\n";
  out += "/MAT/LAW40/1/1\n" + body.name + "\n#              RHO_I\n" + row20({numbers.density});
  out +=
      "#                  K               G_inf              Astass              Bstass"
      "                 Kvm\n" +
      row20({numbers.bulk, numbers.equilibrium, 0.0, 0.0, 0.0});
  out +=
      "#                 G1                  G2                  G3                  G4"
      "                  G5\n" +
      row20(shear);
  out +=
      "#              BETA1               BETA2               BETA3               BETA4"
      "               BETA5\n" +
      row20(decay);
  return out;
}

}  // namespace viscard
