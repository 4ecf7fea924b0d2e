#pragma once

#include "io/basics/timestamp.h"
#include "io/cards/proof/card_proof.h"

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

// A file that the header of a card states, and whether it is still the same.
struct ChainLink {
  std::string path;    // where it was found; else as stated
  std::string stated;  // SHA-256 in the header
  std::string now;     // of the file; empty if it is not there
  bool matches() const { return !now.empty() && now == stated; }
};

struct CardChain {
  std::string card_sha256;
  ChainLink material;  // empty if the header states none
  std::vector<ChainLink> raw_files;
  bool is_complete() const;  // material and at least one raw file, all unchanged
  // Missing parts of the chain, and what to do about them, one sentence each; empty if it is
  // complete.
  std::vector<std::string> missing() const;
};

// Follows the SHA-256 sums in the header of the card. Files are looked for as stated, then beside
// the material and the card.
CardChain chain_of(const CertificateRequest& request);

// Card, solver and its version, deviations, terms, the models as run, the chain; and the same as JSON.
void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const CardProof& proof);
std::string certificate_text(const CertificateRequest& request, const CardChain& chain,
                             const FoundSolver& found, const CardProof& proof);

}  // namespace viscard
