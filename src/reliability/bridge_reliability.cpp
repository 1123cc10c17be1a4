#include "reliability/bridge_reliability.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "aero/stability.hpp"
#include "buffeting/loads.hpp"
#include "buffeting/spectral.hpp"
#include "core/distributions.hpp"
#include "core/random.hpp"

namespace twindeck::reliability {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// [Hz] derivatives are those of this frequency below it, as in step 8.
constexpr double kLowestDerivatives_Hz = 0.2;

VectorXd unit(Index n, Index i, double value) {
  VectorXd u = VectorXd::Zero(n);
  u[i] = value;
  return u;
}

/// Half of the logarithm of the ratio above / below; 0 for equal numbers.
double half_log(double above, double below) { return above == below ? 0.0 : 0.5 * std::log(above / below); }

/// A bridge with its inputs at their medians, and the derivative frequencies of its aerodynamic forces.
struct AtMedians {
  const UncertainBridge& bridge;
  const aero::WindModel& model;
  const VariedStructure& structure;
  aero::Wind wind;
  const aero::Deployment& deployment;
  WindVariation variation;
  VariedStructure::Varied varied;

  AtMedians(const UncertainBridge& of, const aero::WindModel& in, const VariedStructure& on, const aero::Wind& blows,
            const aero::Deployment& by)
      : bridge(of),
        model(in),
        structure(on),
        wind(blows),
        deployment(by),
        variation(of.variation(VectorXd::Zero(of.random.dimension()))),
        varied(on.at(variation)) {}
  /// @param factor  of the aerodynamic level beside its median
  [[nodiscard]] aero::AeroelasticSystem system(double factor = 1.0) const {
    return {varied.structure, bridge.sections(factor * variation.aerodynamic_factor), model.strips, varied.motions, wind,
            deployment};
  }
};

/// [-] Step of the aerodynamic level for central differences. The forces are linear in it, or nearly so.
constexpr double kLevelStep = 1e-3;

/// First-order changes of the system with each number of u. @param settings  of the buffeting loads; null: no loads are
/// computed
std::vector<buffeting::SystemSlope> system_slopes(const AtMedians& at, double speed_m_s, double omega,
                                                  const buffeting::WindEventSettings* settings) {
  const aero::AeroelasticSystem above = at.system(std::exp(kLevelStep)), below = at.system(std::exp(-kLevelStep));
  const aero::AeroelasticSystem::Block high = above.self_excited(speed_m_s, omega), low = below.self_excited(speed_m_s, omega);
  const double per_log = 0.5 / kLevelStep;
  const auto loads = [&](const aero::AeroelasticSystem& of) {
    return buffeting::load_matrix(of, speed_m_s, settings->equations, settings->components());
  };
  MatrixXd load;
  if (settings != nullptr) load = per_log * (loads(above) - loads(below));
  std::vector<buffeting::SystemSlope> out;
  for (const UncertainBridge::Change& change : at.bridge.changes()) {
    VariedStructure::Slope of_structure = at.structure.slope(at.varied, change.parameters, change.damping);
    buffeting::SystemSlope slope{std::move(of_structure.mass),
                                 std::move(of_structure.damping),
                                 std::move(of_structure.stiffness),
                                 change.dampers,
                                 {},
                                 change.turbulence};
    if (at.varied.structure.viscous.size() > 0) slope.damping += change.dampers * at.varied.structure.viscous;
    if (change.aerodynamic != 0.0) {
      slope.damping -= change.aerodynamic * per_log * (high.damping - low.damping);
      slope.stiffness -= change.aerodynamic * per_log * (high.stiffness - low.stiffness);
      if (settings != nullptr) slope.load = change.aerodynamic * load;
    }
    out.push_back(std::move(slope));
  }
  return out;
}

/// [-] step of the central differences of the impedance by speed and frequency.
constexpr double kImpedanceStep = 1e-4;

/// Slopes of ln V_cr at a crossing.
VectorXd crossing_slopes(const aero::AeroelasticSystem& system, const aero::CriticalPoint& point,
                         const std::vector<buffeting::SystemSlope>& slopes) {
  VectorXd out = VectorXd::Zero(std::ssize(slopes));
  // A mode that is not damped in still air has no crossing: it grows from the first speed on, whatever the inputs are.
  if (point.bracket_m_s == point.speed_m_s) return out;
  const double speed = point.speed_m_s, omega = point.motion.lambda.imag(), h = kImpedanceStep;
  const auto impedance = [&](double v, double w) { return buffeting::impedance(system, system.self_excited(v, w), w); };
  const Eigen::VectorXcd& right = point.motion.vector;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> factor(impedance(speed, omega).transpose());
  Eigen::VectorXcd left = right.conjugate();
  for (int i = 0; i < 3; ++i) left = factor.solve(left).normalized();
  const auto between = [&](const Eigen::MatrixXcd& z) { return (left.transpose() * z * right)(0); };
  const std::complex<double> by_omega = between(impedance(speed, omega * (1.0 + h)) - impedance(speed, omega * (1.0 - h))) /
                                        (2.0 * h * omega),
                             by_speed = between(impedance(speed * (1.0 + h), omega) - impedance(speed * (1.0 - h), omega)) /
                                        (2.0 * h * speed);
  Eigen::Matrix2d both;
  both << by_omega.real(), by_speed.real(), by_omega.imag(), by_speed.imag();
  const Eigen::Matrix2d inverse = both.inverse();
  for (Index i = 0; i < out.size(); ++i) {
    const std::complex<double> change = between(buffeting::impedance_slope(system, slopes[static_cast<std::size_t>(i)], omega));
    out[i] = -(inverse * Eigen::Vector2d(change.real(), change.imag()))[1] / speed;
  }
  return out;
}

/// Moments of a row's spectrum: of its second derivative where it is an acceleration.
SpectralMoments row_moments(const WindResponse& response, const VectorXd& f, std::size_t row, const VectorXd& spectrum) {
  if (static_cast<Index>(row) >= response.accelerations) return spectral_moments(f, spectrum);
  const Eigen::ArrayXd omega = 2.0 * std::numbers::pi * f.array();
  return spectral_moments(f, (spectrum.array() * omega.pow(4)).matrix());
}

}  // namespace

