#include "io/flow/scenes/scene_uncertainty.h"

#include "io/basics/parallel.h"
#include "io/flow/scenes/answers_on_mesh.h"
#include "io/flow/scenes/named_values.h"
#include "models/maths/dense.h"
#include "models/maths/failure_text.h"
#include "models/scene/simulate.h"
#include "models/uncertainty/curved_propagation.h"
#include "models/uncertainty/sampled_propagation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Answers to first order that reuse one solution of the scene; empty if it has none.
BatchFunction first_order_of(const UncertainScene& scene, const std::vector<NamedValue>& values,
                             const Discretisation& mesh, AnswerCount& count) {
  const VectorXd nominal = VectorXd::Zero(count_deviates(scene.inputs()));
  const auto answer = first_order_answers(scene.reduced_at(nominal), mesh);
  if (!answer) return {};
  return AnswersOnMesh(scene, values, count, answer);
}

// Coarser meshes of one pillar, cheapest first, that may serve for samples; the last is `finest`.
std::vector<Discretisation> coarser_meshes(const Scene& scene, const Discretisation& finest) {
  std::vector<Discretisation> meshes;
  const auto* pillar = std::get_if<PillarScene>(&scene);
  if (pillar != nullptr && !pillar->discretisation) {
    for (const auto& [degree, layers] : {std::pair(3, 1), {4, 2}, {5, 2}, {6, 3}}) {
      if (degree >= finest.degree) continue;
      Discretisation mesh = finest;
      mesh.degree = degree;
      mesh.layers = std::min(layers, finest.layers);
      meshes.push_back(mesh);
    }
  }
  meshes.push_back(finest);
  return meshes;
}

// Answers on a coarser mesh, corrected to first order for the answer's own mesh.
struct CoarseAnswers {
  VectorXd value;       // with every input at its value
  MatrixXd correction;  // deviates x results, to be added to the deviations
  double error =
      0.0;  // of the deviations that remains at the ends, relative to standard uncertainty
};

CoarseAnswers compare_meshes(const MatrixXd& coarse_at_ends, const VectorXd& value,
                             const LinearAnswer& linear) {
  CoarseAnswers out{value, MatrixXd::Zero(linear.ends.cols(), value.size())};
  const VectorXd deviation = standard_uncertainty(linear);
  std::vector<Index> rows;
  for (Index i = 0; i < coarse_at_ends.rows(); ++i) {
    if (coarse_at_ends.row(i).allFinite() && linear.at_ends.row(i).allFinite()) rows.push_back(i);
  }
  MatrixXd at(static_cast<Index>(rows.size()), linear.ends.cols());
  MatrixXd missing(static_cast<Index>(rows.size()), value.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto row = static_cast<Index>(k);
    at.row(row) = linear.ends.row(rows[k]);
    missing.row(row) = (linear.at_ends.row(rows[k]) - linear.value.transpose()) -
                       (coarse_at_ends.row(rows[k]) - value.transpose());
  }
  for (Index r = 0; r < value.size(); ++r) {
    if (!(deviation[r] > 0.0) || rows.empty()) continue;
    out.correction.col(r) = PivotedQr(at).solve(VectorXd(missing.col(r)));
    const VectorXd rest = missing.col(r) - at * out.correction.col(r);
    out.error = std::max(out.error, rest.cwiseAbs().maxCoeff() / deviation[r]);
  }
  return out;
}

// The plan: sampling is needed unless the linear answer is within the tolerance.
bool is_linear_enough(const LinearAnswer& linear, const std::vector<NamedValue>& values,
                      double tolerance, std::string& reason) {
  double worst = 0.0;
  std::string name;
  for (std::size_t r = 0; r < values.size(); ++r) {
    const double error =
        linear.disagreement[static_cast<Index>(r)] / std::max(std::abs(values[r].value), 1e-300);
    if (error > 0.0 && !(error <= worst)) {
      worst = error;
      name = values[r].name;
    }
  }
  const bool is_enough = worst <= tolerance;
  reason = std::isfinite(worst)
               ? fmt::format(
                     "the linear answer differs from the scene's own by up to {:.2g} of the "
                     "value{} at the ends of the intervals; the tolerance is {:.2g}",
                     worst, name.empty() ? "" : " (" + name + ")", tolerance)
               : "the scene has no answer at some end of the intervals";
  return is_enough;
}

