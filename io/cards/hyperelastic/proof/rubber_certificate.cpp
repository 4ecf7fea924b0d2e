#include "io/cards/hyperelastic/proof/rubber_certificate.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/results/result_json.h"

namespace viscard {
namespace {

std::optional<std::string> if_named(const std::string& path) {
  return path.empty() ? std::nullopt : std::optional(path);
}

void show_cubes(ResultVisitor& v, const RubberProof& proof) {
  v.list("cubes", "stretched cubes beside the closed form", proof.cubes, [&](const CubeProof& cube) {
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

void show_chain(ResultVisitor& v, const RubberCertificateRequest& request,
                const HyperelasticFile* file) {
  const auto sum_of = [](const std::string& path) {
    return path.empty() ? "" : sha256_of_file(path);
  };
  const auto raw_files =
      file == nullptr ? std::vector<HyperelasticFile::RawFile>{} : file->raw_files;
  v("card_sha256", sum_of(request.card_path), "sum of the card");
  v.or_null("law_sha256", if_named(sum_of(request.law_path)),
            "sum of the file of the law; null: none was named");
  v.list("raw_files", "tables that the law was fitted to", raw_files,
         [&](const HyperelasticFile::RawFile& raw) {
           v("file", raw.file, "its name");
           v("sha256", raw.sha256, "its sum, as the law states it");
         });
}

}  // namespace

void show_certificate(ResultVisitor& v, const RubberCertificateRequest& request,
                      const HyperelasticFile* file, const FoundSolver& found,
                      const RubberProof& proof) {
  v("card", request.card_path, "the card");
  v("target", request.target, "its solver");
  v.or_null("compared_with", if_named(request.law_path),
            "the file of the law; null: the card as read");
  v("solver", found.solver.code, "that ran it");
  v("solver_version", found.version, "its version");
  v("solver_program", found.program, "its path");
  v("ran_text", runs_text_of(found.solver.name, request.target),
    "false: the solver ran the numbers that were read from the card, not its text");
  v("created_by", "viscard " VISCARD_VERSION, "version of viscard");
  v("created_at", request.created_at, "time");
  v("bulk_modulus_Pa", proof.bulk_Pa, "of the cubes");
  show_cubes(v, proof);
  v.object(
      "relaxation", "a ramp and a hold; null: no terms",
      [&] { show_hold(v, proof.hold.value_or(HoldProof{})); }, !proof.hold);
  v.list("constants", "the constants of the law, and the bulk modulus", proof.constants,
         [&](const ConstantProof& constant) {
           v("name", constant.name, "its name");
           v("value", constant.value, "its value, moduli in Pa");
           v("change", constant.change, "change of a stress if the constant is 10 % off");
           v("exercised", constant.is_exercised, "whether the run would show that");
         });
  v.or_null("diverged", if_named(proof.diverged), "the test that did not converge; null: none");
  v("holds", proof.holds(), "whether the card is proven");
  v.object("chain", "from the card to the raw data", [&] { show_chain(v, request, file); });
  v("models", proof.models, "the models that were run");
}

std::string rubber_certificate_text(const RubberCertificateRequest& request,
                                    const HyperelasticFile* file, const FoundSolver& found,
                                    const RubberProof& proof) {
  const auto json = json_from_keys(
      [&](ResultVisitor& v) { show_certificate(v, request, file, found, proof); });
  return text_from_json(json, 2) + "\n";
}

}  // namespace viscard
