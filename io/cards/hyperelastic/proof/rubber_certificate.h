#pragma once

#include "io/cards/hyperelastic/proof/rubber_proof.h"
#include "io/cards/proof/certificate.h"

namespace viscard {

// The certificate of a card of rubber: its cubes and its hold between what every certificate states.
void show_certificate(ResultVisitor& v, const CertificateRequest& request, const CardChain& chain,
                      const FoundSolver& found, const RubberProof& proof);

}  // namespace viscard