void take_linear(const LinearAnswer& linear, SceneUncertainty& out) {
  const VectorXd deviation = standard_uncertainty(linear);
  const MatrixXd shares = variance_shares(linear, out.inputs);
  const std::vector<Interval> intervals = intervals_95(linear, out.inputs);
  for (const Index first : first_deviates(out.inputs)) {
    if (out.by_solver.size() == out.inputs.size()) break;
    const auto from = linear.by_solver.begin() + first;
    const auto n = out.inputs[out.by_solver.size()].n_deviates;
    out.by_solver.push_back(std::all_of(from, from + n, [](bool is) { return is; }));
  }
  for (std::size_t r = 0; r < out.results.size(); ++r) {
    ResultUncertainty& result = out.results[r];
    const auto row = static_cast<Index>(r);
    const double offset = result.value - linear.value[row];
    result.standard_uncertainty = deviation[row];
    result.interval_95 = {intervals[r].low + offset, intervals[r].high + offset};
    result.linear_disagreement = linear.disagreement[row];
    for (Index g = 0; g < shares.cols(); ++g) {
      result.causes.push_back({shares(row, g), shares(row, g), 0.0});
    }
    if (!(deviation[row] > 0.0)) continue;
    out.slope_error =
        std::max(out.slope_error, linear.slope_error.row(row).maxCoeff() / deviation[row]);
  }
}

// The plan, second part: samples are not needed if the curved answer differs from the scene's own by less than the
// tolerance, or by less than samples would leave of the width of the interval.
bool takes_curved(const CurvedAnswer& curved, const LinearAnswer& linear, double tolerance,
                  SceneUncertainty& out) {
  constexpr double kOfWidth = 0.02;
  double worst = 0.0;
  std::string name;
  for (std::size_t r = 0; r < out.results.size(); ++r) {
    const auto row = static_cast<Index>(r);
    const Interval& interval = curved.intervals_95[r];
    const double allowed = std::max(tolerance * std::abs(linear.value[row]),
                                    kOfWidth * (interval.high - interval.low));
    if (curved.disagreement[row] == 0.0) continue;
    const double excess = curved.disagreement[row] / allowed;
    if (!(excess <= worst)) {
      worst = excess;
      name = out.results[r].name;
    }
  }
  out.n_answers += curved.n_answers;
  const bool is_enough = worst <= 1.0;
  const std::string which = name.empty() ? "" : " (" + name + ")";
  out.reason += fmt::format(
      "; a quadratic answer, or one of the logarithm, {} the scene's own at other points, too, "
      "by {:.2g} of what is allowed{}: the tolerance, or {:g} % of the width of the interval",
      is_enough ? "meets" : "misses", worst, which, 100.0 * kOfWidth);
  if (!is_enough) return false;
  out.is_curved = true;
  for (std::size_t r = 0; r < out.results.size(); ++r) {
    ResultUncertainty& result = out.results[r];
    const auto row = static_cast<Index>(r);
    const double offset = result.value - linear.value[row];
    const Interval& interval = curved.intervals_95[r];
    result.standard_uncertainty = curved.deviation[row];
    result.interval_95 = {interval.low + offset, interval.high + offset};
    result.end_error = curved.disagreement[row];
    result.causes.clear();
    for (Index g = 0; g < curved.shares.cols(); ++g) {
      result.causes.push_back({curved.shares(row, g), curved.shares(row, g), 0.0});
    }
  }
  return true;
}

void take_samples(const SampledAnswer& sampled, const VectorXd& value_on_mesh,
                  SceneUncertainty& out) {
  for (std::size_t r = 0; r < out.results.size(); ++r) {
    ResultUncertainty& result = out.results[r];
    const SampledResult& found = sampled.results[r];
    const double offset = result.value - value_on_mesh[static_cast<Index>(r)];
    result.standard_uncertainty = found.deviation;
    result.interval_95 = {found.interval_95.low + offset, found.interval_95.high + offset};
    if (!std::isfinite(found.interval_95.low)) {
      result.no_interval = fmt::format(
          "{:.2g} % of the samples have no answer, more than the 2.5 % that may lie beyond either "
          "end",
          100.0 * found.failed_share);
    }
    out.failed_share = std::max(out.failed_share, found.failed_share);
    result.end_error = found.end_error;
    result.causes.clear();
    for (const VarianceShare& share : found.shares) {
      result.causes.push_back({share.alone, share.with_others, share.standard_error});
    }
  }
  out.n_answers += sampled.n_answers;
  out.n_failed = sampled.n_failed;
}

