#include "updating/twins.hpp"

#include <fmt/format.h>

#include "sensitivity/frequency_jacobian.hpp"
#include "updating/posterior.hpp"

namespace twindeck::updating {

namespace {

using Eigen::Index;

/// Shift of each paired frequency, in its standard deviations, over half the range of each active parameter.
Eigen::MatrixXd scaled_shifts(const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes,
                              const std::vector<int>& active, const matching::Measured& measured,
                              const matching::Pairing& pairing) {
  const Eigen::MatrixXd exact = sensitivity::frequency_jacobian(loaded.system, loaded.theta, modes);
  Eigen::MatrixXd shifts(static_cast<Index>(pairing.pairs.size()), static_cast<Index>(active.size()));
  for (Index i = 0; i < shifts.rows(); ++i) {
    const matching::ModePair& pair = pairing.pairs[static_cast<std::size_t>(i)];
    for (Index j = 0; j < shifts.cols(); ++j) {
      const int p = active[static_cast<std::size_t>(j)];
      const fe::Parameter& parameter = loaded.system.parameters[static_cast<std::size_t>(p)];
      shifts(i, j) = exact(pair.numerical, p) * 0.5 * (parameter.upper - parameter.lower) /
                     measured.modes.frequency_std_Hz[pair.experimental];
    }
  }
  return shifts;
}

}  // namespace

std::vector<std::vector<std::string>> indistinct_parameters(const dynamics::LoadedModel& loaded,
                                                            const dynamics::EigenModes& modes, const std::vector<int>& active,
                                                            const matching::Measured& measured,
                                                            const matching::Pairing& pairing) {
  return named_sets(loaded, active, updating::indistinct_sets(scaled_shifts(loaded, modes, active, measured, pairing)));
}

std::vector<std::vector<std::string>> named_sets(const dynamics::LoadedModel& loaded, const std::vector<int>& active,
                                                 const std::vector<std::vector<int>>& sets) {
  std::vector<std::vector<std::string>> named;
  for (const std::vector<int>& set : sets) {
    std::vector<std::string>& names = named.emplace_back();
    for (const int j : set)
      names.push_back(loaded.system.parameters[static_cast<std::size_t>(active[static_cast<std::size_t>(j)])].name);
  }
  return named;
}

void warn_of_twins(Reporter& reporter, const std::vector<std::vector<std::string>>& sets, bool has_shapes) {
  const char* mend = has_shapes ? "weigh the shapes too (residuals = [\"frequency\", \"shape\"]), or ask s9_diagnosis"
                                : "or ask s9_diagnosis, which weighs the shapes too";
  for (const std::vector<std::string>& names : sets)
    reporter.warn(fmt::format(
        "the paired frequencies cannot tell {} apart: what one does to them another does as well, so that blame may "
        "fall on the wrong one. Update one of them, {}",
        fmt::join(names, ", "), mend));
}

}  // namespace twindeck::updating
