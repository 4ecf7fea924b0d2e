#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/contact_table.h"
#include "fit/curves/history_model.h"
#include "fit/samples/fit_data.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace viscard {

// A model of the record, or of a part of it, and its fit.
struct HistoryFit {
  std::unique_ptr<HistoryModel> model;
  HistoryInput input;
  SpectralFit fit;
  std::size_t n_contacts = 1, n_adhesion = 0;

  double zero_s() const {
    return input.step_s.value_or(input.time_s[std::min(input.contact, input.time_s.size() - 1)]);
  }
};

HistoryFit fit_history(HistoryInput input, const FitOptions& options);

// Fits the whole record of a punch that is pulled back. The series determines when the punch is in
// contact. If the whole record needs another number of terms than the first contact, the contact
// history is computed again with that number.
HistoryFit fit_whole(const ContactTable& table, HistoryFit fitted, const FitOptions& options);

}  // namespace viscard
