#include "tests/io/cards/rubber_rules.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace viscard::test {

using Catch::Matchers::Contains;

namespace {

// A ramp of half a second to a stretch of 1.8, then a hold.
constexpr double kRamp_s = 0.5, kEnd_s = 6.0;
double stretch_at(double time_s) {
  return 1.0 + 0.8 * std::min(time_s / kRamp_s, 1.0);
}

double nominal(double axial, double side, double stretch) {
  return stretch * axial - side / (stretch * stretch);
}

// Integral of f by Simpson's rule on both sides of `kink`.
double integral(const std::function<double(double)>& f, double end, double kink) {
  const auto part = [&](double from, double to) {
    const int n = 2000;
    const double h = (to - from) / n;
    double sum = f(from) + f(to);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(from + h * i);
    return sum * h / 3.0;
  };
  return kink > 0.0 && kink < end ? part(0.0, kink) + part(kink, end) : part(0.0, end);
}

double invariant(double axial, double side) {
  return axial * axial + 2.0 * side * side - 3.0;
}

double powers(double axial, double side, double alpha) {
  return std::pow(axial, alpha) + 2.0 * std::pow(side, alpha) - 3.0;
}

double tag_of(const std::string& card, const std::string& name) {
  const std::size_t at = card.find("<" + name + ">");
  REQUIRE(at != std::string::npos);
  return std::stod(card.substr(at + name.size() + 2));
}

std::function<double(double, double)> invariant_energy(const std::vector<double>& c) {
  return [=](double a, double b) {
    const double x = invariant(a, b);
    double sum = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i)
      sum += c[i] * std::pow(x, static_cast<double>(i + 1));
    return sum;
  };
}

// Constants of a table of MAPDL by their locations; each TBDATA line may hold several.
std::vector<double> table_of(const std::string& card, const std::string& command) {
  std::istringstream lines(card.substr(card.find(command)));
  std::string line;
  std::getline(lines, line);
  std::vector<double> out;
  while (std::getline(lines, line) && line.rfind("TBDATA,", 0) == 0) {
    for (char& c : line) {
      if (c == ',') c = ' ';
    }
    std::istringstream words(line.substr(7));
    std::size_t location = 0;
    words >> location;
    for (double value = 0.0; words >> value; ++location) {
      out.resize(std::max(out.size(), location));
      out[location - 1] = value;
    }
  }
  return out;
}

}  // namespace

const std::vector<double>& rule_times_s() {
  static const std::vector<double> kTimes_s{0.25, 0.5, 1.0, 6.0};
  return kTimes_s;
}

Rubber rubber_of(HyperelasticForm form, const std::vector<double>& moduli_Pa,
                 const std::vector<double>& shapes, const std::vector<RubberTerm>& terms) {
  const auto vector = [](const std::vector<double>& from) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(from.data(), static_cast<Eigen::Index>(from.size())));
  };
  Rubber out;
  out.law.form = form;
  out.law.moduli_Pa = vector(moduli_Pa);
  out.law.shapes = vector(shapes);
  out.terms = terms;
  return out;
}

const std::vector<Rubber>& rubbers() {
  static const std::vector<Rubber> kRubbers = [] {
    std::vector<Rubber> out;
    out.push_back(rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {{0.3, 0.4}}));
    out.push_back(
        rubber_of(HyperelasticForm::kYeoh, {1.8e5, -1.4e3, 40.0}, {}, {{0.2, 0.1}, {0.25, 3.0}}));
    out.push_back(rubber_of(HyperelasticForm::kOgden2, {2e5, 1e4}, {1.3, -2.0},
                            {{0.1, 0.05}, {0.2, 0.6}, {0.15, 8.0}}));
    return out;
  }();
  return kRubbers;
}

std::string card_of(const Rubber& rubber, const std::string& target, bool may_approximate,
                    const std::string& elastic_only) {
  return rubber_card(rubber.law, rubber.terms,
                     {.target = target,
                      .units = "mm-t-s",
                      .density_kg_m3 = 1100.0,
                      .may_approximate = may_approximate,
                      .elastic_only = elastic_only});
}

