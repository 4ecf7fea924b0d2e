// The one-element models of solvers that Debian lacks: their text is read as the solver reads it
// and integrated by a second implementation, written from the solver's source.
#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/deck.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

using namespace viscard;
using namespace viscard::test;

namespace {

struct Point {
  double time = 0.0, value = 0.0;
};

std::vector<double> row_of(const std::string& line) {
  std::vector<double> out;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    out.push_back(std::strtod(cell.c_str(), nullptr));
  }
  return out;
}

// The rows of "time,response" below the comments and the header.
std::vector<Point> curve_of(const Deck& deck) {
  std::vector<Point> out;
  std::istringstream stream(deck.files.back().text);
  for (std::string line; std::getline(stream, line);) {
    const bool is_number = !line.empty() && line.find_first_of("0123456789") == 0;
    if (is_number) out.push_back({row_of(line)[0], row_of(line)[1]});
  }
  return out;
}

Deck deck_of(const Material& material, const char* target, const char* units,
             ElementTestKind kind) {
  const Card card =
      write_card(material, card_target(target), {.units = units, .may_approximate = true});
  return one_element_deck(card, card_deck(target), unit_system(units), kind);
}

// FrontISTR's viscoelastic solid in simple tension, geometrically linear: K constant, branches
// updated as in Viscoelastic.f90 (exact for strain that is linear in an increment).
class TensionBar {
 public:
  double young = 0.0, poisson = 0.0;
  std::vector<double> share, tau;

  // Axial stress after an increment of time dt to the axial strain.
  double stretch(double strain, double dt) {
    const auto [known, stiffness] = deviator(dt);
    const double e = (3.0 * bulk() * strain - 0.5 * known) / (3.0 * bulk() + 0.5 * stiffness);
    advance(e, dt);
    return 1.5 * (known + stiffness * e);
  }
  // Axial strain after an increment of time dt to the axial stress.
  double pull(double stress, double dt) {
    const auto [known, stiffness] = deviator(dt);
    const double s = stress / 1.5, e = (s - known) / stiffness;
    advance(e, dt);
    return e + s / (6.0 * bulk());
  }

 private:
  double shear() const { return young / (2.0 * (1.0 + poisson)); }
  double bulk() const { return young / (3.0 * (1.0 - 2.0 * poisson)); }
  static double mean_decay(double x) { return -std::expm1(-x) / x; }
  // Axial deviatoric stress = known + stiffness * axial deviatoric strain.
  std::pair<double, double> deviator(double dt) {
    branch_.resize(share.size(), 0.0);
    double rest = 1.0, known = 0.0;
    for (std::size_t i = 0; i < share.size(); ++i) rest -= share[i];
    double stiffness = rest;
    for (std::size_t i = 0; i < share.size(); ++i) {
      const double gain = share[i] * mean_decay(dt / tau[i]);
      known += std::exp(-dt / tau[i]) * branch_[i] - gain * last_;
      stiffness += gain;
    }
    return {2.0 * shear() * known, 2.0 * shear() * stiffness};
  }
  void advance(double e, double dt) {
    for (std::size_t i = 0; i < share.size(); ++i) {
      branch_[i] =
          std::exp(-dt / tau[i]) * branch_[i] + share[i] * mean_decay(dt / tau[i]) * (e - last_);
    }
    last_ = e;
  }
  std::vector<double> branch_;  // per unit of 2 G
  double last_ = 0.0;
};

// A control file of FrontISTR, as far as it acts on one element.
struct FrontistrModel {
  TensionBar bar;
  double force_per_node = 0.0;
  std::vector<double> displacement{0.0, 0.0, 0.0};  // of BOUNDARY group 1 and 2
  struct Step {
    double step = 0.0, length = 0.0;
    int boundary = 0;
    bool is_loaded = false;
  };
  std::vector<Step> steps;
};

