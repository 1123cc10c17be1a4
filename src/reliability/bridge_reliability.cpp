#include "reliability/bridge_reliability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aero/stability.hpp"
#include "buffeting/loads.hpp"
#include "buffeting/spectral.hpp"
#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"

namespace twindeck::reliability {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// [Hz] derivatives are those of this frequency below it, as in step 8.
constexpr double kLowestDerivatives_Hz = 0.2;

aero::AeroelasticSystem varied_system(const UncertainBridge& bridge, const aero::WindModel& model,
                                      const VariedStructure::Varied& varied, const WindVariation& variation,
                                      const aero::Wind& wind, const aero::Deployment& deployment) {
  return {varied.structure, bridge.sections(variation.aerodynamic_factor), model.strips, varied.motions, wind, deployment};
}

/// Moments of every row; empty where the bridge is unstable.
std::vector<SpectralMoments> moments_at(const UncertainBridge& bridge, const WindResponse& response, const MatrixXd& rows,
                                        double speed_m_s, const VectorXd& u) {
  const WindVariation variation = bridge.variation(u);
  const VariedStructure::Varied varied = response.structure.at(variation);
  const aero::AeroelasticSystem system =
      varied_system(bridge, response.bridge.model, varied, variation, response.bridge.aerodynamics.wind(), response.deployment);
  const double turn = 2.0 * std::numbers::pi, frozen = response.bridge.frozen_omega;
  const aero::DerivativeFrequencies frequencies{frozen, {turn * kLowestDerivatives_Hz, turn * response.settings.cutoff_Hz}};
  if (aero::find_growth(system, speed_m_s, frequencies)) return {};
  const MatrixXd load = buffeting::load_matrix(system, speed_m_s, response.settings.equation_choice());
  const auto field = [&](wind::Component component) {
    wind::FieldDefinition out = buffeting::field_at_nodes(response.bridge, response.turbulence, response.settings.height_m,
                                                          speed_m_s, component, response.settings.frozen);
    out.sigma_m_s *= variation.turbulence_factor;
    return out;
  };
  buffeting::SpectralOptions options;
  options.derivative = response.derivative;
  options.frozen_omega = frozen;
  options.lowest_omega = turn * kLowestDerivatives_Hz;
  const VectorXd f = buffeting::spectral_frequencies(response.settings.cutoff_Hz);
  const MatrixXd spectra = buffeting::response_spectra(system, speed_m_s, load, field(wind::Component::along),
                                                       field(wind::Component::vertical), rows * varied.turn, f, options);
  std::vector<SpectralMoments> out;
  for (Index row = 0; row < spectra.cols(); ++row) out.push_back(spectral_moments(f, spectra.col(row)));
  return out;
}

VectorXd unit(Index n, Index i, double value) {
  VectorXd u = VectorXd::Zero(n);
  u[i] = value;
  return u;
}

}  // namespace

WindVariation UncertainBridge::variation(const VectorXd& u) const {
  const VectorXd x = random.values(u);
  WindVariation out;
  out.parameter_change.resize(static_cast<Index>(parameters.size()));
  out.damping_ratio = damping_ratio;
  Index parameter = 0;
  for (std::size_t i = 0; i < random.inputs().size(); ++i) {
    const std::string& name = random.inputs()[i].name;
    const double value = x[static_cast<Index>(i)];
    if (name == kDamping)
      out.damping_ratio = value;
    else if (name == kSlope)
      out.aerodynamic_factor = value;
    else if (name == kDampers)
      out.damper_factor = value;
    else if (name == kTurbulence)
      out.turbulence_factor = value;
    else {
      const int p = parameters[static_cast<std::size_t>(parameter)];
      out.parameter_change[parameter++] = value - loaded.theta[p];
    }
  }
  return out;
}

double LogLinear::at(const VectorXd& u) const { return value * std::exp(slope.dot(u)); }

double CriticalSpeed::probability_below(double speed) const {
  if (!speed_m_s) return 0.0;
  const double distance = std::log(speed / speed_m_s->value), deviation = speed_m_s->deviation();
  if (deviation == 0.0) return distance > 0.0 ? 1.0 : 0.0;
  return normal_probability(distance / deviation);
}

