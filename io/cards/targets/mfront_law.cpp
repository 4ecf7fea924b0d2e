// MFront behaviours of laws of rubber: any law of models/hyperelastic/hyperelastic_law.h, in the isochoric invariants
// and stretches of C = F^T F and with the energy K/2 (J - 1)^2 of the volume. With j = J^(-2/3),
//   S = 2 (W1 A1 + W2 A2) + K (J - 1) J C^-1, A1 = j (I - I1/3 C^-1), A2 = j^2 (I1 I - C - 2/3 I2 C^-1),
// W1, W2: derivatives of W by the isochoric invariants; each term of Ogden adds
//   2 mu/alpha J^(-alpha/3) (C^(alpha/2 - 1) - tr(C^(alpha/2))/3 C^-1).
// Terms of relaxation act on the isochoric S_e, formula (2) of models/hyperelastic/finite_viscoelasticity.h:
//   S_iso = (1 - sum g_i) S_e + sum g_i H_i, H_i <- exp(-x) H_i + phi (S_e - S_e,old), x = dt/tau_i,
// with phi = (1 - exp(-x))/x, and the tangent is multiplied by 1 - sum g_i + sum g_i phi_i.
// Source: Holzapfel, Nonlinear Solid Mechanics (2000), 6.4 and 6.5; Simo & Hughes, Computational Inelasticity
// (1998), 10.3. The names of MFront are those of TFEL's
// gallery, Signorini.mfront and Ogden.mfront. The tangent dS/dC is the derivative of S.
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/law_numbers.h"
#include "io/cards/named_values.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/program_law.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

namespace viscard {
namespace {

// What differs between laws: parameters, and the derivatives of W by the first and second isochoric
// invariant; x is the first one minus 3.
struct MfrontLaw {
  std::string parameters, derivatives;

  void add(const std::string& name, double value) {
    parameters += fmt::format("@Parameter real {} = {};\n", name, value);
  }
};

// W1 and W11 of the five terms C_i/s_m^(2i - 2) I^i of Arruda and Boyce.
constexpr const char* kChains =
    "  const real c[5] = {1. / 2, 1. / 20, 11. / 1050, 19. / 7000, 519. / 673750};\n"
    "  const real y = (x + 3) / (s_m * s_m);\n"
    "  real W1 = 0, W11 = 0;\n"
    "  for (int i = 5; i != 0; --i) {\n"
    "    W1 = W1 * y + mu * i * c[i - 1];\n"
    "    if (i > 1) W11 = W11 * y + mu * i * (i - 1) * c[i - 1] / (s_m * s_m);\n"
    "  }\n";

MfrontLaw mfront_law(const CardNumbers& law) {
  MfrontLaw out;
  const auto& moduli = law.moduli;
  if (law.form == HyperelasticForm::kYeoh) {
    out.add("C10", moduli[0]);
    out.add("C20", moduli[1]);
    out.add("C30", moduli[2]);
    out.derivatives =
        "  const real W1 = C10 + 2 * C20 * x + 3 * C30 * x * x, W11 = 2 * C20 + 6 * C30 * x;\n";
  } else if (law.form == HyperelasticForm::kArrudaBoyce) {
    out.add("mu", moduli[0]);
    out.add("s_m", law.shapes[0]);
    out.derivatives = kChains;
  } else if (law.form == HyperelasticForm::kGent) {
    out.add("mu", moduli[0]);
    out.add("J_m", law.shapes[0]);
    out.derivatives = "  const real W1 = mu / 2 / (1 - x / J_m), W11 = W1 / (J_m - x);\n";
  } else {
    out.add("C10", moduli[0]);
    out.derivatives = "  const real W1 = C10, W11 = 0;\n";
  }
  const bool has_second = law.form == HyperelasticForm::kMooneyRivlin;
  if (has_second) out.add("C01", moduli[1]);
  out.derivatives += has_second ? "  const real W2 = C01;\n" : "  const real W2 = 0;\n";
  return out;
}

constexpr const char* kHistory = R"mfront(
@AuxiliaryStateVariable StressStensor Se;
@AuxiliaryStateVariable StressStensor H[Nv];
)mfront";

constexpr const char* kRelaxation = R"mfront(  const StressStensor rise = S - Se;
  Se = S;
  real stiffness = 1;
  for (unsigned short i = 0; i != Nv; ++i) {
    stiffness -= g[i];
  }
  S = stiffness * Se;
  for (unsigned short i = 0; i != Nv; ++i) {
    const real y = dt / tau[i];
    const real phi = y > 1.e-300 ? -std::expm1(-y) / y : real(1);
    H[i] = std::exp(-y) * H[i] + phi * rise;
    S += g[i] * H[i];
    stiffness += g[i] * phi;
  }
  if (computeTangentOperator_) {
    dS_dC = stiffness * dS_dC;
  }
)mfront";

