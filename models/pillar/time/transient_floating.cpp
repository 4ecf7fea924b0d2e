#include "models/maths/dense.h"
#include "models/pillar/time/transient_run.h"

#include <utility>

namespace viscard {
namespace {

SymmetricSparse corner_of(const SymmetricSparse& lower, Eigen::Index size) {
  if (lower.size() == 0) return lower;
  return SymmetricSparse(lower.bottomRightCorner(size, size));
}

// Positions and speeds of bodies of mass 1 under the load's factor, from rest.
TransientMotion fallen(const std::vector<TransientPiece>& pieces) {
  TransientMotion motion = empty_motion(pieces, 1);
  double x = 0.0, v = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double h = pieces[i].length_s;
    x += h * v + h * h * (2.0 * pieces[i].first + pieces[i].last) / 6.0;
    v += 0.5 * h * (pieces[i].first + pieces[i].last);
    motion.values(0, static_cast<Eigen::Index>(i + 1)) = x;
    motion.rates(0, static_cast<Eigen::Index>(i + 1)) = v;
  }
  return motion;
}

}  // namespace

ViscoelasticSystem without_rigid_motions(const ViscoelasticSystem& small) {
  const Eigen::Index size = small.shear.rows() - small.rigid.cols();
  ViscoelasticSystem part = small;
  part.elastic = corner_of(small.elastic, size);
  part.shear = corner_of(small.shear, size);
  part.bulk = corner_of(small.bulk, size);
  part.mass = corner_of(small.mass, size);
  if (small.load.size() > 0) part.load = small.load.tail(size);
  part.rigid.resize(size, 0);
  return part;
}

TransientResult run_floating(const ViscoelasticSystem& small, const TransientRequest& r,
                             const Eigen::MatrixXd& observers) {
  const Eigen::Index rigid = small.rigid.cols();
  const Eigen::Index size = small.shear.rows() - rigid;
  TransientRequest bending = r;
  bending.load = r.load.tail(size);
  TransientResult result =
      run_transient(without_rigid_motions(small), bending, observers.rightCols(size));
  const Eigen::MatrixXd masses_kg = dense(small.mass).topLeftCorner(rigid, rigid);
  const Eigen::VectorXd seen =
      observers.leftCols(rigid) * Cholesky(masses_kg).solve(Eigen::VectorXd(r.load.head(rigid)));
  const std::vector<TransientPiece> pieces = pieces_of(r);
  const TransientResult moved = result_of(r, pieces, fallen(pieces));
  result.values += seen * moved.values;
  result.motion.values += seen * moved.motion.values;
  result.motion.rates += seen * moved.motion.rates;
  return result;
}

}  // namespace viscard
