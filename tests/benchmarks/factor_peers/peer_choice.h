#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>

// Which factorisation the pillar solver uses in this benchmark, and the processor time that its
// parts take.
namespace viscard::peers {

enum class FactorKind {
  kOurs,
  kCholmodAmd,         // simplicial L D L^T, without pivoting
  kCholmodMetis,       // the same, nested dissection
  kCholmodSupernodal,  // L L^T by dense blocks; simplicial L D L^T where the matrix is indefinite
  kCholmodAuto,        // CHOLMOD chooses one of these two by the work for each entry
  kEigen               // SimplicialLDLT, minimum degree
};
FactorKind& choice();

// Processor time in s, and how often.
struct Spent {
  double analyse = 0.0, factor = 0.0, solve = 0.0;
  int analyses = 0, factors = 0, solves = 0;
  int largest = 0;           // unknowns of the largest factored matrix
  Eigen::Index entries = 0;  // of its L
};
Spent& spent();
double cpu_s();

// The operations of SupernodalFactor (models/pillar/system), done by any of the factorisations.
class Factor {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  virtual ~Factor() = default;
  virtual void analyse(const Sparse& lower) = 0;
  virtual bool factor(const Sparse& lower) = 0;
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const = 0;
  virtual Eigen::MatrixXd forward(const Eigen::MatrixXd& right_sides) const = 0;
  virtual const Eigen::VectorXd& pivots() const = 0;
  virtual Eigen::Index entries() const = 0;
};

std::unique_ptr<Factor> our_factor();
std::unique_ptr<Factor> cholmod_factor(FactorKind kind);
std::unique_ptr<Factor> eigen_factor();

}  // namespace viscard::peers
