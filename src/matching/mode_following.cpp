#include "matching/mode_following.hpp"

#include "core/error.hpp"
#include "matching/pairing.hpp"
#include "modal/mac.hpp"

namespace twindeck::matching {

ModeFollower::ModeFollower(const linalg::SparseMatrix& mass_lower, const dynamics::EigenModes& reference)
    : mass_(mass_lower), mass_reference_(linalg::symmetric_product(mass_, reference.shapes)) {}

FollowedModes ModeFollower::follow(const Eigen::Ref<const Eigen::MatrixXd>& shapes) const {
  TWINDECK_ASSERT(shapes.rows() == mass_.rows());
  const Eigen::MatrixXd mass_shapes = linalg::symmetric_product(mass_, shapes);
  Eigen::MatrixXd scaled = shapes;
  for (Eigen::Index j = 0; j < scaled.cols(); ++j) {
    const double generalised_mass = shapes.col(j).dot(mass_shapes.col(j));
    if (generalised_mass > 0.0) scaled.col(j) /= std::sqrt(generalised_mass);
  }
  return follow_normalised(mass_reference_, scaled);
}

FollowedModes follow_normalised(const Eigen::MatrixXd& mass_reference, const Eigen::MatrixXd& shapes) {
  const Eigen::MatrixXd mac = modal::mass_weighted_mac(mass_reference, shapes);
  FollowedModes followed{.position = matching::follow_modes(mac), .mac = Eigen::VectorXd::Zero(mac.rows())};
  for (Eigen::Index i = 0; i < mac.rows(); ++i) {
    const int j = followed.position[static_cast<std::size_t>(i)];
    if (j >= 0) followed.mac(i) = mac(i, j);
  }
  return followed;
}

}  // namespace twindeck::matching