std::vector<double> fitted_MPa(const Rubber& rubber) {
  Course history;
  const auto add = [&](double time_s) { history.push_back({time_s, stretch_at(time_s)}); };
  for (int i = 0; i <= 1000; ++i) add(kRamp_s * i / 1000.0);
  add(1.0);
  add(kEnd_s);
  const auto all_Pa = nominal_stress_Pa(rubber.law, rubber.terms, Deformation::kUniaxial, history);
  return {1e-6 * all_Pa[500], 1e-6 * all_Pa[1000], 1e-6 * all_Pa[1001], 1e-6 * all_Pa[1002]};
}

double Written::difference(double stretch) const {
  const auto at = [&](double x) { return energy(x, 1.0 / std::sqrt(x)); };
  const double step = 1e-5;
  return stretch * (at(stretch + step) - at(stretch - step)) / (2.0 * step);
}

std::pair<double, double> Written::piola(double stretch) const {
  const double all = difference(stretch);
  return {2.0 / 3.0 * all / (stretch * stretch), -all / 3.0 * stretch};
}

double abaqus_stress(const Written& card, double time_s) {
  const double now = stretch_at(time_s);
  double axial = 2.0 / 3.0 * card.difference(now), side = -card.difference(now) / 3.0;
  for (std::size_t i = 0; i < card.g.size(); ++i) {
    const auto memory = [&](bool is_axial) {
      return integral(
          [&](double ago_s) {
            const double then = stretch_at(time_s - ago_s), ratio = now / then;
            const double stress = card.difference(then);
            return (is_axial ? 2.0 / 3.0 * stress * ratio * ratio : -stress / 3.0 / ratio) *
                   std::exp(-ago_s / card.tau[i]);
          },
          time_s, time_s - kRamp_s);
    };
    axial -= card.g[i] / card.tau[i] * memory(true);
    side -= card.g[i] / card.tau[i] * memory(false);
  }
  return (axial - side) / now;
}

double recursive_stress(const Written& card, const Recursion& rule, double time_s) {
  const int n = 6000;
  const double kink = std::min(kRamp_s, time_s);
  std::vector<double> first(card.g.size(), 0.0), third(card.g.size(), 0.0);
  std::pair<double, double> old{0.0, 0.0};
  for (int k = 1; k <= 2 * n; ++k) {
    const double from = k <= n ? 0.0 : kink, to = k <= n ? kink : time_s;
    const double dt = (to - from) / n;
    if (!(dt > 0.0)) break;
    const auto now = card.piola(stretch_at(from + dt * (k <= n ? k : k - n)));
    for (std::size_t i = 0; i < card.g.size(); ++i) {
      const double x = dt / card.tau[i], kept = std::exp(-x);
      first[i] = kept * first[i] + rule.gain(x) * (now.first - old.first);
      third[i] = kept * third[i] + rule.gain(x) * (now.second - old.second);
    }
    old = now;
  }
  double axial = rule.share * old.first, side = rule.share * old.second;
  for (std::size_t i = 0; i < card.g.size(); ++i) {
    axial += card.g[i] * first[i];
    side += card.g[i] * third[i];
  }
  return nominal(axial, side, stretch_at(time_s));
}

std::vector<double> numbers_below(const std::string& card, const std::string& mark) {
  const std::size_t at = card.find(mark);
  REQUIRE(at != std::string::npos);
  std::istringstream lines(card.substr(at));
  std::string line;
  std::getline(lines, line);
  std::vector<double> out;
  while (std::getline(lines, line)) {
    for (char& c : line) {
      if (c == ',') c = ' ';
    }
    std::istringstream words(line);
    double value = 0.0;
    if (!(words >> value)) break;
    do out.push_back(value);
    while (words >> value);
  }
  return out;
}

std::function<double(double, double)> ogden_energy(
    const std::vector<double>& mu, const std::vector<double>& alpha,
    const std::function<double(double, double)>& of) {
  return [=](double a, double b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mu.size(); ++i) sum += of(mu[i], alpha[i]) * powers(a, b, alpha[i]);
    return sum;
  };
}

