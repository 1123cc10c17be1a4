#include "steps/updating/twins.hpp"

#include <fmt/format.h>

#include <numeric>

#include "sensitivity/eigen_sensitivity.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;

constexpr double seen_from = 1.0;  ///< [standard deviations] of all frequencies together: what is less is noise (as in step 5)

/// Shift of each paired frequency, in its standard deviations, over half the range of each active parameter.
Eigen::MatrixXd scaled_shifts(const LoadedModel& loaded, const dynamics::EigenModes& modes, const std::vector<int>& active,
                              const Measured& measured, const Pairing& pairing) {
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

bool alike(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.norm() < seen_from || b.norm() < seen_from) return false;
  const Eigen::VectorXd& larger = a.norm() < b.norm() ? b : a;
  const Eigen::VectorXd& smaller = a.norm() < b.norm() ? a : b;
  return (smaller - larger * (larger.dot(smaller) / larger.squaredNorm())).norm() < seen_from;
}

}  // namespace

std::vector<std::vector<std::string>> indistinct_parameters(const LoadedModel& loaded, const dynamics::EigenModes& modes,
                                                            const std::vector<int>& active, const Measured& measured,
                                                            const Pairing& pairing) {
  const Eigen::MatrixXd shifts = scaled_shifts(loaded, modes, active, measured, pairing);
  std::vector<std::size_t> set(active.size());  // of each parameter, by its first member
  std::iota(set.begin(), set.end(), std::size_t{0});
  for (std::size_t i = 0; i < active.size(); ++i)
    for (std::size_t j = i + 1; j < active.size(); ++j)
      if (set[j] == j && alike(shifts.col(static_cast<Index>(i)), shifts.col(static_cast<Index>(j)))) set[j] = set[i];
  std::vector<std::vector<std::string>> sets;
  for (std::size_t first = 0; first < set.size(); ++first) {
    std::vector<std::string> names;
    for (std::size_t j = 0; j < set.size(); ++j)
      if (set[j] == first) names.push_back(loaded.system.parameters[static_cast<std::size_t>(active[j])].name);
    if (names.size() > 1) sets.push_back(names);
  }
  return sets;
}

void warn_of_twins(StepContext& context, const std::vector<std::vector<std::string>>& sets) {
  for (const std::vector<std::string>& names : sets)
    context.warn(fmt::format(
        "the paired frequencies cannot tell {} apart: what one does to them another does as well, so that blame may "
        "fall on the wrong one. Update one of them, or ask s9_diagnosis, which weighs the shapes too",
        fmt::join(names, ", ")));
}

}  // namespace twindeck::steps
