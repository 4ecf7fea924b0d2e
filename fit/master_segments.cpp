#include "fit/master_segments.h"

#include "fit/samples/clean_data.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kSameTemperature_K = 1.0;

// Rows sorted by temperature and split where it rises by more than the width of a segment.
std::vector<std::vector<std::size_t>> rows_by_temperature(
    const std::vector<double>& temperature_C) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < temperature_C.size(); ++i) {
    if (std::isfinite(temperature_C[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return temperature_C[a] < temperature_C[b];
  });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t row : order) {
    const bool is_new = groups.empty() || temperature_C[row] - temperature_C[groups.back().back()] >
                                              kSameTemperature_K;
    if (is_new) groups.emplace_back();
    groups.back().push_back(row);
  }
  return groups;
}

// The weights of rows are relative to their values, so a zero would outweigh all other rows.
void check_moduli(const MasterSegment& segment) {
  const bool is_dma = !segment.loss.empty();
  for (std::size_t i = 0; i < segment.value.size(); ++i) {
    if (segment.value[i] != 0.0 || (is_dma && segment.loss[i] != 0.0)) continue;
    throw std::runtime_error("the modulus at " + celsius(segment.temperature_C) + " and " +
                             text_of(segment.argument[i]) + (is_dma ? " Hz" : " s") +
                             " is zero: this is not a measurement. Remove the row");
  }
  check_sign(segment.value, is_dma ? "a storage modulus" : "a relaxation modulus",
             is_dma ? "storage_modulus_Pa" : "modulus_Pa");
  check_loss_sign(segment.loss);
}

}  // namespace

std::string celsius(double temperature_C) {
  return text_of(temperature_C, 4) + " C";
}

std::size_t n_isotherms(const std::vector<double>& temperature_C) {
  return rows_by_temperature(temperature_C).size();
}

MasterSegments segments_of(const MasterData& data) {
  const std::size_t size = data.argument.size();
  const bool is_dma = !data.loss_Pa.empty();
  if (data.temperature_C.size() != size || data.modulus_Pa.size() != size ||
      (is_dma && data.loss_Pa.size() != size)) {
    throw std::invalid_argument("the columns of a master curve differ in length");
  }
  MasterSegments all;
  all.n_left_out = size;
  for (std::vector<std::size_t>& rows : rows_by_temperature(data.temperature_C)) {
    const double temperature_C = data.temperature_C[rows.front()];
    std::erase_if(rows, [&](std::size_t i) {
      return !(data.argument[i] > 0.0) || !std::isfinite(data.modulus_Pa[i]) ||
             (is_dma && !std::isfinite(data.loss_Pa[i]));
    });
    constexpr std::size_t kLeastRows = 3;
    if (rows.size() < kLeastRows) {
      const std::string number = rows.empty() ? "no row" : "only " + counted(rows.size(), "row");
      all.left_out.push_back(celsius(temperature_C) + " (" + number + " with all values)");
      all.n_of_isotherms += rows.size();
      continue;
    }
    std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
      return data.argument[a] < data.argument[b];
    });
    MasterSegment segment;
    for (const std::size_t i : rows) {
      segment.temperature_C += data.temperature_C[i] / static_cast<double>(rows.size());
      segment.argument.push_back(data.argument[i]);
      segment.value.push_back(data.modulus_Pa[i]);
      if (is_dma) segment.loss.push_back(data.loss_Pa[i]);
    }
    check_moduli(segment);
    all.n_left_out -= rows.size();
    all.segments.push_back(std::move(segment));
  }
  if (all.segments.size() < 2) {
    std::string why;
    for (const std::string& one : all.left_out) why += (why.empty() ? "; left out: " : ", ") + one;
    throw std::runtime_error(
        "a master curve needs segments of at least three rows at two or more temperatures (1 K "
        "apart)" +
        why);
  }
  return all;
}

void leave_out(MasterSegments& all, std::size_t first, std::size_t last,
               const std::string& reason) {
  for (std::size_t k = first; k < last; ++k) {
    all.left_out.push_back(celsius(all.segments[k].temperature_C) + " (" + reason + ")");
    all.n_left_out += all.segments[k].value.size();
    all.n_of_isotherms += all.segments[k].value.size();
  }
  const auto begin = all.segments.begin();
  all.segments.erase(begin + static_cast<std::ptrdiff_t>(first),
                     begin + static_cast<std::ptrdiff_t>(last));
}

std::optional<std::size_t> segment_at(const std::vector<MasterSegment>& segments,
                                      double temperature_C) {
  std::optional<std::size_t> nearest;
  double least_K = kSameTemperature_K;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const double apart_K = std::abs(segments[k].temperature_C - temperature_C);
    if (!(apart_K <= least_K)) continue;
    least_K = apart_K;
    nearest = k;
  }
  return nearest;
}

std::string temperatures_of(const std::vector<MasterSegment>& segments) {
  std::string text;
  for (const MasterSegment& segment : segments) {
    text += (text.empty() ? "" : ", ") + celsius(segment.temperature_C);
  }
  return text;
}

std::size_t reference_of(const std::vector<MasterSegment>& segments,
                         const std::optional<double>& T_ref_C) {
  if (!T_ref_C) return segments.size() / 2;
  if (const auto k = segment_at(segments, *T_ref_C)) return *k;
  throw std::runtime_error("no segment was measured at " + celsius(*T_ref_C) + "; there are " +
                           temperatures_of(segments));
}

}  // namespace viscard
