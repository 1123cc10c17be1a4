#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <functional>
#include <memory>

#include "diagnosis/reduction/reduction_options.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "dynamics/eigenmodes.hpp"
#include "linalg/cholesky.hpp"

namespace twindeck::diagnosis {

class CommonBasis;

/// The vectors that a structure is reduced to: common ones, and from them and the factor of K those of a place, as often as
/// they are asked for and always to the same bits.
class StaticVectors {
 public:
  StaticVectors();
  ~StaticVectors();

  /// The stiffness as the structure stands, and the factor that static corrections come from.
  /// @throws InputError if K is singular beyond rigid-body motion
  void factorize(const Structure& structure);
  /// The common vectors: modes, corrections for parameters and element scatter, dampers, load tests.
  void make_common(const Structure& structure, const Places& places, const dynamics::EigenModes& modes,
                   const ReductionOptions& options);
  [[nodiscard]] const Eigen::MatrixXd& common() const;  ///< (n × c) orthonormal in K
  /// What stands for causes at a place, beside the common vectors: K^-1 b for a force direction, K^-1 (dK Phi) for a factor.
  /// @param turn  becomes what makes them of `loads_at`, K^-1 loads turn beyond the common vectors
  [[nodiscard]] Eigen::MatrixXd own_vectors(const Place& place, int count, Eigen::MatrixXd* turn = nullptr) const;
  /// Computes the same vectors, to rounding, from few forces at the place. It borrows from this.
  [[nodiscard]] std::function<Eigen::MatrixXd()> recipe(const Place& place, int count) const;
  /// Force of all unit forces of a place over the displacements that they make along themselves.
  [[nodiscard]] double drive_stiffness(const Eigen::SparseMatrix<double>& directions) const;
  /// K where the basis was made, shifted where the structure is free.
  [[nodiscard]] const Symmetric& stiffness() const { return stiffness_; }

 private:
  /// Forces whose responses stand for causes at a place (n × any).
  [[nodiscard]] Eigen::MatrixXd loads_at(const Place& place) const;
  /// The strongest responses to the unit forces of a place.
  [[nodiscard]] Eigen::MatrixXd responses(const Eigen::SparseMatrix<double>& directions, int count) const;

  Symmetric stiffness_;
  linalg::Cholesky factor_;
  std::unique_ptr<CommonBasis> basis_;
  Eigen::MatrixXd low_, answers_;  ///< the modes, and the responses to load tests, that vectors of places are made of
};

}  // namespace twindeck::diagnosis