WindVariation UncertainBridge::variation(const VectorXd& u) const {
  const VectorXd x = random.values(u);
  WindVariation out;
  out.parameter_change.resize(std::ssize(parameters));
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
    else if (name == kCorrosion)
      out.corrosion_factor = value;
    else {
      const int p = parameters[static_cast<std::size_t>(parameter)];
      out.parameter_change[parameter++] = value - loaded.theta[p];
    }
  }
  return out;
}

std::vector<UncertainBridge::Change> UncertainBridge::changes() const {
  std::vector<Change> out;
  const Index n = random.dimension();
  for (Index i = 0; i < n; ++i) {
    const WindVariation above = variation(unit(n, i, 1.0)), below = variation(unit(n, i, -1.0));
    out.push_back(
        {0.5 * (above.parameter_change - below.parameter_change), half_log(above.damping_ratio, below.damping_ratio),
         half_log(above.aerodynamic_factor, below.aerodynamic_factor), half_log(above.damper_factor, below.damper_factor),
         half_log(above.turbulence_factor, below.turbulence_factor), half_log(above.corrosion_factor, below.corrosion_factor)});
  }
  return out;
}

double CriticalSpeed::probability_below(double speed) const {
  if (!speed_m_s) return 0.0;
  const double distance = std::log(speed / speed_m_s->value), deviation = speed_m_s->deviation();
  if (deviation == 0.0) return distance > 0.0 ? 1.0 : 0.0;
  return normal_probability(distance / deviation);
}

bool CriticalSpeed::stable_nearby(double speed) const {
  if (!speed_m_s) return true;
  const double nearest = speed_m_s->slope.size() > 0 ? speed_m_s->slope.cwiseAbs().maxCoeff() : 0.0;
  return speed < speed_m_s->value * std::exp(-nearest);
}

CriticalSpeed critical_speed(const UncertainBridge& bridge, const aero::WindSettings& settings, const aero::WindModel& model,
                             const VariedStructure& structure, const aero::Deployment& deployment, bool dampers) {
  const AtMedians at(bridge, model, structure, settings.wind(), deployment);
  const aero::AeroelasticSystem system = at.system();
  CriticalSpeed out{deployment.name, dampers, std::nullopt};
  const std::optional<aero::CriticalPoint> point = aero::first_instability(settings, system).point;
  if (!point) return out;
  out.speed_m_s =
      LogLinear{point->speed_m_s,
                crossing_slopes(system, *point, system_slopes(at, point->speed_m_s, point->motion.lambda.imag(), nullptr))};
  return out;
}

