#include "io/basics/atomic_file.h"
#include "io/cards/card_sum.h"
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/unit_system.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/materials/hyperelastic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>

namespace viscard {
namespace {

// Parameters by name, in Pa where they are moduli.
std::vector<CardValue> parameters_of(const ReadRubber& read) {
  std::vector<CardValue> out;
  const HyperelasticLaw& law = read.law;
  for (Eigen::Index i = 0; read.foam && i < read.foam->mu_Pa.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    out.push_back({"mu_" + number + "_Pa", read.foam->mu_Pa[i]});
    out.push_back({"alpha_" + number, read.foam->alpha[i]});
    out.push_back({"nu_" + number, read.foam->nu[i]});
  }
  if (read.foam) return out;
  const auto moduli = modulus_names(law.form), shapes = shape_names(law.form);
  for (std::size_t i = 0; i < moduli.size(); ++i)
    out.push_back({moduli[i], law.moduli_Pa[static_cast<Eigen::Index>(i)]});
  for (std::size_t i = 0; i < shapes.size(); ++i)
    out.push_back({shapes[i], law.shapes[static_cast<Eigen::Index>(i)]});
  return out;
}

CheckedCard checked(const RubberCheck& check) {
  return {check.findings, check.agrees, check.difference.has_value(), check.tolerance, "law"};
}

void show_check(ResultVisitor& v, const RubberCheck& check, const CardWords& words) {
  const ReadRubber& read = check.read;
  v("card", words.check, "the card");
  v("target", words.target, "its solver");
  v("units", read.units == nullptr ? "" : read.units->name, "its unit system");
  v("agrees", check.agrees, "whether card and material agree");
  v("verdict", verdict_of(checked(check)), "what the check found, in words");
  v("law", name_of(read), "name of the law");
  v.word("basis", read.is_long_term ? "long-term" : "instantaneous", {"instantaneous", "long-term"},
         "which law stands in the card");
  v.list("parameters", "the law at once", parameters_of(read), [&](const CardValue& value) {
    v("name", value.name, "its name; moduli in Pa");
    v("value", value.value, "its value");
  });
  v.list("terms", "its terms of relaxation", read.terms, [&](const RubberTerm& term) {
    v("g", term.g, "share of the law at once");
    v("tau_s", term.tau_s, "its time");
  });
  v.when(read.damage.has_value(), [&] {
    const MullinsDamage damage = read.damage.value_or(MullinsDamage{});
    v.object("damage", "softening by the first loading (mullins-or)", [&] {
      v("r", damage.r, "pure number");
      v("m_Pa", damage.m_Pa, "energy per volume");
      v("beta", damage.beta, "pure number");
    });
  });
  v("bulk_modulus_Pa",
    number_or_null(read.bulk_Pa > 0.0 ? std::optional(read.bulk_Pa) : std::nullopt),
    "null: incompressible");
  v("tolerance", check.tolerance, "largest relative difference allowed");
  v("difference", number_or_null(check.difference),
    "largest relative difference of a parameter; null: no law was named");
  v("findings", check.findings, "mistakes and notes");
}

void print_rubber_check(const RubberCheck& check, const CardWords& words, std::ostream& out) {
  const ReadRubber& read = check.read;
  const CheckedCard verdict = checked(check);
  out << words.check << ": " << name_of(read) << " for " << words.target << ", units "
      << read.units->name << (read.units_were_stated || !words.units.empty() ? "" : " (not stated)")
      << "\n";
  if (read.is_long_term) out << "the card has the law after all relaxation; here it is at once:\n";
  for (const CardValue& value : parameters_of(read))
    out << fmt::format("  {} = {:.9g}\n", value.name, value.value);
  for (std::size_t i = 0; i < read.terms.size(); ++i) {
    out << fmt::format("  term {}: g = {:.9g}, tau = {:.9g} s\n", i + 1, read.terms[i].g,
                       read.terms[i].tau_s);
  }
  if (read.damage) {
    out << fmt::format("  damage {}: r = {:.9g}, m = {:.9g} Pa, beta = {:.9g}\n", kMullinsName,
                       read.damage->r, read.damage->m_Pa, read.damage->beta);
  }
  out << (read.bulk_Pa > 0.0 ? fmt::format("  bulk modulus = {:.9g} Pa\n", read.bulk_Pa)
                             : std::string("  incompressible\n"));
  if (check.difference)
    out << fmt::format("largest difference of a parameter: {:.2e}\n", *check.difference);
  for (const CardFinding& finding : check.findings) {
    out << (finding.is_mistake ? "mistake " : "note ") << finding.name << ": " << finding.text
        << "\n";
  }
  out << verdict_of(verdict) << verdict_hint(verdict) << "\n";
}

// True if the law of a card is one of rubber, or the file that it is compared with; takes the target that it
// states.
bool is_card_of_rubber(const std::string& path, CardWords& words) {
  if (path.empty()) return false;
  const std::string text = card_text_of(path, words);
  const bool has_law = !words.material.empty() && looks_like_hyperelastic_file(words.material);
  if (!has_law && !looks_like_rubber_card(text)) return false;
  if (words.target.empty()) words.target = stated_rubber_target(text);
  return true;
}

}  // namespace

bool is_rubber_check(CardWords& words) {
  return is_card_of_rubber(words.check, words);
}

bool is_rubber_proof(CardWords& words) {
  return is_card_of_rubber(words.prove, words);
}

DescribedResult result_of_rubber_check() {
  RubberCheck check;
  check.read.law.moduli_Pa = Eigen::VectorXd::Zero(n_moduli(check.read.law.form));
  check.read.law.shapes = Eigen::VectorXd::Zero(n_shapes(check.read.law.form));
  return {"card-rubber-check",
          "viscard card --check of a card of rubber",
          {[check](ResultVisitor& v) { show_check(v, check, CardWords{}); }}};
}

int check_rubber_file(const CardWords& words, Streams& streams) {
  std::optional<HyperelasticFile> file;
  if (!words.material.empty()) file = read_hyperelastic(words.material, words.plausible);
  const RubberCheck check = [&] {
    try {
      return check_rubber_card(card_text_of(words.check, words), file ? &*file : nullptr,
                               {.target = words.target,
                                .units = words.units,
                                .tolerance = words.tolerance,
                                .bulk_Pa = words.bulk_Pa,
                                .density_kg_m3 = words.density_kg_m3,
                                .plausible = words.plausible,
                                .elastic_only = words.elastic_only});
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(words.check + ": " + error.what());
    }
  }();
  if (words.json) {
    Words inputs{words.check};
    if (!words.material.empty()) inputs.push_back(words.material);
    print_result(
        {"viscard-card-rubber-check/1", inputs},
        [&](ResultVisitor& v) { show_check(v, check, words); }, streams);
  } else {
    print_rubber_check(check, words, FittedText(streams));
  }
  return check.agrees ? kDone : kFailed;
}

}  // namespace viscard
