#pragma once

#include "io/flow/scenes/named_values.h"
#include "io/flow/scenes/uncertain_scene.h"
#include "models/answer/scene_answer.h"

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Counts the answers for the progress, from several threads.
class AnswerCount {
 public:
  AnswerCount(const std::function<void(double)>& progress) : progress_(progress) {}
  // Before the first answer.
  void start(std::size_t at_least) {
    at_least_ = at_least;
    if (progress_) progress_(0.0);
  }
  void expect(std::size_t more) { expected_ += more; }
  void add_one() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++done_;
    if (progress_) {
      const std::size_t expected = std::max(expected_, at_least_);
      progress_(std::min(1.0, static_cast<double>(done_) / static_cast<double>(expected)));
    }
  }
  // Keeps the first reason why a point has no answer.
  void keep_reason(const std::string& why) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (why_.empty()) why_ = why;
  }
  const std::string& why() const { return why_; }

 private:
  const std::function<void(double)>& progress_;
  std::mutex mutex_;
  std::size_t done_ = 0, expected_ = 0, at_least_ = 0;
  std::string why_;
};

// The answers of a scene on one mesh, so that they vary smoothly with the inputs. A point without an answer
// gives NaN.
class AnswersOnMesh {
 public:
  AnswersOnMesh(const UncertainScene& scene, const std::vector<NamedValue>& wanted,
                const Discretisation& mesh, AnswerCount& count);
  // Those that a function gives for a scene.
  using AnswerOf = std::function<std::optional<SceneAnswer>(const Scene&)>;
  AnswersOnMesh(const UncertainScene& scene, const std::vector<NamedValue>& wanted,
                AnswerCount& count, AnswerOf answer);

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& deviates) const;

 private:
  Eigen::VectorXd answer_at(const Eigen::VectorXd& deviates) const;

  const UncertainScene& scene_;
  std::vector<NamedValue> wanted_;
  AnswerOf answer_;
  AnswerCount& count_;
};

}  // namespace viscard
