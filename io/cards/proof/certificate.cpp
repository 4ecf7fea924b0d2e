#include "io/cards/proof/certificate.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/program.h"
#include "io/basics/sha256.h"
#include "io/basics/written_path.h"
#include "io/results/result_json.h"

#include <filesystem>

namespace viscard {
namespace {

const std::string kUnsealed(64, '0');
constexpr const char* kSumKey = "\"certificate_sha256\": \"";
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

void show_proof(ResultVisitor& v, const CardProof& proof) {
  v("terms", proof.terms, "the terms");
  v("constants", proof.constants, "the other constants of the card");
  const SolverDivergence divergence = proof.divergence.value_or(SolverDivergence{});
  v.object(
      "divergence", "null: the solver went to the end",
      [&] {
        v("test", divergence.test, "which test");
        v("reached_s", divergence.reached_s, "how far");
        v("card_blamed", divergence.is_card_blamed, "whether the card is the cause");
      },
      !proof.divergence);
}

void show_cubes(ResultVisitor& v, const LawProof& proof) {
  v.list("cubes", "stretched cubes beside the closed form", proof.cubes,
         [&](const CubeProof& cube) {
           v("test", cube.test.name, "uniaxial, compression, planar or equibiaxial");
           v("to_stretch", cube.test.top, "largest stretch");
           v("steps", cube.test.steps, "to it");
           v("compared", cube.compared,
             "steps that were compared; the solver left the others out of balance by more than is "
             "resolved");
           v("error", cube.error,
             "largest relative difference of the nominal stress; null: none could be computed");
           v("at_stretch", cube.at_stretch, "where");
           v("resolved", cube.resolved, "smallest error that the run shows");
           v("agrees", cube.agrees(), "whether the error is below it");
         });
}

void show_hold(ResultVisitor& v, const HoldProof& hold) {
  v("end_s", hold.end_s, "its length");
  v("error", hold.error, "largest relative difference of the nominal stress");
  v("at_s", hold.at_s, "when");
  v("resolved", hold.resolved, "smallest error that the run shows");
  v("agrees", hold.agrees(), "whether the error is below it");
  v("terms", hold.terms, "the terms");
}

}  // namespace

CardChain chain_of(const CertificateRequest& request) {
  return chain_of(request.card_path, read_file(request.card_path), request.material_path);
}

std::string sealed_certificate(const std::string& text) {
  const std::size_t at = text.rfind(kSumKey);
  if (at == std::string::npos) return text;
  const std::size_t digits = at + std::string(kSumKey).size();
  std::string out = text;
  out.replace(digits, kUnsealed.size(), kUnsealed);
  return out.replace(digits, kUnsealed.size(), sha256_of_text(out));
}

bool is_certificate_unchanged(const std::string& text) {
  std::string written = text;
  std::erase(written, '\r');  // the line ends of Windows are no edit; JSON escapes any other
  return written.rfind(kSumKey) != std::string::npos && sealed_certificate(written) == written;
}

void show_head(ResultVisitor& v, const CertificateRequest& request, const std::string& statement,
               const FoundSolver& found) {
  v("statement", statement.empty() ? "the solver read the card itself" : statement,
    "which text was run");
  v("card", written_path(request.card_path), "the card");
  v("target", request.target, "its solver");
  v.or_null("compared_with", unless_empty(written_path(request.material_path)),
            "the material file or that of the law; null: the card as read");
  v("solver", found.solver.code, "that ran it");
  v("solver_version", found.version, "its version");
  v("solver_program", found.program, "its path");
  v("created_by", program_with_version(), "version of viscard");
  v("created_at", request.created_at, "time");
}

void show_end(ResultVisitor& v, const std::string& statement, bool holds,
              const std::function<void()>& show_chain, const std::vector<DeckFile>& models) {
  v("holds", holds && statement.empty(), "whether the card is proven, by its own solver");
  v("numbers_hold", holds, "whether its numbers are proven, by any solver");
  v.object("chain", "from the card to the raw data", show_chain);
  v("models", models, "the models that were run");
  v("certificate_sha256", kUnsealed,
    "sum of the certificate with 64 zeros here; of --json not computed");
}

std::string certificate_text(const std::function<void(ResultVisitor&)>& show) {
  return sealed_certificate(text_from_json(json_from_keys(show), 2) + "\n");
}

void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const CardProof& proof) {
  const std::string statement = statement_of(found.solver, request.target);
  show_head(v, request, statement, found);
  v.object("relaxation", "the test of relaxation", [&] { show_error(v, proof.relaxation); });
  v.object("creep", "the test of creep", [&] { show_error(v, proof.creep); });
  const StepError confined = proof.confined.value_or(StepError{});
  v.object(
      "confined", "creep with held sides, of OpenRadioss relaxation; null: not run",
      [&] { show_error(v, confined); }, !proof.confined);
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
  show_end(
      v, statement, proof.holds(), [&] { show_keys(v, chain); }, proof.models);
}

void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const LawProof& proof) {
  const std::string statement = statement_of_law(found.solver, request.target);
  show_head(v, request, statement, found);
  v("ran_text", runs_law_of(found.solver, request.target),
    "false: the solver ran the numbers that were read from the card, not its text");
  v("bulk_modulus_Pa", proof.bulk_Pa, "of the cubes");
  show_cubes(v, proof);
  v.object(
      "relaxation", "a ramp and a hold; null: no terms",
      [&] { show_hold(v, proof.hold.value_or(HoldProof{})); }, !proof.hold);
  v("constants", proof.constants, "the constants of the law, its shares, and the bulk modulus");
  v.or_null("diverged", unless_empty(proof.diverged), "the test that did not converge; null: none");
  v.or_null("caution", unless_empty(proof.caution),
            "what to know before trusting a run in this solver");
  const auto show_chain = [&] {
    show_ends(v, chain);
    v.list("raw_files", "tables that the law was fitted to", chain.raw_files,
           [&](const ChainLink& link) {
             v("file", std::filesystem::path(link.path).filename().string(), "its name");
             v("sha256", link.stated, "its sum, as the card states it");
             show_keys(v, link);
           });
    v.or_null("law_sha256", unless_empty(chain.material.now),
              "sum of the file of the law; null: it is not here");
  };
  show_end(v, statement, proof.holds(), show_chain, proof.models);
}

std::string certificate_text(const CertificateRequest& request, const CardChain& chain,
                             const FoundSolver& found, const CardProof& proof) {
  return certificate_text(
      [&](ResultVisitor& v) { show_certificate(v, request, chain, found, proof); });
}

}  // namespace viscard
