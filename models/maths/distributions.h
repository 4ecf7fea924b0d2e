#pragma once

namespace viscard {

// Probability that a variable of the F distribution with these degrees of freedom exceeds f >= 0.
double f_upper_tail(double f, double numerator_freedom, double denominator_freedom);

// 97.5 % quantile of Student's t; the degrees of freedom need not be whole. Throws
// std::invalid_argument unless they are positive.
double student_t_975(double degrees_of_freedom);

}  // namespace viscard
