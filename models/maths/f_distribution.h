#pragma once

namespace viscard {

// Probability that a variable of the F distribution with these degrees of freedom exceeds f >= 0.
double f_upper_tail(double f, double numerator_freedom, double denominator_freedom);

}  // namespace viscard
