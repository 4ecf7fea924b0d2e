#pragma once

namespace viscard {

// The share of a modulus that never relaxes, 1 - sum: exactly 0 if the relaxing shares add up to 1
// within 1e-12, which is a liquid whose shares were rounded.
double lasting_share(double sum);

}  // namespace viscard
