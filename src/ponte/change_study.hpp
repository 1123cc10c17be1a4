#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "matching/solved_model.hpp"
#include "ponte/generator.hpp"

/// What each as-built change does to the bridge's modes: paper section 4.1, Table 6.
namespace twindeck::ponte {

/// One as-built change: alone on the preliminary model, and on top of those before it.
struct ChangeEffect {
  Change change;
  matching::TrackedModes alone;       ///< followed from the preliminary model
  matching::TrackedModes cumulative;  ///< the same modes, followed from change to change, after this and all earlier ones
};

struct ChangeStudy {
  Eigen::VectorXd before_Hz;  ///< (n_modes) preliminary model
  std::vector<ChangeEffect> effects;
  Status status;
};

/// Each model is generated, prestressed and solved on its own, in parallel. Results do not depend on the number of threads.
/// @param mesh  of the generator, "" for its own  @param progress  called with the number of models done
[[nodiscard]] ChangeStudy study_changes(const std::filesystem::path& bridge_toml, const std::string& mesh, int n_modes,
                                        int extra_modes, const std::function<void(int done, int of)>& progress);

}  // namespace twindeck::ponte
