#include "io/flow/scenes/answers_on_mesh.h"

#include "io/basics/parallel.h"
#include "models/maths/failure_text.h"
#include "models/scene/simulate.h"

#include <limits>
#include <utility>

namespace viscard {

AnswersOnMesh::AnswersOnMesh(const UncertainScene& scene, const std::vector<NamedValue>& wanted,
                             const Discretisation& mesh, AnswerCount& count)
    : AnswersOnMesh(scene, wanted, count,
                    [mesh](const Scene& one) { return answer_on(one, mesh); }) {}

AnswersOnMesh::AnswersOnMesh(const UncertainScene& scene, const std::vector<NamedValue>& wanted,
                             AnswerCount& count, AnswerOf answer)
    : scene_(scene), wanted_(wanted), answer_(std::move(answer)), count_(count) {}

Eigen::MatrixXd AnswersOnMesh::operator()(const Eigen::MatrixXd& deviates) const {
  count_.expect(static_cast<std::size_t>(deviates.rows()));
  Eigen::MatrixXd answers(deviates.rows(), static_cast<Eigen::Index>(wanted_.size()));
  for_each_in_parallel(static_cast<std::size_t>(deviates.rows()), [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    answers.row(row) = answer_at(deviates.row(row)).transpose();
    count_.add_one();
  });
  return answers;
}

Eigen::VectorXd AnswersOnMesh::answer_at(const Eigen::VectorXd& deviates) const {
  Eigen::VectorXd row = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(wanted_.size()),
                                                  std::numeric_limits<double>::quiet_NaN());
  try {
    const std::optional<SceneAnswer> answer = answer_(scene_.reduced_at(deviates));
    if (!answer) return row;
    const std::vector<NamedValue> found = named_values(*answer);
    for (std::size_t r = 0; r < wanted_.size(); ++r) {
      const auto it = std::find_if(found.begin(), found.end(), [&](const NamedValue& one) {
        return one.name == wanted_[r].name;
      });
      if (it != found.end()) {
        row[static_cast<Eigen::Index>(r)] = it->value;
      } else {
        count_.keep_reason("the answer close to the given values has no " + wanted_[r].name);
      }
    }
  } catch (const std::exception& error) {
    if (!is_refusal(error)) throw;
    count_.keep_reason(error.what());
  }
  return row;
}

}  // namespace viscard
