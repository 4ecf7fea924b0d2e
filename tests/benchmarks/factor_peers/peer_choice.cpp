#include "tests/benchmarks/factor_peers/peer_choice.h"

#include "models/pillar/system/supernodal_factor.h"

#include <ctime>
#include <stdexcept>

namespace viscard {
namespace peers {

FactorKind& choice() {
  static FactorKind now = FactorKind::kOurs;
  return now;
}

Spent& spent() {
  static Spent now;
  return now;
}

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

namespace {

// Adds the processor time of its own life to a sum.
class Clock {
 public:
  explicit Clock(double& sum) : sum_(sum), start_s_(cpu_s()) {}
  ~Clock() { sum_ += cpu_s() - start_s_; }
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

 private:
  double& sum_;
  double start_s_;
};

std::unique_ptr<Factor> chosen_factor() {
  switch (choice()) {
    case FactorKind::kOurs:
      return our_factor();
    case FactorKind::kEigen:
      return eigen_factor();
    default:
      return cholmod_factor(choice());
  }
}

}  // namespace
}  // namespace peers

void SupernodalFactor::analyse(const Eigen::SparseMatrix<double>& lower) {
  const peers::Clock clock(peers::spent().analyse);
  ++peers::spent().analyses;
  chosen_ = peers::chosen_factor();
  chosen_->analyse(lower);
}

bool SupernodalFactor::factor(const Eigen::SparseMatrix<double>& lower) {
  if (chosen_.use_count() != 1) throw std::logic_error("a copied factor was factored again");
  peers::Spent& spent = peers::spent();
  bool is_done = false;
  {
    const peers::Clock clock(spent.factor);
    is_done = chosen_->factor(lower);
  }
  ++spent.factors;
  if (lower.rows() > spent.largest) {
    spent.largest = static_cast<int>(lower.rows());
    spent.entries = chosen_->entries();
  }
  return is_done;
}

Eigen::VectorXd SupernodalFactor::solve(const Eigen::VectorXd& right_side) const {
  const peers::Clock clock(peers::spent().solve);
  ++peers::spent().solves;
  return chosen_->solve(right_side);
}

Eigen::MatrixXd SupernodalFactor::forward(const Eigen::MatrixXd& right_sides) const {
  const peers::Clock clock(peers::spent().solve);
  ++peers::spent().solves;
  return chosen_->forward(right_sides);
}

}  // namespace viscard
