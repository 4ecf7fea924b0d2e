#pragma once

#include "io/basics/timestamp.h"
#include "io/cards/hyperelastic/proof/rubber_proof.h"
#include "io/cards/proof/card_chain.h"

#include <string>

namespace viscard {

// What was proven, with what.
struct RubberCertificateRequest {
  std::string card_path, law_path;  // without a law the card was compared with its own numbers
  std::string target;
  std::string created_at = now_iso8601();
};

// The certificate beside a card: solver, errors, and the chain of the card, of the file of its law and of
// the tables that the law was fitted to.
void show_certificate(ResultVisitor& v, const RubberCertificateRequest& request,
                      const CardChain& chain, const FoundSolver& found, const RubberProof& proof);
// The same as JSON.
std::string rubber_certificate_text(const RubberCertificateRequest& request, const CardChain& chain,
                                    const FoundSolver& found, const RubberProof& proof);

}  // namespace viscard
