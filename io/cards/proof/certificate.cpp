#include "io/cards/proof/certificate.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/timestamp.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace viscard {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json json_of(const StepError& error) {
  return {{"error", error.at_step},
          {"at_s", error.worst_s},
          {"predicted_error", error.predicted ? Json(*error.predicted) : Json(nullptr)},
          {"extrapolated_error", error.remaining},
          {"resolved", error.resolved},
          {"vanishes_with_step", error.vanishes_with_step()}};
}

Json json_of(const ChainLink& link) {
  return {{"path", link.path},
          {"sha256_in_card", link.stated},
          {"sha256_now", link.now.empty() ? Json(nullptr) : Json(link.now)},
          {"matches", link.matches()}};
}

Json json_of(const CardChain& chain) {
  Json json{{"card_sha256", chain.card_sha256}, {"material", nullptr}};
  if (!chain.material.stated.empty()) json["material"] = json_of(chain.material);
  json["raw_files"] = Json::array();
  for (const ChainLink& link : chain.raw_files) json["raw_files"].push_back(json_of(link));
  json["complete"] = chain.is_complete();
  json["missing"] = chain.missing();
  return json;
}

void add_terms(const CardProof& proof, Json& json) {
  json["terms"] = Json::array();
  for (const TermProof& term : proof.terms) {
    json["terms"].push_back({{"g", term.g},
                             {"tau_s", term.tau_s},
                             {"change_with_tau", term.change},
                             {"exercised", term.is_exercised}});
  }
  json["divergence"] = nullptr;
  if (const auto& divergence = proof.divergence) {
    json["divergence"] = {{"test", divergence->test},
                          {"reached_s", divergence->reached_s},
                          {"card_blamed", divergence->is_card_blamed}};
  }
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

std::string certificate_text(const CertificateRequest& request, const CardChain& chain,
                             const FoundSolver& found, const CardProof& proof) {
  Json json{{"card", request.card_path},
            {"target", request.target},
            {"compared_with",
             request.material_path.empty() ? Json(nullptr) : Json(request.material_path)},
            {"solver", found.solver.code},
            {"solver_version", found.version},
            {"solver_program", found.program},
            {"created_by", "viscard " VISCARD_VERSION},
            {"created_at", now_iso8601()},
            {"relaxation", json_of(proof.relaxation)},
            {"creep", json_of(proof.creep)},
            {"temperature", nullptr},
            {"end_s", proof.end_s},
            {"increments", proof.increments},
            {"caution", nullptr}};
  if (*found.solver.caution != '\0') json["caution"] = found.solver.caution;
  if (const auto& temperature = proof.temperature) {
    json["temperature"] = json_of(temperature->error);
    json["temperature"]["at_C"] = temperature->at_C;
  }
  add_terms(proof, json);
  json["holds"] = proof.holds();
  json["chain"] = json_of(chain);
  json["models"] = Json::array();
  for (const DeckFile& file : proof.models) {
    json["models"].push_back({{"file", file.name}, {"text", file.text}});
  }
  return text_from_json(json, 2) + "\n";
}

}  // namespace viscard
