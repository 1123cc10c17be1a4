#include "dynamics/measured_slips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"

namespace twindeck::dynamics {

namespace {

using Eigen::Index;

constexpr double rigid_body = 1e-5;           ///< [-] of the highest computed frequency: rounding of zero
constexpr double stands_off = 50.0;           ///< [-] from one measured frequency to the next; bands are not that far apart
constexpr double known_factor_within = 1.15;  ///< [-] of the factor of a slip, which sits on top of a model's own error
constexpr double sound_model_within = 1.35;   ///< [-] of measured frequencies; pairing admits as much
constexpr int fewest_ratios = 3;              ///< of frequencies alone: two ratios agree by chance
constexpr int fewest_shapes = 2;              ///< of pairs by shape
constexpr double same_shape_mac = 0.9;        ///< [-] the usual mark of one and the same mode
constexpr double most_model_error = 5.0;      ///< [-] between measured and computed frequencies

/// Positions of a measured and a computed mode that may be one and the same.
struct ComparedModes {
  Index measured, computed;
};

/// Modes of a measurement with computed modes, both ascending in frequency.
struct ModesInOrder {
  std::vector<ComparedModes> pairs;
  bool by_shape = false;        ///< else the lowest with the lowest, and so on
  std::vector<double> ratios;   ///< measured over computed frequency, ascending
  bool without_factor = false;  ///< other pairs, likewise in order, differ by no more than a sound model errs
  bool reached = false;         ///< the highest computed mode lies near the highest measured one, or above it