UncertainMoments uncertain_moments(
    const UncertainBridge& bridge, const WindResponse& response, double speed_m_s,
    const std::function<std::vector<std::size_t>(const std::vector<SpectralMoments>& mean)>& choose) {
  const AtMedians at(bridge, response.bridge.model, response.structure, response.bridge.aerodynamics.wind(),
                     response.deployment);
  const aero::AeroelasticSystem system = at.system();
  const double turn = 2.0 * std::numbers::pi, frozen = response.bridge.frozen_omega;
  UncertainMoments out;
  // Derivatives at the frequency of the first mode do not hold for motions above the cutoff of the spectra, which are many
  // times faster. Such motions use derivatives at their own frequency, like the modes that step 7 follows.
  const double highest = turn * response.settings.cutoff_Hz;
  const aero::DerivativeFrequencies frequencies{frozen, {turn * kLowestDerivatives_Hz, highest}, highest};
  if (const std::optional<aero::Growth> growth = aero::find_growth(system, speed_m_s, frequencies)) {
    out.stable = false;
    out.growth = growth->in_words();
    return out;
  }

  const MatrixXd load = buffeting::load_matrix(system, speed_m_s, response.settings.equations, response.settings.components());
  std::vector<wind::FieldDefinition> fields =
      buffeting::fields_at_nodes(response.bridge, response.turbulence, response.settings, speed_m_s);
  for (wind::FieldDefinition& field : fields) field.sigma_m_s *= at.variation.turbulence_factor;
  buffeting::SpectralOptions options;
  options.derivative = 0;
  options.frozen_omega = frozen;
  options.lowest_omega = turn * kLowestDerivatives_Hz;
  const VectorXd f = buffeting::spectral_frequencies(response.settings.cutoff_Hz);
  const MatrixXd rows = response.rows * at.varied.turn;
  const MatrixXd spectra = buffeting::response_spectra(system, speed_m_s, load, fields, rows, f, options);
  for (Index row = 0; row < spectra.cols(); ++row)
    out.mean.push_back(row_moments(response, f, static_cast<std::size_t>(row), spectra.col(row)));

  out.varied = choose(out.mean);
  const std::vector<Index> chosen(out.varied.begin(), out.varied.end());
  const Index n = bridge.random.dimension();
  out.variance_slope.assign(out.varied.size(), VectorXd::Zero(n));
  out.rate_slope = out.bandwidth_slope = out.variance_slope;
  if (n == 0 || chosen.empty()) return out;
  const std::vector<MatrixXd> slopes =
      buffeting::response_spectra_slopes(system, speed_m_s, load, fields, rows(chosen, Eigen::all), f,
                                         system_slopes(at, speed_m_s, frozen, &response.settings), options);
  for (std::size_t k = 0; k < out.varied.size(); ++k) {
    const SpectralMoments& m = out.mean[out.varied[k]];
    if (!(m.variance > 0.0 && m.second > 0.0)) continue;
    const double centre = m.first * m.first / (m.variance * m.second);  // 1 - delta²
    for (Index i = 0; i < n; ++i) {
      const SpectralMoments d = row_moments(response, f, out.varied[k], slopes[k].col(i));
      const double zero = d.variance / m.variance, one = d.first / m.first, two = d.second / m.second;
      out.variance_slope[k][i] = zero;
      out.rate_slope[k][i] = 0.5 * (two - zero);
      if (centre < 1.0) out.bandwidth_slope[k][i] = -0.5 * centre * (2.0 * one - zero - two) / (1.0 - centre);
    }
  }
  return out;
}

void UncertainMoments::add_corrosion(const UncertainMoments& earlier, const std::vector<UncertainBridge::Change>& change) {
  for (std::size_t k = 0; k < varied.size(); ++k) {
    const SpectralMoments &now = mean[varied[k]], &then = earlier.mean[varied[k]];
    if (!(now.variance > 0.0 && then.variance > 0.0)) continue;
    for (std::size_t i = 0; i < change.size(); ++i) {
      const auto at = static_cast<Index>(i);
      variance_slope[k][at] += change[i].corrosion * std::log(now.variance / then.variance);
      rate_slope[k][at] += change[i].corrosion * std::log(now.mean_rate_Hz() / then.mean_rate_Hz());
    }
  }
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
  std::ranges::sort(found);
  out.mean = 0.0;
  for (const double p : found) out.mean += p / samples;
  out.low = found[static_cast<std::size_t>(0.05 * samples)];
  out.high = found[static_cast<std::size_t>(0.95 * samples)];
  return out;
}

LimitState excursion_limit_state(const UncertainMoments& moments, std::size_t k, double limit, double duration_s) {
  return [&moments, k, limit, duration_s](const VectorXd& u) {
    const Index n = u.size() - 1;
    const double p = first_excursion(moments.at(k, u.head(n)), limit, duration_s).vanmarcke;
    return u[n] - normal_quantile(std::clamp(p, 1e-300, 1.0 - 1e-16));
  };
}

}  // namespace twindeck::reliability
