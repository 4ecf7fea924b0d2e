#pragma once

#include "fit/curves/dma_model.h"
#include "fit/intervals/fit_result.h"
#include "models/maths/interval.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace viscard {

// A range of frequencies in which one modulus differs from what the other one allows.
struct KramersKronigBreak {
  bool is_loss = false;  // the loss modulus differs; otherwise the storage modulus
  double from_Hz = 0.0, to_Hz = 0.0;
  double excess = 0.0;  // measured over allowed value, minus one
  Interval excess_95;
};

// Storage and loss modulus of a linear material follow from one spectrum (Kramers-Kronig). Compares
// the data with the best non-negative spectrum of both, on a grid of times that extends three
// decades beyond the measured frequencies at both ends, with a dashpot beyond the fast end and a
// plateau beyond the slow one, and with the times of the fit, because a single term between two times
// of the grid is narrower than any spectrum on it. Then every range of at least half a decade of one modulus may be
// scaled by a factor of its own. The range that lowers the sum of squares most is returned if its
// factor is significant (F-test with the degrees of freedom of both fits, against the scatter that
// remains, at a level that allows for the number of ranges) and above 2 %. The linear test of
// impedance spectra with a fixed grid of times is that of Boukamp, J. Electrochem. Soc. 142 (1995)
// 1885.
std::optional<KramersKronigBreak> kramers_kronig_break(const DmaModel& model,
                                                       const Eigen::VectorXd& fitted_ln_tau);

// Adds the flag storage-loss-contradict. where: follows "the loss modulus", such as " at 60 C"; may be empty.
void add_contradiction(const KramersKronigBreak& found, const std::string& where,
                       FitResult& result);

}  // namespace viscard