  [[nodiscard]] double ratio() const { return ratios[ratios.size() / 2]; }
};

/// Gives each measured mode, ascending, the lowest computed one above that of the mode before which `fits` it.
template <typename Fits>
std::vector<ComparedModes> lowest_that_fit(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz, Fits fits) {
  std::vector<Index> order(static_cast<std::size_t>(measured.frequency_Hz.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Index i) { return measured.frequency_Hz[i]; });
  std::vector<ComparedModes> pairs;
  Index next = first_elastic(computed_Hz);
  for (const Index i : order) {
    Index n = next;
    while (n < computed_Hz.size() && !fits(i, n)) ++n;
    if (n == computed_Hz.size()) continue;
    pairs.push_back({i, n});
    next = n + 1;
  }
  return pairs;
}

/// By shape where two modes and half of the measured ones have the shapes of computed modes. Shapes tell which computed modes
/// were measured; frequencies do not: a model has modes that no sensor sees.
ModesInOrder modes_in_order(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz) {
  const auto ratio = [&](Index i, Index n) { return measured.frequency_Hz[i] / computed_Hz[n]; };
  const auto alike = [&](Index i, Index n) { return n < measured.mac.rows() && measured.mac(n, i) >= same_shape_mac; };
  ModesInOrder found;
  found.pairs = lowest_that_fit(measured, computed_Hz, alike);
  const Index n_alike = std::ssize(found.pairs);
  found.by_shape = n_alike >= fewest_shapes && 2 * n_alike >= measured.frequency_Hz.size();
  if (!found.by_shape) found.pairs = lowest_that_fit(measured, computed_Hz, [](Index, Index) { return true; });
  for (const auto& [i, n] : found.pairs) found.ratios.push_back(ratio(i, n));
  std::ranges::sort(found.ratios);
  const auto sound = lowest_that_fit(measured, computed_Hz, [&](Index i, Index n) {
    return (!found.by_shape || alike(i, n)) && std::abs(std::log(ratio(i, n))) <= std::log(sound_model_within);
  });
  found.without_factor = sound.size() >= found.pairs.size();
  if (!found.pairs.empty())
    found.reached = sound_model_within * computed_Hz[computed_Hz.size() - 1] >= measured.frequency_Hz.maxCoeff();
  return found;
}

/// Whether all pairs differ by one factor of a known slip. Few pairs do so by chance, so a least number of them is asked for.
bool differ_by_a_slip(const ModesInOrder& modes, const MeasuredFrequencies& measured) {
  if (modes.ratios.empty() || !slip_of_factor(1.0 / modes.ratio())) return false;
  const Index n = std::ssize(modes.ratios);
  if (!modes.by_shape && (n < fewest_ratios || n < measured.frequency_Hz.size())) return false;
  return std::ranges::all_of(
      modes.ratios, [&](double each) { return std::abs(std::log(each / modes.ratio())) <= std::log(known_factor_within); });
}

/// Whether a parameter's bounds reach a factor of stiffness over mass.
bool parameters_reach(const std::vector<fe::Parameter>& parameters, double stiffness_over_mass) {
  return std::ranges::any_of(parameters, [&](const fe::Parameter& p) {
    if (!(p.initial > 0.0) || !(p.lower > 0.0)) return false;
    const bool of_mass =
        p.target == fe::Target::density || p.target == fe::Target::point_mass || p.target == fe::Target::matrix_mass;
    const double most = of_mass ? p.initial / p.lower : p.upper / p.initial;
    const double least = of_mass ? p.initial / p.upper : p.lower / p.initial;
    constexpr double nearly = 1.3;  // [-] of stiffness over mass: the model's own error
    return most * nearly >= stiffness_over_mass && least <= nearly * stiffness_over_mass;
  });
}

/// "all 3 measured frequencies (1.21 to 2.68 Hz) are 3.16 times the computed ones in the order of both (0.384 to 0.847 Hz)".
std::string factor_words(const ModesInOrder& modes, const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz) {
  const auto n = static_cast<std::size_t>(measured.frequency_Hz.size());
  const ComparedModes &low = modes.pairs.front(), &high = modes.pairs.back();
  return fmt::format(
      "{} measured frequencies ({:g} to {:g} Hz) are {:.3g} times {} ({:.3g} to {:.3g} Hz)",
      modes.pairs.size() < n ? fmt::format("{} of {}", modes.pairs.size(), n) : fmt::format("all {}", n),
      measured.frequency_Hz[low.measured], measured.frequency_Hz[high.measured], modes.ratio(),
      modes.by_shape ? "those of the computed modes with their shapes" : "the computed ones in the order of both",
      computed_Hz[low.computed], computed_Hz[high.computed]);
}

/// The measured frequencies on the smaller side of a gap of `stands_off`, each with the factor that brings it back.
std::vector<std::string> outliers(const MeasuredFrequencies& measured) {
  const Eigen::VectorXd& measured_Hz = measured.frequency_Hz;
  std::vector<Index> order(static_cast<std::size_t>(measured_Hz.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::ranges::sort(order, [&](Index a, Index b) { return measured_Hz[a] < measured_Hz[b]; });
  std::vector<std::string> slips;
  for (std::size_t gap = 1; gap < order.size(); ++gap) {
    const double below = measured_Hz[order[gap - 1]], above = measured_Hz[order[gap]];
    if (!(above > stands_off * below)) continue;
    const bool upper = order.size() - gap <= gap;  // the fewer are odd; of equally many the upper ones
    const std::size_t from = upper ? gap : 0, to = upper ? order.size() : gap;
    const double low = measured_Hz[order[upper ? 0 : gap]], high = measured_Hz[order[upper ? gap - 1 : order.size() - 1]];
    for (std::size_t i = from; i < to; ++i) {
      const double value = measured_Hz[order[i]], scaled = upper ? value / 1000.0 : value * 1000.0;
      const bool fits = scaled >= low / 3.0 && scaled <= 3.0 * high;
      slips.push_back(fmt::format("mode {} is measured at {:g} Hz, but the others lie between {:g} and {:g} Hz{}",
                                  measured.names[static_cast<std::size_t>(order[i])], value, low, high,
                                  fits ? fmt::format(": is it in {}, or is the decimal point lost? {:g} Hz would be among them",
                                                     upper ? "mHz" : "kHz", scaled)
                                       : std::string(": check its unit")));
    }
    return slips;
  }
  return slips;
}

}  // namespace

Eigen::Index first_elastic(const Eigen::VectorXd& ascending_Hz) {
  Index at = 0;
  while (at < ascending_Hz.size() && !(ascending_Hz[at] > rigid_body * ascending_Hz[ascending_Hz.size() - 1])) ++at;
  return at;
}

double highest_of_band(Eigen::VectorXd measured_Hz) {
  const Index n = measured_Hz.size();
  std::sort(measured_Hz.begin(), measured_Hz.end());
  for (Index gap = 1; gap < n; ++gap)
    if (measured_Hz[gap] > stands_off * measured_Hz[gap - 1] && n - gap <= gap) return measured_Hz[gap - 1];
  return n > 0 ? measured_Hz[n - 1] : 0.0;
}

std::optional<std::string> slip_of_factor(double computed_over_measured) {
  struct Likely {
    double factor;
    const char* words;
  };
  const double thousand = std::sqrt(1000.0), gravity = std::sqrt(gravity_m_s2), feet = std::sqrt(gravity_ft_s2);
  std::array<Likely, 12> known = {
      {{1.0 / gravity, "is a weight in newtons given as a mass in kilograms?"},
       {gravity, "is a mass divided by g once too often?"},
       {1.0 / feet, "is a weight in lbf given as a mass in slugs (divide by 32.174)?"},
       {feet, "is a mass in slugs divided by g = 32.174 ft/s2 once too often?"},
       {1.0 / std::sqrt(gravity_in_s2), "is a weight in lbf given as a mass (PARAM,WTMASS,.00259 missing)?"},
       {1.0 / (thousand * gravity), "is a weight in newtons given as a mass in tonnes?"},
       {1.0 / thousand, "is the model's stiffness in kN/m or N/mm, or its mass in grams?"},
       {thousand, "is the model's mass in tonnes?"},
       {1e-3, "is a modulus of the model in MPa, its mass in milligrams, or are the measured frequencies in mHz?"},
       {1e3, "are the measured frequencies in kHz?"},
       {1.0 / (2.0 * std::numbers::pi), "are the measured frequencies in rad/s?"},
       {1.0 / 60.0, "are the measured frequencies in cycles per minute?"}}};
  const auto off = [&](const Likely& likely) { return std::abs(std::log(computed_over_measured / likely.factor)); };
  std::ranges::sort(known, {}, off);
  std::string words;
  for (const Likely& likely : known) {
    if (!(off(likely) < std::log(known_factor_within))) break;
    if (!words.empty()) words.back() = ',';
    words += words.empty() ? likely.words : fmt::format(" or {}", likely.words);
  }
  return words.empty() ? std::nullopt : std::optional(words);
}

std::optional<double> one_factor(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz, bool doubted) {
  const ModesInOrder modes = modes_in_order(measured, computed_Hz);
  // By frequencies alone, modes above the computed ones might fit without a factor too.
  const bool sure = modes.by_shape ? !modes.without_factor : doubted || (!modes.without_factor && modes.reached);
  return sure && differ_by_a_slip(modes, measured) ? std::optional(modes.ratio()) : std::nullopt;
}

std::vector<std::string> measured_slips(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz) {
  std::vector<std::string> slips = outliers(measured);
  const ModesInOrder modes = modes_in_order(measured, computed_Hz);
  if (!slips.empty() || modes.pairs.empty()) return slips;
  const double ratio = modes.ratio();
  const bool is_error = modes.without_factor || (ratio < most_model_error && ratio > 1.0 / most_model_error);
  const bool is_slip = differ_by_a_slip(modes, measured) && !(modes.by_shape && modes.without_factor);
  if (is_error && !is_slip) return slips;
  slips.push_back(fmt::format("{}: {}{}", factor_words(modes, measured, computed_Hz),
                              slip_of_factor(1.0 / ratio).value_or("check the units of both"),
                              modes.without_factor ? " Or the measured modes are others of the computed ones, of which some "
                                                     "fit without a factor: shapes or `pairs` decide"
                                                   : ""));
  return slips;
}

void refuse_one_factor(const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                       const std::vector<MeasuredFrequencies>& measured, FactorWithinBounds within_bounds, bool doubted) {
  for (const MeasuredFrequencies& condition : measured) {
    const std::optional<double> ratio = one_factor(condition, computed_Hz, doubted);
    const bool reached = ratio && parameters_reach(loaded.system.parameters, *ratio * *ratio);
    if (!ratio || (reached && within_bounds == FactorWithinBounds::passes)) continue;
    throw InputError({loaded.source, 0, ""},
                     fmt::format("{}, a factor of {:.3g} in stiffness over mass{}: {}",
                                 factor_words(modes_in_order(condition, computed_Hz), condition, computed_Hz), *ratio * *ratio,
                                 reached ? "" : " that no parameter's bounds reach",
                                 slip_of_factor(1.0 / *ratio).value_or("look for a unit")),
                     within_bounds == FactorWithinBounds::passes
                         ? "give masses in kg, densities in kg/m3, stiffness in N/m and moduli in Pa, or let the bounds of a "
                           "parameter reach it"
                         : "give masses in kg, densities in kg/m3, stiffness in N/m and moduli in Pa; a parameter that is "
                           "meant to be so far off gets that value in the model and as its `initial`");
  }
}

}  // namespace twindeck::dynamics
