#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/model.hpp"

/// A fit of a generated structure's sizes to frequencies, cable forces, masses per metre and a limit of displacement.
namespace twindeck::updating {

// What is known of a structure whose sizes are sought: frequencies, cable forces, masses per metre, a limit of displacement.

/// Frequencies by position among the structure's modes.
struct KnownFrequencies {
  std::vector<int> modes;        ///< from 1
  Eigen::VectorXd frequency_Hz;  ///< (n_modes)
  double std = 0.01;             ///< relative standard deviation [-]
};

/// Force of a stay under dead load.
struct KnownForce {
  std::string stay;  ///< name of the element
  double force_N = 0.0, std_N = 1.0;
};

/// Mass of parts of the structure over a length.
struct KnownMass {
  std::string name;
  std::vector<std::string> groups;  ///< beginnings of the names of groups of elements and point masses that belong to it
  double length_m = 1.0, mass_kg_m = 0.0, std_kg_m = 1.0;
};

/// Largest allowed vertical displacement under dead load at the stays' anchors, where shape finding sets its conditions.
struct DisplacementLimit {
  double limit_m = 0.0;
  double std_m = 1.0;  ///< displacement above the limit that counts as one standard deviation
};

struct StructureData {
  KnownFrequencies frequencies;
  std::vector<KnownForce> forces;
  std::vector<KnownMass> masses;
  std::vector<DisplacementLimit> limits;  ///< none or one
};

/// The same quantities as a model has them.
struct StructureAnswer {
  Eigen::VectorXd frequency_Hz;    ///< (n_modes) of the known modes
  Eigen::VectorXd force_N;         ///< (n_forces)
  Eigen::VectorXd mass_kg_m;       ///< (n_masses)
  Eigen::VectorXd displacement_m;  ///< (n_anchors) vertical; empty without a limit
  Status status;
};

/// Mass of the elements and point masses whose group begins with one of `groups`. [kg]
[[nodiscard]] double mass_of_groups(const fe::Model& model, const std::vector<std::string>& groups);

/// Cable forces, masses and displacements of a model in a state of prestress; frequencies are left empty.
/// @throws InputError for a stay that the model does not have, or groups that none of its parts belongs to
[[nodiscard]] StructureAnswer static_answer(const fe::Model& model, const fe::PrestressState& state, const StructureData& data);

/// Kinds of data, in the order of a structure's rows.
enum class DataKind { frequency, cable_force, mass, displacement };
constexpr int n_data_kinds = 4;
[[nodiscard]] std::vector<DataKind> kinds_of_rows(const StructureData& data, Eigen::Index n_anchors);

/// Deviations of an answer from the data in standard deviations: (model - known) / std for frequencies (relative), forces and
/// masses; max(0, |displacement| - limit) / std for displacements.  (n_rows) in the order of kinds_of_rows
[[nodiscard]] Eigen::VectorXd deviations(const StructureAnswer& answer, const StructureData& data);

/// Derivatives of the deviations (n_rows), from the derivatives `change` of the quantities of the answer.
[[nodiscard]] Eigen::VectorXd deviation_changes(const StructureAnswer& answer, const StructureAnswer& change,
                                                const StructureData& data);

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
  double range_costs = 0.0;  ///< the full range of a size costs as much as this relative error of one frequency
  Eigen::VectorXd start;     ///< (n_sizes) values that a weak penalty pulls the sizes towards
};

/// Rows of all structures, one structure after another, then the rows of the penalty that pulls the sizes to their start.
class StructureFit {
 public:
  /// The structures must outlive the fit.
  StructureFit(const std::vector<FittedStructure>& structures, FitObjective objective);

  /// @param part (n_sizes) @param r (n_rows) @return false: a structure has no modes or no equilibrium there
  [[nodiscard]] bool residual(const Eigen::VectorXd& part, Eigen::VectorXd& r);
  /// Derivative of the last residual. (n_rows × n_sizes) Eigenvalues: phi' (dK - lambda dM) phi with cable forces frozen. Cable
  /// forces, masses and displacements: differences of the static answer. dK, dM and the static answer are differenced forward
  /// over 1e-5 of a range, backward in its upper half.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& part) const;

  /// Answers of the structures at the last residual, frequencies corrected by `ratio`.
  [[nodiscard]] const std::vector<StructureAnswer>& answers() const { return answers_; }
  /// Frequencies of all structures, one after another. [Hz] (n_frequencies)
  [[nodiscard]] Eigen::VectorXd frequencies() const;
  /// Part of the cost of each kind of data at the last residual; the last entry is that of the penalty.
  [[nodiscard]] std::array<double, n_data_kinds + 1> costs() const;

  Eigen::VectorXd ratio;  ///< (n_frequencies) correction: frequency on another mesh over that on this mesh; 1 at first

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
