#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "fe/model.hpp"
#include "updating/structure_data.hpp"

/// A fit of a generated structure's sizes to frequencies, cable forces, masses per metre and a limit of displacement.
namespace twindeck::updating {

/// A structure, or one of several variants of it, that sizes are sought for. Sizes are given as parts of their ranges, 0 to 1.
struct FittedStructure {
  std::function<fe::Model(const Eigen::VectorXd& part)> model;
  std::function<bool(Eigen::Index size)> acts;  ///< whether a size can change this structure; empty: each one may
  StructureData data;
};

/// What a fit minimises:  1/2 sum_kind weight_kind² unit² sum deviations²  +  1/2 range_costs² |part - start|².
/// `unit` is the standard deviation of a frequency, so that a row of a frequency is its relative error.
struct FitObjective {
  std::array<double, n_data_kinds> weight = {1.0, 1.0, 1.0, 1.0};  ///< [-] by DataKind; 0: shown, not fitted
  double unit = 0.01;                                              ///< [-]
  double range_costs = 0.0;                                        ///< a size that travels its whole range counts as much as
                                                                   ///< this relative error of one frequency
  Eigen::VectorXd start;                                           ///< (n_sizes) where the weak pull leads
};

/// Rows of all structures, one structure after another, then those of the pull to the start.
class StructureFit {
 public:
  /// The structures must outlive the fit.
  StructureFit(const std::vector<FittedStructure>& structures, FitObjective objective);

  /// @param part (n_sizes) @param r (n_rows) @return false: a structure has no modes or no equilibrium there
  [[nodiscard]] bool residual(const Eigen::VectorXd& part, Eigen::VectorXd& r);
  /// Derivative of the last residual. (n_rows × n_sizes) Eigenvalues: phi' (dK - lambda dM) phi with cable forces frozen. Cable
  /// forces, masses and displacements: differences of the static answer. dK, dM and those are forward differences over 1e-5 of
  /// a range, backward in its upper half.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& part) const;

  /// Answers of the structures at the last residual, frequencies corrected by `ratio`.
  [[nodiscard]] const std::vector<StructureAnswer>& answers() const { return answers_; }
  /// Frequencies of all structures, one after another. [Hz] (n_frequencies)
  [[nodiscard]] Eigen::VectorXd frequencies() const;
  /// Part of the cost of each kind of data at the last residual; the last entry is that of the pull to the start.
  [[nodiscard]] std::array<double, n_data_kinds + 1> costs() const;

  Eigen::VectorXd ratio;  ///< (n_frequencies) what another mesh makes of this one's frequencies; 1 at first

 private:
  struct Solved;
  [[nodiscard]] Solved solve(const Eigen::VectorXd& part, std::size_t structure) const;
  [[nodiscard]] bool needs_statics() const;
  [[nodiscard]] StructureAnswer change(const Eigen::VectorXd& part, Eigen::Index size, std::size_t structure) const;
  [[nodiscard]] Eigen::VectorXd weights(std::size_t structure) const;

  const std::vector<FittedStructure>& structures_;
  FitObjective objective_;
  std::vector<std::shared_ptr<const Solved>> solved_;
  std::vector<StructureAnswer> answers_;
  Eigen::VectorXd from_start_;
};

struct FitSearch {
  Eigen::VectorXd part;  ///< (n_sizes) within 0 to 1
  double projected_gradient = 0.0;
  int iterations = 0;
  bool settled = false;  ///< the cost fell by less than 1e-4 of it, or no step lowers it
};

/// Levenberg and Marquardt within the ranges (bounded_quadratic.hpp) until the cost settles.
/// @param report  called once an iteration with the state of the search
[[nodiscard]] FitSearch search_fit(StructureFit& fit, Eigen::VectorXd part, int max_iterations,
                                   const std::function<void(const FitSearch&)>& report);

}  // namespace twindeck::updating
