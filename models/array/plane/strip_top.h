#pragma once

#include "models/array/contact/strip_contact.h"
#include "models/array/plane/array_pieces.h"

namespace viscard {

// The top of a strip on a rigid base, with equal elements of degree 2 across it (3 where pressures are
// condensed), graded toward its corners (eq. A7).
StripCompliance strip_compliance(const ArrayGeometry& geometry, const ArrayMedia& media,
                                 int elements);

// Amplitudes in Pa of the tractions of degrees 0 to `top_degree` that have the moments of nodal forces
// (along, then down) on the top: ports x 2 nodes. Its transpose gives the motions of the nodes along
// and downward that have given readings of those ports.
Eigen::MatrixXd traction_amplitudes(const StripCompliance& strip, int top_degree);

}  // namespace viscard
