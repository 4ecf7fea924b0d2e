// The product's own factorisation under another name, so that it can stand beside its peers.
#include "models/pillar/system/supernodal_factor.h"  // the one in shadow/; the next lines leave it alone
#include "tests/benchmarks/factor_peers/peer_choice.h"

#define SupernodalFactor OurSupernodalFactor
#include VISCARD_OUR_FACTOR_HEADER
#include VISCARD_OUR_FACTOR_SOURCE
#undef SupernodalFactor

namespace viscard::peers {
namespace {

class OurFactor : public Factor {
 public:
  void analyse(const Sparse& lower) override { factor_.analyse(lower); }
  bool factor(const Sparse& lower) override { return factor_.factor(lower); }
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const override {
    return factor_.solve(right_side);
  }
  Eigen::MatrixXd forward(const Eigen::MatrixXd& right_sides) const override {
    return factor_.forward(right_sides);
  }
  const Eigen::VectorXd& pivots() const override { return factor_.pivots(); }
  Eigen::Index entries() const override { return factor_.entries(); }

 private:
  OurSupernodalFactor factor_;
};

}  // namespace

std::unique_ptr<Factor> our_factor() {
  return std::make_unique<OurFactor>();
}

}  // namespace viscard::peers
