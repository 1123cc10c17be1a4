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

/// Makes the basis vectors of the reduced structure: the common ones and, from these and the factor of K, those of a location.
/// Repeated calls give the same bits.
class StaticVectors {
 public:
  StaticVectors();
  ~StaticVectors();

  /// Sets the stiffness of the unchanged structure, and its factor for static corrections.
  /// @throws InputError if K is singular beyond rigid-body motion
  void factorize(const Structure& structure);
  /// Makes the common vectors: modes, corrections for parameters and element scatter, dampers, load tests.
  void make_common(const Structure& structure, const Places& places, const dynamics::EigenModes& modes,
                   const ReductionOptions& options);
  [[nodiscard]] const Eigen::MatrixXd& common() const;  ///< (n × c) orthonormal in K
  /// Vectors for causes at a location, beyond the common ones: K^-1 b for a force direction, K^-1 (dK Phi) for a factor.
  /// @param turn  becomes the factors that make the vectors from `loads_at`: K^-1 loads turn, without the common part. May be
  ///         null
  [[nodiscard]] Eigen::MatrixXd own_vectors(const Place& place, int count, Eigen::MatrixXd* turn = nullptr) const;
  /// A function that computes the same vectors, to rounding, from few forces at the location. It refers to this object.
  [[nodiscard]] std::function<Eigen::MatrixXd()> recipe(const Place& place, int count) const;
  /// Stiffness of a location against all its unit forces together: force over displacement along it.
  [[nodiscard]] double drive_stiffness(const Eigen::SparseMatrix<double>& directions) const;
  /// K of the unchanged structure; shifted if the structure is free.
  [[nodiscard]] const Symmetric& stiffness() const { return stiffness_; }

 private:
  /// Forces whose responses represent causes at a location (n × any).
  [[nodiscard]] Eigen::MatrixXd loads_at(const Place& place) const;
  /// The strongest responses to the unit forces of a place.
  [[nodiscard]] Eigen::MatrixXd responses(const Eigen::SparseMatrix<double>& directions, int count) const;

  Symmetric stiffness_;
  linalg::Cholesky factor_;
  std::unique_ptr<CommonBasis> basis_;
  Eigen::MatrixXd low_, answers_;  ///< modes, and responses to load tests, that vectors of locations are made from
};

}  // namespace twindeck::diagnosis