constexpr const char* kOpening = R"mfront(
@LocalVariable StiffnessTensor dS_dC;

@Integrator {
  const auto id = Stensor::Id();
  const real J = det(F1);
  const Stensor C = computeRightCauchyGreenTensor(F1);
  const real I1 = trace(C);
  const real I2 = (I1 * I1 - trace(square(C))) / 2;
  const real I3 = J * J;
  const Stensor iC = (square(C) - I1 * C + I2 * id) / I3;
  const Stensor4 diC = computeDeterminantSecondDerivative(C) / I3 - (iC ^ iC);
)mfront";

constexpr const char* kInvariants = R"mfront(  const Stensor A1 = j * (id - (I1 / 3) * iC);
  const Stensor A2 = j * j * (I1 * id - C - (2 * I2 / 3) * iC);
  StressStensor S = 2 * (W1 * A1 + W2 * A2);
  if (computeTangentOperator_) {
    const Stensor4 dA1 = -(A1 ^ iC) / 3 - (j / 3) * ((iC ^ id) + I1 * diC);
    const Stensor4 dA2 =
        -(2 * (A2 ^ iC)) / 3 + j * j * ((id ^ id) - Stensor4::Id() -
                                        (2 * (iC ^ (I1 * id - C))) / 3 - (2 * I2 / 3) * diC);
    dS_dC = 2 * (W11 * (A1 ^ A1) + W1 * dA1 + W2 * dA2);
  }
)mfront";

constexpr const char* kStretches = R"mfront(  StressStensor S(real(0));
  dS_dC = Stensor4(real(0));
  tvector<3u, real> vp;
  tmatrix<3u, 3u, real> m;
  std::tie(vp, m) = C.template computeEigenVectors<Stensor::FSESJACOBIEIGENSOLVER>();
  for (unsigned short i = 0; i != Nt; ++i) {
    const real a = alpha[i] / 2;
    const real c = 2 * mu[i] / alpha[i] * std::pow(J, -alpha[i] / 3);
    tvector<3u, real> p, dp;
    real f = 0;
    for (unsigned short n = 0; n != 3; ++n) {
      p(n) = std::pow(vp(n), a - 1);
      dp(n) = (a - 1) * p(n) / vp(n);
      f += p(n) * vp(n);
    }
    const Stensor P = Stensor::computeIsotropicFunction(p, m);
    const Stensor deviator = P - (f / 3) * iC;
    S += c * deviator;
    if (computeTangentOperator_) {
      dS_dC += c * (Stensor::computeIsotropicFunctionDerivative(p, dp, vp, m, 1.e-12) -
                    (a / 3) * ((deviator ^ iC) + (iC ^ P)) - (f / 3) * diC);
    }
  }
)mfront";

constexpr const char* kClosing = R"mfront(  S += K * (J - 1) * J * iC;
  sig = convertSecondPiolaKirchhoffStressToCauchyStress(S, F1);
  if (computeTangentOperator_) {
    dS_dC += (K * (2 * J - 1) * J / 2) * (iC ^ iC) + (K * (J - 1) * J) * diC;
  }
}

@TangentOperator<DS_DC> {
  static_cast<void>(smt);
  Dt = dS_dC;
}
)mfront";