Written abaqus_card(const Rubber& rubber) {
  const std::string card = card_of(rubber, "abaqus");
  REQUIRE_THAT(card, Contains(", MODULI=INSTANTANEOUS\n"));
  const auto numbers = numbers_below(card, "*HYPERELASTIC");
  Written out;
  if (rubber.law.form == HyperelasticForm::kNeoHooke) out.energy = invariant_energy({numbers[0]});
  if (rubber.law.form == HyperelasticForm::kYeoh)
    out.energy = invariant_energy({numbers[0], numbers[1], numbers[2]});
  if (rubber.law.form == HyperelasticForm::kOgden2) {
    out.energy = ogden_energy({numbers[0], numbers[2]}, {numbers[1], numbers[3]},
                              [](double mu, double alpha) { return 2.0 * mu / (alpha * alpha); });
  }
  const auto rows = numbers_below(card, "*VISCOELASTIC, TIME=PRONY");
  REQUIRE(rows.size() == 3 * rubber.terms.size());
  for (std::size_t i = 0; i < rows.size(); i += 3) {
    out.g.push_back(rows[i]);
    CHECK(rows[i + 1] == 0.0);
    out.tau.push_back(rows[i + 2]);
  }
  return out;
}

Written ansys_card(const Rubber& rubber) {
  const std::string card = card_of(rubber, "ansys");
  const auto law = table_of(card, "TB,HYPER"), prony = table_of(card, "TB,PRONY");
  CHECK_THAT(card, Contains("TB,PRONY,1,1," + std::to_string(rubber.terms.size()) + ",SHEAR\n"));
  Written out;
  if (rubber.law.form == HyperelasticForm::kNeoHooke) out.energy = invariant_energy({law[0] / 2.0});
  if (rubber.law.form == HyperelasticForm::kYeoh)
    out.energy = invariant_energy({law[0], law[1], law[2]});
  if (rubber.law.form == HyperelasticForm::kOgden2) {
    out.energy = ogden_energy({law[0], law[2]}, {law[1], law[3]},
                              [](double mu, double alpha) { return mu / alpha; });
  }
  REQUIRE(prony.size() == 2 * rubber.terms.size());
  for (std::size_t i = 0; i < prony.size(); i += 2) {
    out.g.push_back(prony[i]);
    out.tau.push_back(prony[i + 1]);
  }
  return out;
}

// The factors in <W>0.2*(I1-3)+0.03*(I1-3)^2+0.005*(I1-3)^3</W>.
std::vector<double> factors_of_energy(const std::string& card) {
  REQUIRE_THAT(card, Contains("<elastic type=\"uncoupled hyperelastic\">"));
  std::vector<double> out;
  std::size_t at = card.find("<W>") + 3;
  for (int power = 1; power <= 3; ++power) {
    const std::size_t end = card.find("*(I1-3)", at);
    REQUIRE(end != std::string::npos);
    out.push_back(std::strtod(card.substr(at, end - at).c_str(), nullptr));
    at = end + 7;
    if (power == 1) continue;
    REQUIRE(card.substr(at, 2) == "^" + std::to_string(power));
    at += 2;
  }
  CHECK(card.substr(at, 4) == "</W>");
  return out;
}

std::pair<Written, double> febio_card(const Rubber& rubber) {
  const std::string card = card_of(rubber, "febio");
  REQUIRE_THAT(card, Contains("type=\"uncoupled viscoelastic\"") && Contains("<elastic type="));
  // The bulk modulus is that of the top level: 1000 times the shear modulus at once.
  CHECK(card.find("<k>") < card.find("<elastic"));
  CHECK(tag_of(card, "k") ==
        Approx(1e-6 * 1000.0 * youngs_modulus_Pa(rubber.law) / 3.0).epsilon(1e-12));
  Written out;
  if (rubber.law.form == HyperelasticForm::kNeoHooke)
    out.energy = invariant_energy({tag_of(card, "c1")});
  if (rubber.law.form == HyperelasticForm::kYeoh)
    out.energy = invariant_energy(factors_of_energy(card));
  if (rubber.law.form == HyperelasticForm::kOgden2) {
    out.energy = ogden_energy({tag_of(card, "c1"), tag_of(card, "c2")},
                              {tag_of(card, "m1"), tag_of(card, "m2")},
                              [](double c, double m) { return c / (m * m); });
  }
  for (std::size_t i = 1; i <= rubber.terms.size(); ++i) {
    out.g.push_back(tag_of(card, "g" + std::to_string(i)));
    out.tau.push_back(tag_of(card, "t" + std::to_string(i)));
  }
  return {out, tag_of(card, "g0")};
}

}  // namespace viscard::test
