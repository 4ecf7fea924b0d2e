#pragma once

namespace viscard {

// How a number is distributed.
enum class Spread {
  kNormal,     // half_width is that of the 95 % interval
  kUniform,    // value - half_width to value + half_width, nothing beyond
  kLognormal,  // value is the median; 95 % lie between value/q and value*q, q = 1 + half_width/value
};

// A number that is not known exactly.
struct UncertainNumber {
  double value = 0.0;       // in the unit of its quantity
  double half_width = 0.0;  // in the same unit
  Spread spread = Spread::kNormal;
};

const char* name_of(Spread spread);  // "normal", "uniform", "lognormal"

// Throws std::invalid_argument unless the half-width is positive, and a lognormal value too.
void validate(const UncertainNumber& number);

// Standard deviation; of a lognormal number that of its logarithm times its median.
double standard_uncertainty(const UncertainNumber& number);

// The number at a standard deviate (mean 0, variance 1); of a uniform one it lies within +-sqrt(3).
double value_at(const UncertainNumber& number, double deviate);

// The largest magnitude of the standard deviate of a uniform number, sqrt(3).
extern const double kLargestUniformDeviate;

}  // namespace viscard