// "@Parameter real name[size] = {...};", under the constant of the size; an array of one becomes a scalar in MFront, so
// `second` keeps it an array.
std::string arrays_of(const char* size, const char* first_name, std::vector<double> first,
                      const char* other_name, std::vector<double> other, double second) {
  if (first.size() == 1) {
    first.push_back(0.0);
    other.push_back(second);
  }
  return fmt::format(
      "@IntegerConstant {0} = {1};\n@Parameter real {2}[{0}] = {{{3}}};\n@Parameter real {4}[{0}] "
      "= "
      "{{{5}}};\n",
      size, first.size(), first_name, fmt::join(first, ", "), other_name, fmt::join(other, ", "));
}

void take_mfront_law(const NamedNumbers& lists, CardNumbers& law) {
  using enum HyperelasticForm;
  const auto has = [&](const char* name) { return lists.contains(name); };
  const auto one = [&](const char* name) { return one_of(lists, name); };
  if (has("alpha")) {
    std::vector<double> mu = has("mu") ? lists.at("mu") : std::vector<double>{},
                        alpha = lists.at("alpha");
    while (mu.size() > 1 && mu.size() == alpha.size() && mu.back() == 0.0) {
      mu.pop_back();
      alpha.pop_back();
    }
    return take_ogden(mu, alpha, law);
  }
  if (has("s_m")) return take_law(kArrudaBoyce, {one("mu")}, {one("s_m")}, law);
  if (has("J_m")) return take_law(kGent, {one("mu")}, {one("J_m")}, law);
  if (has("C20")) return take_law(kYeoh, {one("C10"), one("C20"), one("C30")}, {}, law);
  if (has("C01")) return take_law(kMooneyRivlin, {one("C10"), one("C01")}, {}, law);
  take_law(kNeoHooke, {one("C10")}, {}, law);
}

}  // namespace

std::string write_mfront_law(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  const bool ogden = is_ogden(law.form);
  const MfrontLaw by_invariants = ogden ? MfrontLaw{} : mfront_law(law);
  std::string text = "@DSL DefaultFiniteStrain;\n@Behaviour " + body.name + ";\n" +
                     fmt::format("@Parameter real K = {};\n", law.bulk);
  text += ogden ? arrays_of("Nt", "mu", law.moduli, "alpha", law.shapes, 2.0)
                : by_invariants.parameters;
  if (!law.branches.empty()) {
    std::vector<double> g, tau;
    for (const CardBranch& branch : law.branches) {
      g.push_back(branch.shear);
      tau.push_back(branch.time);
    }
    text += arrays_of("Nv", "g", g, "tau", tau, tau[0]) + kHistory;
  }
  const std::string closing = (law.branches.empty() ? std::string() : kRelaxation) + kClosing;
  if (ogden) return text + kOpening + kStretches + closing;
  return text + kOpening + "  const real j = 1 / std::cbrt(I3);\n  const real x = j * I1 - 3;\n" +
         by_invariants.derivatives + kInvariants + closing;
}

void read_mfront_law(const std::string& text, ReadCard& card) {
  const std::string plain = without_line_comments(text, "//");
  const auto name = first_match(plain, "(?:^|\\n)\\s*@Behaviour\\s+(\\w+)\\s*;");
  if (!name) throw std::runtime_error("the card has no @Behaviour");
  card.name = name->group[1];
  const std::string pattern =
      "(?:^|\\n)\\s*@Parameter\\s+real\\s+(\\w+)(?:\\[\\w+\\])?\\s*=\\s*([^;]*);";
  std::set<std::string> names;
  for (const Match& match : all_matches(plain, pattern)) {
    if (!names.insert(match.group[1]).second)
      throw std::runtime_error(
          at_line(line_of(plain, match.at[1]), match.group[1] + " is set a second time"));
  }
  const NamedNumbers lists = named_lists(plain, pattern);
  card.numbers.bulk = one_of(lists, "K");
  take_mfront_law(lists, card.numbers);
  take_program_terms(lists, "g", "tau", card.numbers);
  const auto lines_of = [](const std::string& program) {
    return computing_lines(program, "//", "^\\s*@Parameter", false);
  };
  require_formula(lines_of(text),
                  lines_of(write_mfront_law(
                      {card.name, card.numbers, card.understood, card.units, card.material})));
}

}  // namespace viscard
