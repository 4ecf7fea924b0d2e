// Conventions, beside the energies of models/hyperelastic/hyperelastic_law.h:
//   frontistr    NEOHOOKE C10, D; MOONEY-RIVLIN C10, C01, D; ARRUDA-BOYCE mu, s_m, D; the energy of
//                the volume is (J - 1)^2/D, D = 2/K. D up to 1e-12 is taken for 1/D. Source:
//                fstr_ctrl_material.f90, Hyperelastic.f90 of FrontISTR 5.
//   lsdyna       077_H: C10, C01, C11, C20, C02, C30; 077_O: Ogden's own mu_i/alpha_i, 2 mu/alpha of
//                ours, eight of each; both take Poisson's ratio instead of K. 127 (Arruda-Boyce) takes a
//                whole number of links only, so that it is refused. Ten columns round numbers; the card
//                states by how much. Source: Keyword User's Manual R13,
//                vol. II; fields as in PyDYNA. Not run.
//   openradioss  LAW82: mu_i, alpha_i of ours, nu = 0 and D_1 = 2/K; LAW94 (Yeoh) and LAW92
//                (Arruda-Boyce) with the same D. Mooney-Rivlin is LAW82 with exponents 2 and -2, mu = 2 C.
//                Damage by the first loading: /FAIL/MULLINS_OR, which acts on LAW92, 95 and 100 only, so that
//                the laws of the invariants become LAW100 (hm_read_mat100.F: K = 2/D_1, no networks).
//                Source: Radioss Reference Guide 2021; fail_mullins_or.cfg. Not run.
#include "io/cards/hyperelastic/rubber_rows.h"

#include "io/cards/column_fields.h"
#include "io/cards/keyword_lines.h"
#include "models/maths/leading_number.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Law = HyperelasticForm;
using Row = std::vector<double>;

constexpr int kShort = 10, kWide = 20;

std::string row_of(const Row& numbers, int width) {
  std::string text;
  for (const double number : numbers) text += real(number, width);
  return text + "\n";
}

// Rows of ten columns, and the largest relative change of a number in them.
struct ShortRows {
  double loss = 0.0;

  std::string row(const Row& numbers) {
    for (const double number : numbers) {
      if (number == 0.0) continue;
      const double written = leading_number(real(number, kShort));
      loss = std::max(loss, std::abs(written / number - 1.0));
    }
    return row_of(numbers, kShort);
  }
};

// The law after all relaxation.
RubberNumbers relaxed(RubberNumbers law) {
  const double share = law.long_term_share();
  for (double& modulus : law.moduli) modulus *= share;
  law.shear *= share;
  return law;
}

// Rows G_i, BETA_i of 077: shear moduli, and the reciprocal of the time.
std::string relaxation_rows(const RubberNumbers& law, ShortRows& rows) {
  if (law.terms.empty()) return "";
  std::string text = "$       GI     BETAI\n";
  for (const RubberNumbers::Term& term : law.terms)
    text += rows.row({term.g * law.shear, 1.0 / term.time});
  return text;
}

// LAW100 without networks of flow: the law of the invariants alone, D_1 = 2/K.
std::string radioss_law100(const RubberNumbers& law, const std::string& material) {
  const bool is_yeoh = law.form == Law::kYeoh, is_mooney = law.form == Law::kMooneyRivlin;
  Row constants = law.moduli;
  constants.push_back(law.d());
  const char* const names =
      is_yeoh ? "#                C10                 C20                 C30                  D1\n"
      : is_mooney ? "#                C10                 C01                  D1\n"
                  : "#                C10                  D1\n";
  return radioss_unit_block(law) + "/MAT/LAW100/1/1\n" + material + "\n#              RHO_I\n" +
         row_of({law.density}, kWide) + "#    N_net   Flag_HE   Flag_Cr\n" + right("0", kShort) +
         right(is_yeoh     ? "5"
               : is_mooney ? "4"
                           : "3",
               kShort) +
         right("0", kShort) + "\n" + names + row_of(constants, kWide);
}

// R, beta, m: another order than that of Abaqus. m is converted as an energy, not as one per volume.
std::string radioss_damage(const RubberNumbers::Damage& damage) {
  return "# /BEGIN needs the units of /UNIT/1: m would be converted as an energy, without the "
         "volume\n"
         "/FAIL/MULLINS_OR/1/1\n#                  R                BETA                   m\n" +
         row_of({damage.r, damage.beta, damage.m}, kWide);
}

}  // namespace

RubberNumbers as_ogden(const RubberNumbers& law) {
  RubberNumbers out = law;
  if (is_ogden(law.form)) return out;
  for (double& modulus : out.moduli) modulus *= 2.0;  // C10, C01
  out.shapes = {2.0};
  if (law.moduli.size() > 1) out.shapes.push_back(-2.0);
  return out;
}

double poisson_ratio_of(const RubberNumbers& law) {
  return (3.0 * law.bulk - 2.0 * law.shear) / (6.0 * law.bulk + 2.0 * law.shear);
}

bool has_ogden_form(HyperelasticForm form) {
  return is_ogden(form) || form == Law::kNeoHooke || form == Law::kMooneyRivlin;
}

