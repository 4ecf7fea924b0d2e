#include "models/maths/distributions.h"

#include "models/maths/require.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>

namespace viscard {

double f_upper_tail(double f, double numerator_freedom, double denominator_freedom) {
  if (std::isinf(f)) return 0.0;
  const boost::math::fisher_f of(numerator_freedom, denominator_freedom);
  return boost::math::cdf(boost::math::complement(of, f));
}

double student_t_975(double degrees_of_freedom) {
  require(degrees_of_freedom > 0.0, "Student's t needs more than zero degrees of freedom");
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

}  // namespace viscard
