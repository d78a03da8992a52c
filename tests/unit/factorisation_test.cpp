// Factorisations and eigenvalues from Eigen fail with a message, or find another way.
#include <numerics/block_inverse.hpp>
#include <numerics/incomplete_cholesky.hpp>
#include <numerics/sparse_cholesky.hpp>
#include <numerics/symmetric_eigen.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace factorisation_test {
using namespace hyperlattice::numerics;

Eigen::SparseMatrix<double> two_by_two(double a, double b, double c) {
  Eigen::SparseMatrix<double> matrix(2, 2);
  matrix.insert(0, 0) = a;
  matrix.insert(1, 0) = b;
  matrix.insert(1, 1) = c;
  matrix.makeCompressed();
  return matrix;
}

TEST(SparseCholesky, SolvesWhatIsSound) {
  SparseCholesky factors;
  factors.compute(two_by_two(2, 1, 3), 1e-12);
  const Eigen::VectorXd x = factors.solve(Eigen::Vector2d{4, 7});
  EXPECT_NEAR(x[0], 1, 1e-9);
  EXPECT_NEAR(x[1], 2, 1e-9);
}

TEST(SparseCholesky, AddsMoreWhereAPivotVanishes) {
  constexpr double shift = 1e-9;
  SparseCholesky factors;
  // The first shift makes the matrix singular.
  factors.compute(two_by_two(1 / (1 + shift), 1, 1 / (1 + shift)), shift);
  EXPECT_TRUE(factors.solve(Eigen::Vector2d{1, 0}).allFinite());
}

TEST(SparseCholesky, SaysWhyNothingHelps) {
  SparseCholesky factors;
  const auto why = [&](const Eigen::SparseMatrix<double>& matrix) -> std::string {
    try {
      factors.compute(matrix, 1e-9);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why(two_by_two(0, 1, 0)).find("a pivot is zero"), std::string::npos);
  EXPECT_NE(why(two_by_two(NAN, 0, 1)).find("not finite"), std::string::npos);
}

TEST(SparseCholesky, DoesNotSolveWithoutFactors) {
  SparseCholesky factors;
  EXPECT_THROW(factors.compute(two_by_two(NAN, 0, 1), 1e-9), std::runtime_error);
  EXPECT_THROW(factors.solve(Eigen::Vector2d{1, 0}), std::runtime_error);
}

TEST(IncompleteCholesky, SaysWhetherThereIsOne) {
  IncompleteCholesky factor;
  // No entry is left out, so that the factorisation is complete.
  ASSERT_TRUE(factor.compute(two_by_two(2, 1, 3)));
  const Eigen::VectorXd x = factor.solve(Eigen::Vector2d{4, 7});
  EXPECT_NEAR(x[0], 1, 1e-2);
  EXPECT_NEAR(x[1], 2, 1e-2);
  EXPECT_FALSE(factor.compute(two_by_two(0, 1, 0)));
}

TEST(SymmetricEigen, SaysWhyItFails) {
  Eigen::Matrix3d matrix = Eigen::Vector3d{3, 1, 2}.asDiagonal();
  EXPECT_NEAR(
      (SymmetricEigen<Eigen::Matrix3d>(matrix).eigenvalues() - Eigen::Vector3d{1, 2, 3}).norm(), 0,
      1e-14);
  matrix(1, 0) = NAN;
  EXPECT_THROW(SymmetricEigen<Eigen::Matrix3d>{matrix}, std::runtime_error);
}

// The inverse of a block is accurate for heights a billion times as stiff as the other directions,
// or as soft.
TEST(BlockInverse, KnowsHeightsOfAnyStiffness) {
  for (const double height : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
    Eigen::Matrix4d block = Eigen::Matrix4d::Identity();
    block(0, 1) = block(1, 0) = 0.5;
    block(3, 3) = height;
    const BlockInverse found(block);
    EXPECT_LT((found.inverse * block - Eigen::Matrix4d::Identity()).norm(), 1e-12) << height;
    EXPECT_EQ(found.added.norm(), 0) << height;
  }
}

TEST(BlockInverse, IsFiniteWhateverTheBlock) {
  Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
  EXPECT_EQ(BlockInverse(block).inverse.norm(), 0);
  block(0, 0) = 1;  // one spring has no stiffness across its direction
  EXPECT_NEAR(BlockInverse(block).inverse(1, 1), 1e3, 1e-9);
  block(2, 2) = NAN;
  EXPECT_TRUE(BlockInverse(block).inverse.allFinite());
}

}  // namespace factorisation_test
