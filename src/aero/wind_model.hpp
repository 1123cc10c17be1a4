#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aero/aero_nodes.hpp"
#include "aero/aeroelastic_system.hpp"
#include "aero/derivative_table.hpp"
#include "aero/wind_settings.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::aero {

/// What the files hold for one deck.
struct DeckAerodynamics {
  Polar polar;
  std::shared_ptr<const DerivativeTable> flutter;  ///< null: the polar alone, for the set quasi_steady
};
/// Aerodynamic sections of a set at a level. "standin": tables and polars, all self-excited forces multiplied by `level`
/// (chord, mass and share of the mode are as unknown as the derivatives, and all of them enter as one factor); "quasi_steady":
/// derivatives from the polars alone, whose lift slope is multiplied by `level`.
[[nodiscard]] std::vector<SectionAero> sections_of(const WindSettings& config, const std::vector<DeckAerodynamics>& data,
                                                   const std::string& set, double level);

/// The aerodynamic nodes of the configuration's decks. @param model  null for a matrix model @param source  for messages
/// @throws InputError  for a matrix model, whose decks are not known, and as find_aero_nodes
[[nodiscard]] AeroNodes aero_nodes_of(const WindSettings& config, const fe::Model* model, const std::string& source);

/// A model prepared for wind: aerodynamic nodes with their angle of attack from the shape under dead load, modes. A model
/// without a prestress rule has the shape of its files.
struct WindModel {
  AeroNodes nodes;
  std::vector<Strip> strips;
  dynamics::EigenModes modes;
  std::vector<StripMotion> motions;  ///< of the modes
};
/// @throws InputError  as aero_nodes_of
[[nodiscard]] WindModel prepare_wind_model(const WindSettings& config, const dynamics::LoadedModel& loaded);

/// The modes as a structure in wind, without dampers.
[[nodiscard]] ReducedStructure bare_structure(const WindModel& model, double damping_ratio);

/// Modes and static corrections with the model's dampers (springs of a group that begins with "damper", whether they are active
/// in the model or not) as dashpots and Maxwell units.
struct DampedModel {
  ReducedStructure structure;
  std::vector<StripMotion> motions;
  Eigen::MatrixXd vectors;  ///< (n × m) of the coordinates over the free degrees of freedom
  int dampers = 0;
};
/// What the modes are completed with.
struct Reduction {
  bool dampers = true;             ///< the dampers take part, and a static shape each
  Eigen::MatrixXd patterns;        ///< (n × k) loads, scaled by their size; may be empty
  Eigen::Index static_shapes = 0;  ///< that hold most of what the modes leave of the answer to the patterns
  /// (n × k) unit forces where motions are asked for; may be empty. A basis that has a point's own static shape gives that
  /// point's slow motion under any load exactly, wherever the load acts (reciprocity), near supports too, where modes say
  /// least.
  Eigen::MatrixXd points;
  Eigen::Index point_generations = 0;  ///< shapes a point: static (1), of its inertia (2), of the inertia of that (3), …
};
[[nodiscard]] DampedModel reduce(const WindModel& model, const dynamics::LoadedModel& loaded, double damping_ratio,
                                 const Reduction& reduction);
[[nodiscard]] DampedModel with_dampers(const WindModel& model, const dynamics::LoadedModel& loaded, double damping_ratio);

/// The springs that are dampers, and their force patterns on the free degrees of freedom (n × n_dampers).
[[nodiscard]] std::vector<const fe::Spring*> dampers_of(const fe::Model& model);
[[nodiscard]] Eigen::MatrixXd damper_patterns(const dynamics::LoadedModel& loaded,
                                              const std::vector<const fe::Spring*>& dampers);

/// What damps in the model and is not taken: dashpots of active springs that are no dampers by their group, and friction. A
/// sentence for people that names them, empty where there are none.
[[nodiscard]] std::string untaken_in_words(const fe::Model& model);
/// The model's stiffness with dampers fitted (lower triangle): the spring beside the dashpot of an active one is in the model's
/// matrix already, that of one that is not active is added. A spring in series with its dashpot is not in it.
[[nodiscard]] linalg::SparseMatrix stiffness_with(const dynamics::LoadedModel& loaded,
                                                  const std::vector<const fe::Spring*>& dampers);
/// Sum over the columns d of factor · d d' (lower triangle); columns have few entries.
[[nodiscard]] linalg::SparseMatrix sum_of_outer_products(const Eigen::MatrixXd& patterns, const Eigen::VectorXd& factor);

/// Level of a set at which mode 1 is critical at the speed to fit, by the rule to fit. 1 where nothing is to be fitted.
/// @return empty if no level between 0.05 and 20 does it
[[nodiscard]] std::optional<double> fit_level(const WindSettings& config, const std::vector<DeckAerodynamics>& data,
                                              const std::string& set, const WindModel& model);

}  // namespace twindeck::aero
