#include "io/cards/hyperelastic/proof/rubber_certificate.h"

#include "io/results/result_json.h"

#include <filesystem>

namespace viscard {
namespace {

std::optional<std::string> if_named(const std::string& path) {
  return path.empty() ? std::nullopt : std::optional(path);
}

void show_cubes(ResultVisitor& v, const RubberProof& proof) {
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

void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const RubberProof& proof) {
  const std::string statement = statement_of_rubber(found.solver, request.target);
  show_head(v, request, statement, found);
  v("ran_text", runs_text_of(found.solver.name, request.target),
    "false: the solver ran the numbers that were read from the card, not its text");
  v("bulk_modulus_Pa", proof.bulk_Pa, "of the cubes");
  show_cubes(v, proof);
  v.object(
      "relaxation", "a ramp and a hold; null: no terms",
      [&] { show_hold(v, proof.hold.value_or(HoldProof{})); }, !proof.hold);
  v("constants", proof.constants, "the constants of the law, its shares, and the bulk modulus");
  v.or_null("diverged", if_named(proof.diverged), "the test that did not converge; null: none");
  v.or_null("caution", if_named(proof.caution),
            "what to know before trusting a run in this solver");
  const auto show_chain = [&] {
    show_ends(v, chain);
    v.list("raw_files", "tables that the law was fitted to", chain.raw_files,
           [&](const ChainLink& link) {
             v("file", std::filesystem::path(link.path).filename().string(), "its name");
             v("sha256", link.stated, "its sum, as the card states it");
             show_keys(v, link);
           });
    v.or_null("law_sha256", if_named(chain.material.now),
              "sum of the file of the law; null: it is not here");
  };
  show_end(v, statement, proof.holds(), show_chain, proof.models);
}

}  // namespace viscard
