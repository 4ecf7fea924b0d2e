#include "io/basics/inputs.h"
#include "io/basics/number_text.h"
#include "io/basics/written_path.h"
#include "io/flow/predict_file.h"
#include "models/maths/result_visitor.h"

#include <algorithm>

namespace viscard {
namespace {

void show_agreement(ResultVisitor& v, const Agreement& found) {
  v("quantity", found.name, "its name");
  v("n", found.at.size(), "rows compared");
  v("n_left_out", found.n_left_out, "rows before the test");
  v("rms", found.rms, "root mean square difference");
  v("rms_relative", found.rms_relative, "relative to the size of the curve");
  v("worst", found.worst, "largest difference");
  v("worst_at", found.worst_at, "where that is");
  v("share_inside_band", found.share_inside_band, "share of rows inside the band");
  v("share_inside_band_and_noise", found.share_inside_band_and_noise,
    "the same with the noise added");
  v.or_null("agrees", found.agrees,
            "whether at least 80 % of the rows lie inside band and noise; null: there is no band");
  v("noise_sigma", found.noise_sigma, "noise of the rows");
  v("noise_is_relative", found.is_noise_relative, "whether it is relative");
  v("n_inside_window", found.n_inside_window, "rows inside the window");
  v("rms_inside_window", found.rms_inside_window, "root mean square difference there");
}

// All columns of the prediction with their names, in the order of the table.
struct NamedColumn {
  std::string name;
  const std::vector<double>* values;
};
std::vector<NamedColumn> columns_of(const TestPrediction& prediction) {
  std::vector<NamedColumn> columns{{prediction.argument, &prediction.at}};
  if (!prediction.input_name.empty()) columns.push_back({prediction.input_name, &prediction.input});
  for (const PredictedCurve& one : prediction.curves) {
    columns.push_back({one.name, &one.curve.value});
    if (one.curve.low_95.empty()) continue;
    columns.push_back({one.name + "_low_95", &one.curve.low_95});
    columns.push_back({one.name + "_high_95", &one.curve.high_95});
  }
  return columns;
}

}  // namespace

void show_keys(ResultVisitor& v, const PredictedFile& predicted) {
  const TestPrediction& prediction = predicted.prediction;
  v("material", predicted.name, "name of the material");
  v("file", written_path(predicted.path), "its file");
  v.word("test", names_of_predicted_tests()[static_cast<std::size_t>(prediction.test)],
         {"relaxation", "creep", "recovery", "cycles", "oscillation", "history"}, "kind of test");
  v.object(
      "window", "window of the fit; null: not known",
      [&] {
        v("t_min_s", prediction.t_min_s, "begin");
        v("t_max_s", prediction.t_max_s, "end");
      },
      !prediction.is_window_known);
  v("n_outside_window", std::count(prediction.is_inside.begin(), prediction.is_inside.end(), false),
    "points outside it");
  v("has_band", predicted.has_band, "whether the material carries a covariance");
  v("trustworthy", predicted.is_trustworthy, "whether the fit of the material may be used");
  v("flags", predicted.flags, "what limits the trust in the result");
  v("systematic_relative", predicted.systematic_relative,
    "relative standard uncertainty of E0 that further tests on the same bench would not narrow");
  std::vector<NamedColumn> columns = columns_of(prediction);
  columns.push_back({"inside_window", nullptr});
  v.map(
      "curve",
      "columns of the curve, all of one length: time_s or frequency_Hz, the quantity, its _low_95 "
      "and _high_95, inside_window",
      columns, [&](const NamedColumn& column) {
        if (column.values == nullptr) {
          v(column.name, prediction.is_inside, "whether the point is inside the window");
        } else {
          v(column.name, *column.values, "values");
        }
      });
  v.when(!predicted.against.empty(), [&] {
    v.object("against", "the comparison with measured values", [&] {
      v("file", written_path(predicted.against), "the measured table");
      v.list("quantities", "one for each measured column", predicted.agreement,
             [&](const Agreement& found) { show_agreement(v, found); });
      v.list("measured", "the rows of each that were compared", predicted.agreement,
             [&](const Agreement& found) {
               v("quantity", found.name, "its name");
               v("at", found.at, "time_s or frequency_Hz, as in the curve");
               v("values", found.measured, "in the unit of the name");
             });
    });
  });
  v("notes", predicted.notes, "what to keep in mind");
}

std::string csv_from_prediction(const PredictedFile& predicted, const std::string& command) {
  const TestPrediction& prediction = predicted.prediction;
  const std::vector<NamedColumn> columns = columns_of(prediction);
  std::string text = head_of_table(command);
  for (const NamedColumn& column : columns) text += column.name + ",";
  text += "inside_window\n";
  for (std::size_t i = 0; i < prediction.at.size(); ++i) {
    for (const NamedColumn& column : columns) text += text_from_number((*column.values)[i]) + ",";
    text += prediction.is_inside[i] ? "1\n" : "0\n";
  }
  return text;
}

}  // namespace viscard
