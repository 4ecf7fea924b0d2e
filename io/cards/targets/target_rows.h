#pragma once

#include "io/cards/card_target.h"

namespace viscard {

// One function per target, defined in the file of its solver.
CardTarget abaqus_target();
CardTarget ansys_target();
CardTarget lsdyna_target();
CardTarget lsdyna006_target();
CardTarget febio_target();
CardTarget febio_uncoupled_target();
CardTarget mfront_target();
CardTarget calculix_target();
CardTarget openradioss_target();
CardTarget comsol_target();
CardTarget moose_target();
CardTarget frontistr_target();
CardTarget json_target();
CardTarget csv_target();

}  // namespace viscard
