// MFront behaviour. Source of the property names: TFEL's gallery, GeneralizedMaxwell.mfront.
#include "io/basics/patterns.h"
#include "io/cards/deck.h"
#include "io/cards/named_values.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/program_law.h"

#include <fmt/format.h>

#include <cctype>

namespace viscard {
namespace {

// Stress at the end of a step in which strain is linear in time: each branch decays by exp(-dt/tau)
// and gains its modulus times phi_1(dt/tau) = (1 - exp(-x))/x of the strain increment, exactly
// (Taylor, Pister & Goudreau, IJNME 2 (1970) 45). dt = 0 is a jump: phi_1 = 1.
constexpr const char* kMfrontIntegrator = R"(@StateVariable StressStensor q[Nt];
q.setEntryName("BranchStress");

@ProvidesSymmetricTangentOperator;
@Integrator {
  const real K0 = E0 / (3 * (1 - 2 * nu0));
  const real G0 = E0 / (2 * (1 + nu0));
  real Kt = K0;
  real Gt = G0;
  for (unsigned short i = 0; i != Nt; ++i) {
    Kt -= k[i] * K0;
    Gt -= g[i] * G0;
  }
  const StrainStensor e1 = eto + deto;
  sig = (Kt - 2 * Gt / 3) * trace(e1) * StrainStensor::Id() + 2 * Gt * e1;
  for (unsigned short i = 0; i != Nt; ++i) {
    const real x = dt / tau[i];
    const real phi = x > 1.e-300 ? -std::expm1(-x) / x : real(1);
    const real Kb = k[i] * K0 * phi;
    const real Gb = g[i] * G0 * phi;
    q[i] = std::exp(-x) * q[i] + (Kb - 2 * Gb / 3) * trace(deto) * StrainStensor::Id() +
           2 * Gb * deto;
    sig += q[i];
    Kt += Kb;
    Gt += Gb;
  }
  if (computeTangentOperator_) {
    Dt = (Kt - 2 * Gt / 3) * Stensor4::IxI() + 2 * Gt * Stensor4::Id();
  }
}
)";

// MFront makes an array of one a scalar; a branch without stiffness keeps it an array.
CardNumbers at_least_two_branches(CardNumbers numbers) {
  while (numbers.branches.size() < 2) {
    const double time = numbers.branches.empty() ? 1.0 : numbers.branches.back().time;
    numbers.branches.push_back({0.0, 0.0, time});
  }
  return numbers;
}

std::string write_mfront(const CardBody& body) {
  const CardNumbers numbers = at_least_two_branches(body.numbers);
  std::string out = "@DSL Default;\n@Behaviour " + body.name + ";\n\n";
  if (numbers.density > 0.0) {
    out += fmt::format("// mass density {} {}\n", numbers.density, body.units.density);
  }
  return out +
         fmt::format(
             "@IntegerConstant Nt = {};\n@Parameter real E0 = {};\n@Parameter real nu0 = {};\n"
             "@Parameter real g[Nt] = {{{}}};\n@Parameter real k[Nt] = {{{}}};\n"
             "@Parameter real tau[Nt] = {{{}}};\n\n",
             numbers.branches.size(), numbers.young, numbers.poisson,
             joined(numbers.branches, &CardBranch::shear, ", "),
             joined(numbers.branches, &CardBranch::bulk, ", "),
             joined(numbers.branches, &CardBranch::time, ", ")) +
         kMfrontIntegrator;
}

// The gallery's law: long-term bulk and shear moduli, absolute branches.
CardTarget gallery_target() {
  CardTarget target = mfront_target();
  target.elastic = ElasticForm::kBulkShear;
  target.at = ModulusAt::kLongTerm;
  target.branch = BranchNumber::kAbsoluteShear;
  return target;
}

// The properties of the gallery's law, as MTest takes them.
std::string gallery_properties(const CardNumbers& numbers) {
  const auto property = [](const std::string& name, double value) {
    return fmt::format("@MaterialProperty<constant> '{}' {};\n", name, value);
  };
  std::string out = fmt::format(
      "// for the gallery's GeneralizedMaxwell compiled with @IntegerConstant Nv = {};\n",
      numbers.branches.size());
  out += property("BulkModulus", numbers.bulk) + property("ShearModulus", numbers.shear);
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    out += property("ViscoelasticBulkModulus" + index, numbers.branches[i].bulk);
    out += property("ViscoelasticShearModulus" + index, numbers.branches[i].shear);
    out += property("TimeScale" + index, numbers.branches[i].time);
  }
  return out;
}

std::vector<CompanionFile> mfront_companions(const CardBody& body) {
  if (!(body.material.nu < 0.5)) return {};
  return {{"_gallery.mtest", gallery_properties(at_least_two_branches(numbers_from_material(
                                 body.material, gallery_target(), body.units)))}};
}

void read_gallery(const std::string& text, ReadCard& card) {
  card.understood = gallery_target();
  const NamedNumbers named = named_lists(
      text, "@MaterialProperty\\s*<\\s*constant\\s*>\\s*['\"]([^'\"]*)['\"]\\s*([^;]*);");
  if (all_matches(text, "@MaterialProperty").size() > named.size()) {
    card.add("second-element", "a property stands in the card twice, or is not constant");
  }
  card.numbers.bulk = one_of(named, "BulkModulus");
  card.numbers.shear = one_of(named, "ShearModulus");
  for (std::size_t i = 0;; ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    if (named.count("TimeScale" + index) == 0) break;
    card.numbers.branches.push_back({one_of(named, "ViscoelasticShearModulus" + index),
                                     one_of(named, "ViscoelasticBulkModulus" + index),
                                     one_of(named, "TimeScale" + index)});
  }
  const std::size_t read = 2 + 3 * card.numbers.branches.size();
  if (named.size() == read) return;
  card.add("property-without-partner",
           std::to_string(named.size() - read) +
               " properties are not read: each branch needs a bulk modulus, a shear modulus and a "
               "TimeScale of one index, counted from 0");
}

