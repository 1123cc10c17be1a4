#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "io/config.hpp"
#include "ponte/generator.hpp"
#include "steps/refinement/pairing_account.hpp"
#include "steps/shared/solved_model.hpp"

/// As-built changes and comparison with the measurement: paper section 4.1, Tables 6 and 7.
namespace twindeck::steps {

struct RefinementConfig {
  long n_modes = 15;                ///< computed modes that are written and compared
  long extra_modes = 5;             ///< solved for beyond them, so that followed modes are among them
  std::string variant = "refined";  ///< of the generator
  std::vector<std::string> pairs;   ///< published assignment, used where no shape was measured; empty = by order
  std::string condition;            ///< of the measured features; "" = as choose_condition has it
  double minimum_mac = usual_minimum_mac;
  double least_paired = usual_least_paired;
  double maximum_frequency_error = 0.35;
  double cluster_gap = 0.02;
  double sensor_tolerance_m = 0.5;  ///< largest distance of a sensor from its node
  [[nodiscard]] io::FieldTable fields();
};

/// One as-built change: alone on the preliminary model, and on top of those before it.
struct ChangeEffect {
  ponte::Change change;
  FollowedModes alone;       ///< followed from the preliminary model
  FollowedModes cumulative;  ///< the same modes, followed from change to change, after this and all earlier ones
};

struct ChangeStudy {
  Eigen::VectorXd before_Hz;  ///< (n_modes) preliminary model
  std::vector<ChangeEffect> effects;
  Status status;
};

/// Each change is generated, prestressed and solved on its own; models run side by side, results do not depend on how many.
/// @param mesh  of the generator, "" for its own  @param progress  called with the number of models done
[[nodiscard]] ChangeStudy study_changes(const std::filesystem::path& bridge_toml, const std::string& mesh, int n_modes,
                                        int extra_modes, const std::function<void(int done, int of)>& progress);

/// changes.csv: `change,paper_item,meaning,mode,frequency_before_Hz,frequency_alone_Hz,effect_alone_pct,effect_cumulative_pct,
/// mac_alone,mac_cumulative`. Effects are relative to the preliminary model; cumulative: this change and all before it.
/// mac_cumulative is the one with the state before.
void write_changes(const ChangeStudy& study, const std::filesystem::path& folder);

/// The step: everything between the command line and the manifest.
[[nodiscard]] Computation read_refinement(StepContext& context, const RefinementConfig& config);

}  // namespace twindeck::steps
