#include "updating/regularised.hpp"

#include <cmath>

namespace twindeck::updating {

std::optional<PredictionErrors> prediction_errors(const UpdatingResult& result, const std::vector<FrequencyTarget>& targets) {
  if (result.left_out.size() != targets.size() || targets.empty()) return std::nullopt;
  PredictionErrors out;
  const auto n = static_cast<double>(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!(result.left_out[i].frequency_Hz > 0.0)) return std::nullopt;
    out.before += std::abs(result.frequency_before_Hz(static_cast<Eigen::Index>(i)) / targets[i].measured_Hz - 1.0) / n;
    out.left_out += std::abs(result.left_out[i].frequency_Hz / targets[i].measured_Hz - 1.0) / n;
  }
  return out;
}

std::shared_ptr<const UpdatingResult> regularised_where_worse(const UpdatingResult& found, const fe::ParametricSystem& start,
                                                              const Refresh& refresh, const std::vector<int>& active,
                                                              const std::vector<FrequencyTarget>& targets,
                                                              UpdatingOptions options, const MeasuredRows& rows) {
  const auto errors = prediction_errors(found, targets);
  if (!errors || errors->left_out <= errors->before) return nullptr;
  options.prior = true;
  options.starts = 1;
  options.elsewhere.clear();
  const auto out = std::make_shared<const UpdatingResult>(update(start, refresh, active, targets, options, {}, rows));
  return out->status.converged && prediction_errors(*out, targets) ? out : nullptr;
}

}  // namespace twindeck::updating
