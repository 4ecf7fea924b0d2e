#include "io/cards/hyperelastic/proof/rubber_certificate.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/timestamp.h"

#include <nlohmann/json.hpp>

namespace viscard {
namespace {

using ProofJson = nlohmann::ordered_json;

ProofJson json_of_cubes(const RubberProof& proof) {
  ProofJson out = ProofJson::array();
  for (const CubeProof& cube : proof.cubes) {
    out.push_back({{"test", cube.test.name},
                   {"to_stretch", cube.test.top},
                   {"steps", cube.test.steps},
                   {"compared", cube.compared},
                   {"error", cube.error},
                   {"at_stretch", cube.at_stretch},
                   {"resolved", cube.resolved},
                   {"agrees", cube.agrees()}});
  }
  return out;
}

ProofJson json_of_hold(const HoldProof& hold) {
  ProofJson terms = ProofJson::array();
  for (const TermProof& term : hold.terms) {
    terms.push_back({{"g", term.g},
                     {"tau_s", term.tau_s},
                     {"change_with_tau", term.change},
                     {"exercised", term.is_exercised}});
  }
  return {{"end_s", hold.end_s},       {"error", hold.error},     {"at_s", hold.at_s},
          {"resolved", hold.resolved}, {"agrees", hold.agrees()}, {"terms", terms}};
}

}  // namespace

std::string rubber_certificate_text(const RubberCertificateRequest& request,
                                    const HyperelasticFile* file, const FoundSolver& found,
                                    const RubberProof& proof) {
  ProofJson json{
      {"card", request.card_path},
      {"target", request.target},
      {"compared_with",
       request.law_path.empty() ? ProofJson(nullptr) : ProofJson(request.law_path)},
      {"solver", found.solver.code},
      {"solver_version", found.version},
      {"solver_program", found.program},
      {"ran_text", runs_text_of(found.solver.name, request.target)},
      {"created_by", "viscard " VISCARD_VERSION},
      {"created_at", now_iso8601()},
      {"bulk_modulus_Pa", proof.bulk_Pa},
      {"cubes", json_of_cubes(proof)},
      {"relaxation", proof.hold ? json_of_hold(*proof.hold) : ProofJson(nullptr)},
      {"constants", ProofJson::array()},
      {"diverged", proof.diverged.empty() ? ProofJson(nullptr) : ProofJson(proof.diverged)},
      {"holds", proof.holds()}};
  for (const ConstantProof& constant : proof.constants) {
    json["constants"].push_back({{"name", constant.name},
                                 {"value", constant.value},
                                 {"change", constant.change},
                                 {"exercised", constant.is_exercised}});
  }
  json["chain"] = {
      {"card_sha256", sha256_of_file(request.card_path)},
      {"law_sha256",
       request.law_path.empty() ? ProofJson(nullptr) : ProofJson(sha256_of_file(request.law_path))},
      {"raw_files", ProofJson::array()}};
  if (file != nullptr) {
    for (const auto& raw : file->raw_files)
      json["chain"]["raw_files"].push_back({{"file", raw.file}, {"sha256", raw.sha256}});
  }
  json["models"] = ProofJson::array();
  for (const DeckFile& model : proof.models)
    json["models"].push_back({{"file", model.name}, {"text", model.text}});
  return text_from_json(json, 2) + "\n";
}

}  // namespace viscard