// The lines of a program without blanks and comments.
std::string squeezed(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) out += c;
  }
  return out;
}

// The numbers say nothing if the lines that use them do something else.
void check_program(const std::string& text, const NamedNumbers& named, std::size_t count,
                   ReadCard& card) {
  const std::string program = squeezed(text);
  const bool has_head = program.find("@DSLDefault;") != std::string::npos && !card.name.empty();
  if (!has_head || program.find(squeezed(kMfrontIntegrator)) == std::string::npos) {
    card.add("integrator-differs",
             "the lines that integrate the stress, or @DSL and @Behaviour, are not those that "
             "viscard writes, so the numbers alone show nothing");
  }
  const auto size = first_match(text, "@IntegerConstant\\s+Nt\\s*=\\s*(\\d+)\\s*;");
  if (!size || size->group[1] != std::to_string(count)) {
    card.add("array-size", "Nt is not the number of relaxation times, " + std::to_string(count));
  }
  for (const char* name : {"E0", "nu0", "g", "k", "tau"}) {
    check_single_element(text, std::string("@Parameter\\s+\\w+\\s+") + name + "\\b", name, card);
    const auto found = named.find(name);
    const bool is_array = found != named.end() && found->second.size() > 1;
    const std::string mark =
        std::string("@Parameterreal") + name + (is_array ? "\\[Nt\\]=\\{[^{};]*\\};" : "=[^{};]*;");
    if (!first_match(program, mark)) {
      card.add("array-size",
               std::string(name) + " is not declared as '@Parameter real' of size Nt");
    }
  }
}

void read_mfront(const std::string& commented, ReadCard& card) {
  const std::string text = without_line_comments(commented, "//");
  if (text.find("@MaterialProperty") != std::string::npos &&
      text.find("ViscoelasticShearModulus[") != std::string::npos) {
    return read_gallery(text, card);
  }
  const NamedNumbers named =
      named_lists(text, "@Parameter\\s+\\w+\\s+(\\w+)\\s*(?:\\[\\s*\\w+\\s*\\])?\\s*=\\s*([^;]*);");
  const auto name = first_match(text, "@Behaviour\\s+(\\w+)");
  if (name) card.name = name->group[1];
  card.numbers.young = one_of(named, "E0");
  card.numbers.poisson = one_of(named, "nu0");
  const std::size_t count = named.count("tau") > 0 ? named.at("tau").size() : 0;
  const auto& g = list_of(named, "g", count);
  const auto& k = list_of(named, "k", count);
  for (std::size_t i = 0; i < count; ++i) {
    card.numbers.branches.push_back({g[i], k[i], named.at("tau")[i]});
  }
  check_program(text, named, count, card);
}

// MTest drives one material point; the behaviour needs no material property.
std::vector<DeckFile> mfront_deck(const DeckInput& input, const std::string& name) {
  const double top = input.is_creep() ? input.stress() : input.test.amplitude;
  std::string out = fmt::format(
      "@ModellingHypothesis 'Tridimensional';\n@Behaviour<generic> 'src/libBehaviour.so' '{}';\n"
      "@ExternalStateVariable 'Temperature' 293.15;\n@OutputFilePrecision 15;\n"
      "@Imposed{} {{0. : 0., {} : {}, {} : {}}};\n@StrainEpsilon {};\n@StressEpsilon {};\n"
      "@Times {{0.",
      input.card.name, input.is_creep() ? "Stress<evolution> 'SZZ'" : "Strain<evolution> 'EZZ'",
      input.ramp(), top, 2.0 * input.end(), top, 1e-11 * input.test.amplitude,
      1e-11 * input.stress());
  if (input.is_confined())
    out.insert(out.find("@StrainEpsilon"), "@ImposedStrain 'EXX' 0.;\n@ImposedStrain 'EYY' 0.;\n");
  for (const DeckBlock& block : input.blocks()) {
    out += fmt::format(", {} in {}", block.end, block.increments);
  }
  return {{name + ".mtest", out + "};\n"}, {"card.mfront", input.card.text}};
}

}  // namespace

CardTarget mfront_target() {
  return {
      .name = "mfront",
      .code = "MFront behaviour",
      .extension = ".mfront",
      .comment = "//",
      .write = write_mfront,
      .read = read_mfront,
      .companions = mfront_companions,
      .deck = DeckWriter{mfront_deck,
                         "mfront --obuild --interface=generic card.mfront && mtest {}.mtest"},
      .laws = LawColumn{.write = write_mfront_law,
                        .read = read_mfront_law,
                        .keywords = {"C10", "C10, C01", "C10, C20, C30", "mu, alpha", "mu, s_m",
                                     "mu, J_m"},
                        .volume = "K/2 (J - 1)^2",
                        .takes_terms = true,
                        .terms = "the law at once, g_i of its deviator, constant bulk modulus, "
                                 "tau_i; the behaviour integrates Simo's rule, exact for a stress "
                                 "that is linear in each step",
                        .evidence = "run in MTest 5.2"},
      .states_density = false,
      .evidence = Evidence::kRun,
      .evidence_note = "MTest, ramp and hold: 2e-15",
      .advice = "mfront --obuild --interface=generic (or aster, abaqus, calculix, ansys ...).",
      .harmonic = "refused: a behaviour answers in time only"};
}

}  // namespace viscard
