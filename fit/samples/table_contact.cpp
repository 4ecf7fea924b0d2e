#include "fit/samples/contact_onset.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Column = std::vector<double>;

// True if the force rises over the first samples as in contact. Then there is no stretch out of
// contact, and the offset of the line's zero is the curvature of a relaxing material.
bool rises_like_contact(const Column& force_N, const Column& depth_m, std::size_t count,
                        double slope) {
  const auto n = static_cast<double>(count);
  double sd = 0, sf = 0, sdd = 0, sdf = 0, sff = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double d = depth_m[i] - depth_m[0], f = force_N[i] - force_N[0];
    sd += d;
    sf += f;
    sdd += d * d;
    sdf += d * f;
    sff += f * f;
  }
  const double spread = sdd - sd * sd / n, product = sdf - sd * sf / n;
  if (!(spread > 0.0)) return false;
  const double rise = product / spread;
  const double left = std::max(0.0, sff - sf * sf / n - rise * product);
  const double error = std::sqrt(left / (n - 2.0) / spread);
  return rise - 2.0 * error > 0.5 * slope;
}

}  // namespace

TableContact find_contact(const Column& force_N, const Column& depth_m, std::size_t loaded,
                          double power) {
  TableContact contact;
  // Force at no load: the tenth percentile of the samples up to the end of loading.
  Column before(force_N.begin(), force_N.begin() + static_cast<std::ptrdiff_t>(loaded) + 1);
  std::sort(before.begin(), before.end());
  const double zero_N = before[before.size() / 10];
  const double peak_N = before.back() - zero_N;
  double n = 0, sd = 0, sf = 0, sdd = 0, sdf = 0;
  for (std::size_t i = 0; i <= loaded; ++i) {
    double force = force_N[i] - zero_N;
    if (force < 0.2 * peak_N || force > 0.8 * peak_N) continue;
    if (power != 1.0) force = std::pow(force, 1.0 / power);
    const double d = depth_m[i] - depth_m[loaded];
    n += 1.0;
    sd += d;
    sf += force;
    sdd += d * d;
    sdf += d * force;
  }
  const double determinant = n * sdd - sd * sd;
  if (n < 3.0 || !(determinant > 0.0)) return contact;
  const double slope = (n * sdf - sd * sf) / determinant;
  if (!(slope > 0.0)) return contact;
  contact.depth_m = depth_m[loaded] + (sd * slope - sf) / (n * slope);
  while (contact.first < loaded && depth_m[contact.first] <= contact.depth_m) ++contact.first;
  constexpr std::size_t kFewSamples = 5;
  contact.is_fitted = contact.first >= kFewSamples &&
                      !(power == 1.0 && rises_like_contact(force_N, depth_m, contact.first, slope));
  if (!contact.is_fitted) contact = {};
  return contact;
}

std::size_t end_of_earlier_touch(const Column& depth_m, std::size_t loaded, double contact_m) {
  constexpr double kDeep = 0.05;  // share of the depth; smaller excursions are noise around contact
  const double deep_m = contact_m + kDeep * (depth_m[loaded] - contact_m);
  std::size_t i = loaded;
  while (i > 0 && depth_m[i - 1] > contact_m) --i;  // skip the ramp itself
  while (i > 0 && depth_m[i - 1] <= deep_m) --i;
  if (i == 0) return 0;
  while (depth_m[i] > contact_m) ++i;
  return i;
}

}  // namespace viscard