std::string radioss_unit_block(const RubberNumbers& law) {
  return fmt::format("/UNIT/1\n{}\n", law.units->name) + right(law.units->mass, kWide) +
         right(law.units->length, kWide) + right(law.units->time, kWide) + "\n";
}

bool is_ogden(HyperelasticForm form) {
  return form == Law::kOgden1 || form == Law::kOgden2 || form == Law::kOgden3;
}

std::vector<double> pairs_of(const RubberNumbers& law) {
  std::vector<double> out;
  for (std::size_t i = 0; i < law.moduli.size(); ++i) {
    out.push_back(law.moduli[i]);
    out.push_back(law.shapes[i]);
  }
  return out;
}

std::string frontistr_rubber(const RubberNumbers& law, const std::string& material) {
  constexpr double kLeast = 1e-12;
  require(law.d() > kLeast,
          "frontistr takes D = 2/K up to 1e-12 for 1/D; choose units with smaller numbers (--units "
          "mm-t-s) or a smaller --bulk-modulus");
  std::string type, numbers;
  if (law.form == Law::kNeoHooke) {
    type = "NEOHOOKE";
  } else if (law.form == Law::kMooneyRivlin) {
    type = "MOONEY-RIVLIN";
  } else {
    type = "ARRUDA-BOYCE";
  }
  for (const double modulus : law.moduli) numbers += number_of_20(modulus) + ", ";
  for (const double shape : law.shapes) numbers += number_of_20(shape) + ", ";
  std::string text = "!MATERIAL, NAME=" + material + "\n!HYPERELASTIC, TYPE=" + type + "\n" +
                     numbers + number_of_20(law.d()) + "\n";
  if (law.density > 0.0) text += "!DENSITY\n" + number_of_20(law.density) + "\n";
  return text;
}

std::string lsdyna_rubber(const RubberNumbers& at_once, const std::string& material) {
  if (!at_once.foam.empty()) return lsdyna_foam(at_once, material);
  const RubberNumbers law = relaxed(at_once);
  const bool ogden = is_ogden(law.form);
  ShortRows rows;
  std::string first = rows.row({law.density, poisson_ratio_of(law)});
  first.pop_back();  // the line goes on with N
  std::string text = "$      MID        RO        PR         N\n" + right("1", kShort) + first +
                     right("0", kShort) + "\n";
  if (ogden) {
    constexpr std::size_t kEight = 8;
    Row mu(kEight, 0.0), alpha(kEight, 0.0);
    for (std::size_t i = 0; i < law.moduli.size(); ++i) {
      mu[i] = 2.0 * law.moduli[i] / law.shapes[i];
      alpha[i] = law.shapes[i];
    }
    text += "$     MU1 to MU8\n" + rows.row(mu) + "$ ALPHA1 to ALPHA8\n" + rows.row(alpha);
  } else {
    const bool is_yeoh = law.form == Law::kYeoh;
    const double C01 = law.form == Law::kMooneyRivlin ? law.moduli[1] : 0.0;
    text += "$      C10       C01       C11       C20       C02       C30\n" +
            rows.row({law.moduli[0], C01, 0.0, is_yeoh ? law.moduli[1] : 0.0, 0.0,
                      is_yeoh ? law.moduli[2] : 0.0});
  }
  text += relaxation_rows(at_once, rows);
  return fmt::format(
             "$ numbers: rounded to ten columns, by at most {:.1e}\n*MAT_{}_RUBBER_TITLE\n{}\n",
             rows.loss, ogden ? "OGDEN" : "HYPERELASTIC", material) +
         text;
}

std::string openradioss_rubber(const RubberNumbers& law, const std::string& material) {
  if (!law.foam.empty()) return openradioss_foam(law, material);
  const bool is_yeoh = law.form == Law::kYeoh, is_boyce = law.form == Law::kArrudaBoyce;
  if (law.damage && !is_boyce) return radioss_law100(law, material) + radioss_damage(*law.damage);
  std::string text = radioss_unit_block(law) +
                     fmt::format("/MAT/LAW{}/1/1\n{}\n",
                                 is_yeoh    ? 94
                                 : is_boyce ? 92
                                            : 82,
                                 material) +
                     "#              RHO_I\n" + row_of({law.density}, kWide);
  if (is_yeoh) {
    return text + "\n#                C10                 C20                 C30\n" +
           row_of(law.moduli, kWide) +
           "#                 D1                  D2                  D3\n" +
           row_of({law.d(), 0.0, 0.0}, kWide);
  }
  if (is_boyce) {
    return text + "#                 mu                   D            lambda_m\n" +
           row_of({law.moduli[0], law.d(), law.shapes[0]}, kWide) +
           "#    Itype    fct_ID                  nu              Fscale\n" + right("0", kShort) +
           right("0", kShort) + row_of({0.0, 0.0}, kWide) +
           (law.damage ? radioss_damage(*law.damage) : "");
  }
  const RubberNumbers ogden = as_ogden(law);
  Row d(ogden.moduli.size(), 0.0);
  d[0] = law.d();
  return text + "#        N                            nu\n" +
         right(std::to_string(ogden.moduli.size()), kShort) + right("", kShort) + real(0.0, kWide) +
         "\n# mu\n" + row_of(ogden.moduli, kWide) + "# alpha\n" + row_of(ogden.shapes, kWide) +
         "# D\n" + row_of(d, kWide);
}

}  // namespace viscard
