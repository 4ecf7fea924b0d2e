#pragma once

#include <optional>
#include <string_view>

namespace viscard {

// Newtons in one unit of force as balances and force gauges write it: N mN kN gf kgf ozf lbf, p
// (pond), and g kg oz lb lbs for the weight of that mass. Case does not matter, except that MN is
// refused. Returns nothing for another word.
// Source: BIPM SI Brochure (standard gravity 9.80665 m/s2); NIST SP 811, B.8 (pound, ounce).
std::optional<double> newtons_per_unit(std::string_view unit);

}  // namespace viscard
