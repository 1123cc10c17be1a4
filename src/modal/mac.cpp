#include "modal/mac.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace twindeck::modal {

namespace {

template <typename Matrix>
Eigen::VectorXd squared_norms(const Matrix& phi, const char* which) {
  const Eigen::VectorXd norms = phi.colwise().squaredNorm().real();
  for (Eigen::Index j = 0; j < norms.size(); ++j) {
    if (!(norms[j] > 0.0)) {
      throw InputError({}, fmt::format("{} shape {} is zero (or no number) at all common degrees of freedom", which, j + 1),
                       "leave the mode out, or measure where it moves");
    }
  }
  return norms;
}

template <typename Matrix>
Eigen::MatrixXd mac_of(const Matrix& phi_n, const Matrix& phi_x) {
  if (phi_n.rows() != phi_x.rows()) {
    throw InputError({}, fmt::format("shapes with {} and {} degrees of freedom can't be compared", phi_n.rows(), phi_x.rows()),
                     "reduce both to the common degrees of freedom first");
  }
  const Eigen::VectorXd norm_n = squared_norms(phi_n, "numerical"), norm_x = squared_norms(phi_x, "experimental");
  const Eigen::MatrixXd products = (phi_n.adjoint() * phi_x).cwiseAbs2();
  // Cauchy and Schwarz hold in exact numbers; the minimum takes off what rounding adds.
  return (norm_n.cwiseInverse().asDiagonal() * products * norm_x.cwiseInverse().asDiagonal()).cwiseMin(1.0);
}

}  // namespace

Eigen::MatrixXd mac(const Eigen::Ref<const Eigen::MatrixXcd>& phi_n, const Eigen::Ref<const Eigen::MatrixXcd>& phi_x) {
  return mac_of(phi_n, phi_x);
}

Eigen::MatrixXd mac(const Eigen::Ref<const Eigen::MatrixXd>& phi_n, const Eigen::Ref<const Eigen::MatrixXd>& phi_x) {
  return mac_of(phi_n, phi_x);
}

std::vector<Eigen::Index> measured_rows(const Eigen::Ref<const Eigen::VectorXcd>& shape) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < shape.size(); ++i)
    if (std::isfinite(shape[i].real()) && std::isfinite(shape[i].imag())) rows.push_back(i);
  return rows;
}

Eigen::MatrixXd mac_where_measured(const Eigen::Ref<const Eigen::MatrixXcd>& phi_n,
                                   const Eigen::Ref<const Eigen::MatrixXcd>& phi_x) {
  if (phi_x.allFinite()) return mac_of(phi_n, phi_x);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(phi_n.cols(), phi_x.cols());
  for (Eigen::Index i = 0; i < phi_x.cols(); ++i) {
    const std::vector<Eigen::Index> rows = measured_rows(phi_x.col(i));
    const Eigen::MatrixXcd x = phi_x(rows, Eigen::seqN(i, 1));
    const double norm = x.squaredNorm();
    if (!(norm > 0.0))
      throw InputError({}, fmt::format("experimental shape {} is zero or not measured at any channel", i + 1),
                       "leave the mode out");
    for (Eigen::Index j = 0; j < phi_n.cols(); ++j) {
      const Eigen::MatrixXcd n = phi_n(rows, Eigen::seqN(j, 1));
      const double own = n.squaredNorm();
      if (own > 0.0) out(j, i) = std::min(1.0, std::norm((n.adjoint() * x)(0, 0)) / (own * norm));
    }
  }
  return out;
}

Eigen::MatrixXd mass_weighted_mac(const Eigen::Ref<const Eigen::MatrixXd>& mass_phi_a,
                                  const Eigen::Ref<const Eigen::MatrixXd>& phi_b) {
  TWINDECK_ASSERT(mass_phi_a.rows() == phi_b.rows());
  return (mass_phi_a.transpose() * phi_b).cwiseAbs2();
}

}  // namespace twindeck::modal
