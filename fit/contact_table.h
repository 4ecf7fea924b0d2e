#pragma once

#include "fit/curves/history_model.h"
#include "fit/samples/check_record.h"
#include "fit/samples/contact_onset.h"
#include "fit/samples/fit_data.h"
#include "models/material/prony_series.h"

#include <cstddef>
#include <vector>

namespace viscard {

// A table of force and depth, prepared for a fit: rows without numbers, spikes, rows of an earlier
// touch and the frame's part of the depth are removed.
struct ContactTable {
  std::vector<double> time_s, force_N, depth_m;
  DepthLaw law{1.0, 1.0};
  TableContact contact;
  std::size_t loaded = 0;  // index of the end of the first loading
  bool goes_back = false;  // the punch is pulled back by at least a fifth of its travel
  RecordNotes notes;       // of the check of the record
  // Before these rows: an earlier touch, which a specimen under a flat punch remembers.
  Course touch_m;
  // Rows left out, by reason.
  std::size_t n_not_a_number = 0, n_spikes = 0, n_depth_spikes = 0, n_touch = 0;
};

inline constexpr std::size_t kLeastContactRows = 6;

// Throws std::runtime_error if the force is constant or negative, or the depth falls with the force.
ContactTable contact_table(const IndentationData& data);

// The record up to the first loss of contact. Under a sphere or cone: up to where the depth begins
// to fall, because the hereditary integral holds while the contact does not shrink.
HistoryInput first_contact(const ContactTable& table);

// The whole record under a flat punch, with contact lost and made again as the series predicts
// (contact_course.h), and what an earlier touch has left. Rows in tension (adhesion) are left out if there are many.
struct WholeRecord {
  HistoryInput input;
  std::size_t n_contacts = 1, n_adhesion = 0;
};
WholeRecord whole_record(const ContactTable& table, const PronySeries& series, double contact_m,
                         bool with_drift);

}  // namespace viscard
