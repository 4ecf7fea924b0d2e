#pragma once

#include "io/basics/timestamp.h"
#include "io/cards/proof/card_chain.h"
#include "io/cards/proof/card_proof.h"
#include "io/cards/proof/law_proof.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

struct CertificateRequest {
  std::string card_path;
  std::string card_text;
  std::string material_path;  // empty: the card was compared with its own numbers
  std::string target;
  std::string created_at = now_iso8601();
};
// Of the card, which lies at its path.
CardChain chain_of(const CertificateRequest& request);

// A certificate ends with the SHA-256 of its own text in which 64 zeros stand for that sum; puts it in.
std::string sealed_certificate(const std::string& text);
// Whether the sum of a certificate is that of its text.
bool is_certificate_unchanged(const std::string& text);

// What every certificate begins with: statement, card, solver and its version.
void show_head(ResultVisitor& v, const CertificateRequest& request, const std::string& statement,
               const FoundSolver& found);
// And ends with: whether card and numbers hold, the chain, the models as run, the sum.
void show_end(ResultVisitor& v, const std::string& statement, bool holds,
              const std::function<void()>& show_chain, const std::vector<DeckFile>& models);
// The keys as JSON with their sum.
std::string certificate_text(const std::function<void(ResultVisitor&)>& show);

// Of a card of Prony series: deviations, terms; and the same as JSON.
void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const CardProof& proof);
// Of a card of a law of rubber: its cubes and its hold.
void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const LawProof& proof);
std::string certificate_text(const CertificateRequest& request, const CardChain& chain,
                             const FoundSolver& found, const CardProof& proof);

}  // namespace viscard