// Samples on the cheapest mesh whose deviations are those of the answer's mesh.
void sample(const UncertainScene& scene, const std::vector<NamedValue>& values,
            const LinearAnswer& linear, const UncertaintyOptions& options, AnswerCount& count,
            SceneUncertainty& out) {
  constexpr double kMeshError = 0.01;  // of the standard uncertainty
  constexpr std::size_t kUsualSamples = 4000;
  const Index n_deviates = linear.ends.cols();
  for (const Discretisation& mesh : coarser_meshes(scene.file().scene, out.mesh)) {
    const AnswersOnMesh function(scene, values, mesh, count);
    CoarseAnswers coarse{linear.value, MatrixXd::Zero(n_deviates, linear.value.size())};
    if (mesh.degree != out.mesh.degree || mesh.layers != out.mesh.layers) {
      const VectorXd value = function(MatrixXd::Zero(1, n_deviates)).row(0).transpose();
      coarse = compare_meshes(function(linear.ends), value, linear);
      out.n_answers += static_cast<std::size_t>(linear.ends.rows()) + 1;
      if (!(coarse.error <= kMeshError) || !value.allFinite()) continue;
    }
    const BatchFunction corrected = [&](const MatrixXd& deviates) {
      return MatrixXd(function(deviates) + deviates * coarse.correction);
    };
    take_samples(sampled_answer(corrected, out.inputs,
                                {.n_answers = options.n_samples.value_or(kUsualSamples)}),
                 coarse.value, out);
    out.mesh = mesh;
    out.mesh_error = coarse.error;
    return;
  }
}

SceneUncertainty uncertainty_of(const UncertainScene& scene, const SceneAnswer& answer,
                                const UncertaintyOptions& options, AnswerCount& count) {
  const std::vector<NamedValue> values = named_values(answer);
  SceneUncertainty out{.inputs = scene.inputs(), .descriptions = scene.descriptions()};
  out.mesh = answer.discretisation;
  out.notes = scene.notes();
  for (const NamedValue& one : values) {
    out.results.push_back({.name = one.name,
                           .unit = one.unit,
                           .value = one.value,
                           .numerical_error = one.error_estimate});
  }
  std::size_t n_deviates = 0;
  for (const UncertainInput& input : out.inputs) {
    n_deviates += static_cast<std::size_t>(input.n_deviates);
  }
  // The value, two steps of each derivative, the ends of the intervals.
  count.start(1 + 4 * n_deviates + 2 * (n_deviates + values.size()));
  constexpr double kSlopes = 1e-6;  // of the standard uncertainty
  // First-order answers have a reduced basis of their own, more accurate than that of the answer.
  constexpr double kOfBasis = 0.01;  // of the numerical error
  VectorXd value_errors(static_cast<Index>(values.size()));
  for (std::size_t r = 0; r < values.size(); ++r) {
    value_errors[static_cast<Index>(r)] = kOfBasis * values[r].error_estimate;
  }
  const LinearAnswer linear =
      linear_answer(AnswersOnMesh(scene, values, answer.discretisation, count), out.inputs, kSlopes,
                    first_order_of(scene, values, answer.discretisation, count), value_errors);
  out.n_answers = linear.n_answers - linear.n_first_order;
  out.n_first_order = linear.n_first_order;
  take_linear(linear, out);
  const double tolerance = common(scene.file().scene).tolerance;
  const bool is_enough = is_linear_enough(linear, values, tolerance, out.reason);
  if (is_enough && !options.n_samples) return out;
  if (!is_enough && !options.n_samples && linear.at_ends.allFinite()) {
    const AnswersOnMesh function(scene, values, answer.discretisation, count);
    if (takes_curved(curved_answer(function, out.inputs, linear), linear, tolerance, out)) {
      return out;
    }
  }
  out.is_sampled = true;
  if (is_enough) out.reason += "; it was sampled because samples were requested";
  sample(scene, values, linear, options, count, out);
  return out;
}

}  // namespace

SceneUncertainty scene_uncertainty(const UncertainScene& scene, const SceneAnswer& answer,
                                   const UncertaintyOptions& options) {
  AnswerCount count(options.progress);
  try {
    SceneUncertainty out = uncertainty_of(scene, answer, options, count);
    if (out.n_failed > 0) {
      out.notes.push_back(
          fmt::format("{} samples ({:.2g} % of those of the intervals) have no answer and count as "
                      "beyond either end; shares of the variance leave them out. One of them: {}",
                      out.n_failed, 100.0 * out.failed_share, count.why()));
    }
    return out;
  } catch (const std::runtime_error& error) {
    if (!is_refusal(error)) throw;
    throw std::runtime_error(std::string(error.what()) +
                             (count.why().empty() ? "" : ": " + count.why()));
  }
}

}  // namespace viscard
