#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/model.hpp"

/// What is known of a structure whose sizes are sought: frequencies, cable forces, masses per metre, a limit of displacement.
namespace twindeck::updating {

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

/// The vertical displacement under dead load, at the conditions of shape finding (the stays' anchors), that is tolerated.
struct DisplacementLimit {
  double limit_m = 0.0;
  double std_m = 1.0;  ///< a displacement that is so much above the limit counts as one standard deviation
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

/// Change of the deviations with the answer, to first order: `change` holds derivatives of the answer's quantities.  (n_rows)
[[nodiscard]] Eigen::VectorXd deviation_changes(const StructureAnswer& answer, const StructureAnswer& change,
                                                const StructureData& data);

}  // namespace twindeck::updating
