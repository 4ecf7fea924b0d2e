#include "io/cards/proof/certificate.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/results/result_json.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace viscard {
namespace {

namespace fs = std::filesystem;
void show_error(ResultVisitor& v, const StepError& error) {
  v("error", error.at_step, "largest relative difference at the given step");
  v("at_s", error.worst_s, "when");
  v("predicted_error", number_or_null(error.predicted), "that backward Euler makes");
  v("extrapolated_error", error.remaining, "at no step");
  v("resolved", error.resolved, "what the extrapolation resolves");
  v("vanishes_with_step", error.vanishes_with_step(), "whether the error is that of the step");
}

std::optional<std::string> unless_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

void show_link(ResultVisitor& v, const ChainLink& link) {
  v("path", link.path, "the file");
  v("sha256_in_card", link.stated, "its sum as stated");
  v.or_null("sha256_now", unless_empty(link.now), "its sum now; null: not here");
  v("matches", link.matches(), "whether both agree");
}

void show_chain(ResultVisitor& v, const CardChain& chain) {
  v("card_sha256", chain.card_sha256, "sum of the card");
  v.object(
      "material", "the material file", [&] { show_link(v, chain.material); },
      chain.material.stated.empty());
  v.list("raw_files", "the raw data", chain.raw_files,
         [&](const ChainLink& link) { show_link(v, link); });
  v("complete", chain.is_complete(), "whether all sums match");
  v("missing", chain.missing(), "what is missing or has changed, and what to do");
}

void show_proof(ResultVisitor& v, const CardProof& proof) {
  v("terms", proof.terms, "the terms");
  const SolverDivergence divergence = proof.divergence.value_or(SolverDivergence{});
  v.object(
      "divergence", "null: the solver went to the end",
      [&] {
        v("test", divergence.test, "which test");
        v("reached_s", divergence.reached_s, "how far");
        v("card_blamed", divergence.is_card_blamed, "whether the card is the cause");
      },
      !proof.divergence);
  v("holds", proof.holds(), "whether the card is proven");
}

// The file as stated, or the file of that name beside one of the others.
void look_for(const std::vector<std::string>& others, ChainLink& link) {
  std::vector<fs::path> places{link.path};
  for (const std::string& other : others) {
    if (!other.empty()) places.push_back(fs::path(other).parent_path() / fs::path(link.path));
  }
  std::error_code ignored;
  const auto found = std::find_if(places.begin(), places.end(), [&](const fs::path& place) {
    return !place.empty() && fs::is_regular_file(place, ignored);
  });
  if (found == places.end()) return;
  link.path = found->string();
  link.now = sha256_of_file(*found);
}

}  // namespace

bool CardChain::is_complete() const {
  return material.matches() && !raw_files.empty() &&
         std::all_of(raw_files.begin(), raw_files.end(),
                     [](const ChainLink& link) { return link.matches(); });
}

std::vector<std::string> CardChain::missing() const {
  if (material.stated.empty()) {
    return {
        "the card's header states no sums; write the card with viscard card MATERIAL.json --for "
        "TARGET --out FILE"};
  }
  std::vector<std::string> out;
  if (material.path.empty()) {
    out.emplace_back(
        "no material file was named; repeat with viscard card MATERIAL.json --prove CARD");
  } else if (material.now.empty()) {
    out.push_back(material.path + ", the material file, is not here");
  } else if (!material.matches()) {
    out.push_back(material.path + " has changed since the card was written; write the card again");
  }
  for (const ChainLink& link : raw_files) {
    if (link.matches()) continue;
    out.push_back(link.path + (link.now.empty()
                                   ? " is not here; put it beside the material file"
                                   : " has changed since the card was written; fit it again"));
  }
  if (raw_files.empty()) {
    out.emplace_back(
        "the material names no raw data: it was typed in or fitted without them; viscard fit "
        "writes a material file that names them");
  }
  return out;
}

CardChain chain_of(const CertificateRequest& request) {
  const std::string material_mark = "material file sha256 ", raw_mark = "raw data ",
                    sum_mark = " sha256 ";
  constexpr std::size_t kDigits = 64;
  CardChain chain{
      .card_sha256 = sha256_of_file(request.card_path), .material = {}, .raw_files = {}};
  std::istringstream lines(request.card_text);
  for (std::string line; std::getline(lines, line);) {
    if (const std::size_t at = line.find(material_mark); at != std::string::npos) {
      chain.material = {request.material_path, line.substr(at + material_mark.size(), kDigits), ""};
    }
    const std::size_t at = line.find(raw_mark), sum = line.rfind(sum_mark);
    if (at == std::string::npos || sum == std::string::npos || sum < at) continue;
    const std::size_t begin = at + raw_mark.size();
    chain.raw_files.push_back(
        {line.substr(begin, sum - begin), line.substr(sum + sum_mark.size(), kDigits), ""});
  }
  look_for({}, chain.material);
  for (ChainLink& link : chain.raw_files) {
    look_for({request.material_path, request.card_path}, link);
  }
  return chain;
}

void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const CardProof& proof) {
  v("card", request.card_path, "the card");
  v("target", request.target, "its solver");
  v.or_null("compared_with", unless_empty(request.material_path),
            "the material file; null: the card as read");
  v("solver", found.solver.code, "that ran it");
  v("solver_version", found.version, "its version");
  v("solver_program", found.program, "its path");
  v("created_by", "viscard " VISCARD_VERSION, "version of viscard");
  v("created_at", request.created_at, "time");
  v.object("relaxation", "the test of relaxation", [&] { show_error(v, proof.relaxation); });
  v.object("creep", "the test of creep", [&] { show_error(v, proof.creep); });
  const TemperatureProof warm = proof.temperature.value_or(TemperatureProof{});
  v.object(
      "temperature",
      "relaxation 10 K above the reference temperature of the shift; null: no shift, or the solver "
      "does not read it",
      [&] {
        show_error(v, warm.error);
        v("at_C", warm.at_C, "its temperature");
      },
      !proof.temperature);
  v("end_s", proof.end_s, "length of the tests");
  v("increments", proof.increments,
    "their steps; of OpenRadioss the times at which answers were compared");
  v.or_null("caution", unless_empty(found.solver.caution),
            "what to know before trusting a run in this solver");
  show_proof(v, proof);
  v.object("chain", "from the card to the raw data", [&] { show_chain(v, chain); });
  v("models", proof.models, "the models that were run");
}

std::string certificate_text(const CertificateRequest& request, const CardChain& chain,
                             const FoundSolver& found, const CardProof& proof) {
  const auto json = json_from_keys(
      [&](ResultVisitor& v) { show_certificate(v, request, chain, found, proof); });
  return text_from_json(json, 2) + "\n";
}

}  // namespace viscard