FrontistrModel frontistr_model(const std::string& text) {
  FrontistrModel model;
  std::istringstream stream(text);
  std::string keyword;
  int group = 0;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '!') {
      keyword = line.substr(0, line.find(','));
      const std::size_t at = line.find("GRPID=");
      if (at != std::string::npos) group = std::atoi(line.c_str() + at + 6);
      if (keyword == "!STEP") model.steps.emplace_back();
      REQUIRE(line.find("AMP") == std::string::npos);
      continue;
    }
    const std::vector<double> row = row_of(line);
    if (keyword == "!ELASTIC") model.bar.young = row[0], model.bar.poisson = row[1];
    if (keyword == "!VISCOELASTIC")
      model.bar.share.push_back(row[0]), model.bar.tau.push_back(row[1]);
    if (keyword == "!BOUNDARY" && line.find("Z1") != std::string::npos) {
      model.displacement[static_cast<std::size_t>(group)] = row[3];
    }
    if (keyword == "!CLOAD") model.force_per_node = row[2];
    if (keyword != "!STEP") continue;
    if (line.find("BOUNDARY") != std::string::npos) {
      model.steps.back().boundary = static_cast<int>(row[1]);
    } else if (line.find("LOAD") != std::string::npos) {
      model.steps.back().is_loaded = true;
    } else {
      model.steps.back().step = row[0];
      model.steps.back().length = row[1];
    }
  }
  return model;
}

// fstr_AddBC.f90: the first increment of each VISCO step adds the displacement of its group.
// fstr_ass_load.f90: a force rises over the first step in which it is active and stays.
std::vector<Point> run(FrontistrModel model, bool is_creep) {
  std::vector<Point> out;
  double time = 0.0, strain = 0.0;
  bool was_loaded = false;
  for (const FrontistrModel::Step& step : model.steps) {
    const int increments = static_cast<int>(std::lround(step.length / step.step));
    REQUIRE(increments * step.step == Approx(step.length).epsilon(1e-9));
    for (int i = 1; i <= increments; ++i) {
      time += step.step;
      if (is_creep) {
        REQUIRE(step.is_loaded);
        const double share = was_loaded ? 1.0 : static_cast<double>(i) / increments;
        out.push_back({time, model.bar.pull(4.0 * model.force_per_node * share, step.step)});
      } else {
        if (i == 1) strain += model.displacement[static_cast<std::size_t>(step.boundary)];
        out.push_back({time, model.bar.stretch(strain, step.step)});
      }
    }
    was_loaded = true;
  }
  return out;
}

double value_at(double time, const std::vector<Point>& points) {
  for (const Point& point : points) {
    if (std::abs(point.time - time) <= 1e-9 * time) return point.value;
  }
  return std::nan("");
}

}  // namespace

namespace {

// Largest relative error of the model against its expected curve.
double frontistr_error(const Material& material, const char* units, bool is_creep) {
  const Deck deck = deck_of(material, "frontistr", units,
                            is_creep ? ElementTestKind::kCreep : ElementTestKind::kRelaxation);
  const FrontistrModel model = frontistr_model(deck.files[0].text);
  const std::vector<Point> points = run(model, is_creep);
  const double scale = is_creep ? 1.0 : 1.0 / model.bar.young;  // unit area, amplitude 1
  int compared = 0;
  double worst = 0.0;
  for (const Point& expected : curve_of(deck)) {
    const double found = scale * value_at(expected.time, points);
    if (std::isnan(found)) continue;  // within the ramp of one increment
    ++compared;
    worst = std::max(worst, std::abs(found / expected.value - 1.0));
  }
  CHECK(compared >= 20);
  return worst;
}

}  // namespace

TEST_CASE("FrontISTR's rules turn its model into the expected curve", "[cards]") {
  const Material soft = with_bulk_rule(material_of_terms(4, 0.4), BulkRule::kConstantBulk);
  for (const char* units : {"SI", "mm-t-s", "mm-kg-ms"}) {
    CAPTURE(units);
    // At constant K the deviatoric strain of a prescribed axial strain is not quite linear within
    // an increment, that of creep is less so. A ramp that each step repeats would be 8 times off.
    CHECK(frontistr_error(soft, units, false) <= 2e-4);
    CHECK(frontistr_error(soft, units, true) <= 2e-3);
    CHECK(frontistr_error(reference_material(), units, false) <= 1e-7);
    CHECK(frontistr_error(reference_material(), units, true) <= 5e-5);
  }
}

