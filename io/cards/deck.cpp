#include "io/cards/deck.h"

#include "io/cards/calculix_deck.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

std::string word_of(ElementTestKind kind) {
  return kind == ElementTestKind::kCreep ? "creep" : "relaxation";
}

struct DeckDialect {
  const char* target;
  ElementTestOptions options;  // kind aside
  std::vector<DeckFile> (*files)(const DeckInput& input, const std::string& name);
  const char* how_to_run;  // {} stands for the name
};

std::vector<DeckFile> calculix_files(const DeckInput& input, const std::string& name) {
  return {{name + ".inp",
           calculix_deck(input.card.text, input.test, input.card.written.E0_Pa, input.units)}};
}
std::vector<DeckFile> abaqus_files(const DeckInput& input, const std::string& name) {
  return {{name + ".inp", abaqus_deck(input)}};
}
std::vector<DeckFile> ansys_files(const DeckInput& input, const std::string& name) {
  return {{name + ".mac", ansys_deck(input)}};
}
std::vector<DeckFile> lsdyna_files(const DeckInput& input, const std::string& name) {
  return {{name + ".k", lsdyna_deck(input)}};
}
std::vector<DeckFile> febio_files(const DeckInput& input, const std::string& name) {
  return {{name + ".feb", febio_deck(input)}};
}
std::vector<DeckFile> mfront_files(const DeckInput& input, const std::string& name) {
  return {{name + ".mtest", mtest_deck(input)}, {"card.mfront", input.card.text}};
}
std::vector<DeckFile> openradioss_files(const DeckInput& input, const std::string& name) {
  return {{name + "_0000.rad", openradioss_starter(input, name)},
          {name + "_0001.rad", openradioss_engine(input, name)}};
}
std::vector<DeckFile> comsol_files(const DeckInput& input, const std::string& name) {
  return {{name + ".java", comsol_model(input, name)}, {"card.txt", input.card.text}};
}
std::vector<DeckFile> moose_files(const DeckInput& input, const std::string& name) {
  return {{name + ".i", moose_deck(input)}};
}
std::vector<DeckFile> frontistr_files(const DeckInput& input, const std::string& name) {
  return {{name + ".cnt", frontistr_control(input)},
          {name + ".msh", frontistr_mesh()},
          {"hecmw_ctrl.dat", "!MESH, NAME=fstrMSH, TYPE=HECMW-ENTIRE\n " + name +
                                 ".msh\n!CONTROL, NAME=fstrCNT\n " + name +
                                 ".cnt\n!RESULT, NAME=fstrRES, IO=OUT\n " + name + ".res\n"}};
}

// Exponential integrators are exact for strain that is linear in the step, so few increments do;
// finite-strain codes need a small strain. CalculiX integrates to first order (README.md).
const ElementTestOptions kExponential{.amplitude = 1e-6, .steps_per_tau = 8};
const ElementTestOptions kFirstOrder{
    .amplitude = 1.0, .steps_per_tau = 40, .longest_step_tau = 5.0, .most_increments = 4000};

const std::vector<DeckDialect>& dialects() {
  static const std::vector<DeckDialect> all{
      {"abaqus", kExponential, abaqus_files, "abaqus job={}"},
      {"ansys", kExponential, ansys_files, "mapdl -b -i {}.mac"},
      {"lsdyna", kExponential, lsdyna_files, "ls-dyna_double i={}.k"},
      {"lsdyna006", kExponential, lsdyna_files, "ls-dyna_double i={}.k"},
      {"febio", kExponential, febio_files, "febio4 -i {}.feb"},
      {"febio-uncoupled", kExponential, febio_files, "febio4 -i {}.feb"},
      {"mfront", kExponential, mfront_files,
       "mfront --obuild --interface=generic card.mfront && mtest {}.mtest"},
      {"calculix", kFirstOrder, calculix_files, "ccx {}"},
      {"openradioss", kExponential, openradioss_files,
       "starter -i {0}_0000.rad && engine -i {0}_0001.rad"},
      {"comsol", kExponential, comsol_files,
       "comsol compile {0}.java && comsol batch -inputfile {0}.class"},
      {"moose", kExponential, moose_files, "solid_mechanics-opt -i {}.i"},
      {"frontistr", kExponential, frontistr_files, "fistr1"},
  };
  return all;
}

const DeckDialect& dialect_of(const std::string& target) {
  std::string names;
  for (const DeckDialect& dialect : dialects()) {
    if (target == dialect.target) return dialect;
    names += (names.empty() ? "" : ", ") + std::string(dialect.target);
  }
  throw std::invalid_argument("there is no one-element model for " + target + "; there are for " +
                              names);
}

std::string expected(const Card& card, const ElementTest& test, const UnitSystem& units) {
  const bool is_creep = test.kind == ElementTestKind::kCreep;
  const std::string header = fmt::format(
      "# one element in simple tension, sides free; ramp of {0} {1}, then held; amplitude {2}\n"
      "# {3}\ntime_{1},{4}\n",
      to_card(test.ramp_s, units.time_exponent), units.time, test.amplitude,
      is_creep
          ? "expected: strain divided by the amplitude; the stress held is amplitude times E0"
          : "expected: stress divided by (amplitude times E0); the strain held is the amplitude",
      is_creep ? "strain_over_amplitude" : "stress_over_amplitude_E0");
  return expected_curve_csv(card.written, test, to_card(1.0, units.time_exponent), header);
}

}  // namespace

Deck one_element_deck(const Card& card, const std::string& target, const UnitSystem& units,
                      ElementTestKind kind) {
  const DeckDialect& dialect = dialect_of(target);
  ElementTestOptions options = dialect.options;
  options.kind = kind;
  const ElementTest test = element_test(card.written, options);
  const DeckInput input{card, test, units,
                        to_card(test.amplitude * card.written.E0_Pa, units.stress_exponent)};
  const std::string name = word_of(kind);
  Deck deck{dialect.files(input, name), fmt::format(fmt::runtime(dialect.how_to_run), name)};
  deck.files.push_back({name + "_expected.csv", expected(card, test, units)});
  return deck;
}

}  // namespace viscard