CriticalSpeed critical_speed(const UncertainBridge& bridge, const aero::WindSettings& settings, const aero::WindModel& model,
                             const VariedStructure& structure, const aero::Deployment& deployment, bool dampers) {
  const auto speed_at = [&](const VectorXd& u) -> std::optional<double> {
    const WindVariation variation = bridge.variation(u);
    const aero::Instability found = aero::first_instability(
        settings, varied_system(bridge, model, structure.at(variation), variation, settings.wind(), deployment));
    return found.point ? std::optional<double>(found.point->speed_m_s) : std::nullopt;
  };
  CriticalSpeed out{deployment.name, dampers, std::nullopt};
  const Index n = bridge.random.dimension();
  std::vector<std::optional<double>> at(static_cast<std::size_t>(2 * n + 1));
  parallel_for(2 * n + 1, [&](long k) {
    at[static_cast<std::size_t>(k)] =
        speed_at(k == 0 ? VectorXd(VectorXd::Zero(n)) : unit(n, (k - 1) / 2, k % 2 == 1 ? 1.0 : -1.0));
  });
  if (std::any_of(at.begin(), at.end(), [](const auto& each) { return !each; })) return out;
  LogLinear linear{*at[0], VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    linear.slope[i] = 0.5 * std::log(*at[static_cast<std::size_t>(2 * i + 1)] / *at[static_cast<std::size_t>(2 * i + 2)]);
  }
  out.speed_m_s = linear;
  return out;
}

UncertainMoments uncertain_moments(
    const UncertainBridge& bridge, const WindResponse& response, double speed_m_s,
    const std::function<std::vector<std::size_t>(const std::vector<SpectralMoments>& mean)>& choose) {
  const Index n = bridge.random.dimension();
  UncertainMoments out;
  out.mean = moments_at(bridge, response, response.rows, speed_m_s, VectorXd::Zero(n));
  out.stable = !out.mean.empty();
  if (!out.stable) return out;
  out.varied = choose(out.mean);
  MatrixXd rows(static_cast<Index>(out.varied.size()), response.rows.cols());
  for (std::size_t k = 0; k < out.varied.size(); ++k)
    rows.row(static_cast<Index>(k)) = response.rows.row(static_cast<Index>(out.varied[k]));
  out.variance_slope.assign(out.varied.size(), VectorXd::Zero(n));
  out.rate_slope = out.bandwidth_slope = out.variance_slope;
  for (Index i = 0; i < n; ++i) {
    const std::vector<SpectralMoments> above = moments_at(bridge, response, rows, speed_m_s, unit(n, i, 1.0));
    const std::vector<SpectralMoments> below = moments_at(bridge, response, rows, speed_m_s, unit(n, i, -1.0));
    if (above.empty() || below.empty()) {  // a deviation away it is unstable: its moments have no first-order spread
      out.stable = false;
      return out;
    }
    for (std::size_t k = 0; k < out.varied.size(); ++k) {
      out.variance_slope[k][i] = 0.5 * std::log(above[k].variance / below[k].variance);
      out.rate_slope[k][i] = 0.5 * std::log(above[k].mean_rate_Hz() / below[k].mean_rate_Hz());
      out.bandwidth_slope[k][i] = 0.5 * std::log(above[k].bandwidth() / below[k].bandwidth());
    }
  }
  return out;
}

SpectralMoments UncertainMoments::at(std::size_t k, const VectorXd& u) const {
  const SpectralMoments& there = mean[varied[k]];
  SpectralMoments out = there;
  const double rate = std::exp(rate_slope[k].dot(u));
  const double bandwidth = std::min(1.0, there.bandwidth() * std::exp(bandwidth_slope[k].dot(u)));
  out.variance *= std::exp(variance_slope[k].dot(u));
  out.second = there.second / there.variance * out.variance * rate * rate;
  out.first = std::sqrt((1.0 - bandwidth * bandwidth) * out.variance * out.second);
  out.fourth *= out.variance / there.variance * std::pow(rate, 4);
  return out;
}

Excursion excursion(const UncertainMoments& moments, std::size_t k, double limit, double duration_s, int samples,
                    std::uint64_t seed) {
  const Index n = moments.variance_slope[k].size();
  const SpectralMoments& there = moments.mean[moments.varied[k]];
  const FirstExcursion mean = first_excursion(there, limit, duration_s);
  Excursion out{mean.vanmarcke, mean.vanmarcke, mean.vanmarcke, mean.poisson, crossing_rate_Hz(there, limit)};
  if (n == 0) return out;
  std::vector<double> found(static_cast<std::size_t>(samples));
  for (std::size_t sample = 0; sample < found.size(); ++sample) {
    VectorXd u(n);
    for (Index i = 0; i < n; ++i) u[i] = normal_number(seed, sample, static_cast<std::uint64_t>(i));
    found[sample] = first_excursion(moments.at(k, u), limit, duration_s).vanmarcke;
  }
  std::sort(found.begin(), found.end());
  out.mean = 0.0;
  for (const double p : found) out.mean += p / samples;
  out.low = found[static_cast<std::size_t>(0.05 * samples)];
  out.high = found[static_cast<std::size_t>(0.95 * samples)];
  return out;
}

}  // namespace twindeck::reliability