TEST_CASE("an elastic FrontISTR card is of small strain too", "[cards]") {
  Material material = reference_material();
  material.terms.clear();
  CHECK(write_card(material, card_target("frontistr")).text.find("!ELASTIC, INFINITESIMAL\n") !=
        std::string::npos);
}

namespace {

// GeneralizedMaxwellBase.C with the zienkiewicz rule: the strain of a dashpot is updated with the
// size of the step before. Returns the largest error of the stress over the expected curve.
double moose_error(const Deck& deck, const Material& material, double time_unit_s) {
  const std::string& text = deck.files[0].text;
  const auto number_after = [&](const std::string& mark) {
    const std::size_t at = text.find(mark);
    REQUIRE(at != std::string::npos);
    return std::strtod(text.c_str() + at + mark.size(), nullptr);
  };
  REQUIRE(text.find("integration_rule = zienkiewicz") != std::string::npos);
  const double dt = number_after("    dt = "), end = number_after("end_time = ");
  const double ramp = number_after("x = '0 ");
  std::vector<double> dashpot(material.terms.size(), 0.0);
  double dt_old = 0.0, strain_old = 0.0, worst = 0.0;
  const std::vector<Point> curve = curve_of(deck);
  std::size_t next = 0;
  for (int i = 1; i * dt <= end * (1.0 + 1e-9); ++i) {
    const double time = i * dt, strain = std::min(1.0, time / ramp);
    double stress = 1.0;
    for (const MaterialTerm& term : material.terms) stress -= term.g;
    stress *= strain;
    for (std::size_t k = 0; k < material.terms.size(); ++k) {
      const double tau = material.terms[k].tau_s / time_unit_s;
      if (i > 1) {
        const double x = dt_old / tau, theta = 1.0 / -std::expm1(-x) - 1.0 / x;
        const double gamma = 1.0 / (x * theta);
        dashpot[k] = (dashpot[k] * gamma * (1.0 - x * (1.0 - theta)) +
                      strain_old * (1.0 + x * (1.0 - theta) * gamma)) /
                     (1.0 + gamma);
      }
      const double x = dt / tau, mean_decay = -std::expm1(-x) / x;  // gamma/(1 + gamma)
      stress += material.terms[k].g * mean_decay * (strain - dashpot[k]);
    }
    while (next < curve.size() && curve[next].time < time * (1.0 - 1e-9)) ++next;
    if (next < curve.size() && curve[next].time <= time * (1.0 + 1e-9)) {
      worst = std::max(worst, std::abs(stress / curve[next].value - 1.0));
      ++next;
    }
    dt_old = dt;
    strain_old = strain;
  }
  CHECK(next >= curve.size() / 2);
  return worst;
}

}  // namespace

TEST_CASE("MOOSE's rule with the old step size turns its model into the expected curve",
          "[cards]") {
  const Material material = material_of_terms(4, 0.4);
  const Deck deck = deck_of(material, "moose", "mm-t-s", ElementTestKind::kRelaxation);
  CHECK(deck.files[0].text.find("ConstantDT") != std::string::npos);
  CHECK(moose_error(deck, material, 1.0) <= 1e-9);  // changing sizes gave 6.6e-3
  Material wide = material;
  wide.terms = {{0.2, 0.2, 1e-4}, {0.3, 0.3, 1e3}};
  const Deck coarse = deck_of(wide, "moose", "mm-t-s", ElementTestKind::kRelaxation);
  CHECK(moose_error(coarse, wide, 1.0) <= 1e-9);
}

TEST_CASE("MTest prints all digits, and the gallery's law gets arrays of two", "[cards]") {
  Material material = reference_material();
  material.terms.resize(1);
  const Card card = write_card(material, card_target("mfront"));
  CHECK(card.text.find("Nt = 2;") != std::string::npos);
  const std::string& gallery = card.companions.at(0).text;
  CHECK(gallery.find("Nv = 2;") != std::string::npos);
  CHECK(gallery.find("'TimeScale[1]'") != std::string::npos);
  const Deck deck = deck_of(material, "mfront", "SI", ElementTestKind::kRelaxation);
  CHECK(deck.files[0].text.find("@OutputFilePrecision 15;") != std::string::npos);
}
