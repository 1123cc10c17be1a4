#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace twindeck::reliability {

/// Law of the mean wind speed at the deck. Its kind tells what it can answer: a law of all ten-minute means (`weibull`,
/// `table`) gives hours and damage per year, a law of the largest mean of a year (`gumbel`, `code`) gives annual probabilities.
struct WindLaw {
  enum class Kind { weibull, table, gumbel, code } kind = Kind::weibull;
  double scale_m_s = 0.0, shape = 2.0;            ///< weibull: P(V > v) = exp(-(v/scale)^shape)
  double mode_m_s = 0.0, gumbel_scale_m_s = 0.0;  ///< gumbel: P(V <= v) = exp(-exp(-(v - mode)/scale)) of the annual maximum
  double basic_m_s = 0.0,
         exposure = 1.0;  ///< code: v(p) = exposure v_b c_prob(p), EN 1991-1-4:2005, 4.2 note 4, with K = 0.2, n = 0.5
  std::vector<double> speed_m_s, probability;  ///< table: share of the time in each class of speed, given by its middle
  std::string label;                           ///< user | code

  [[nodiscard]] bool of_all_means() const { return kind == Kind::weibull || kind == Kind::table; }
  /// P(V > v): of a ten-minute mean, or of the largest of a year.
  [[nodiscard]] double exceedance(double speed_m_s) const;
  /// Mean of `of_speed` over the law, by classes of `step_m_s` [m/s] (a table has its own classes).
  [[nodiscard]] double average(const std::function<double(double speed_m_s)>& of_speed, double step_m_s = 0.5) const;
};

/// Mean speed at a height over the basic speed, c_r = 0.19 (z0/0.05)^0.07 ln(z/z0), constant below the least height, in a
/// terrain of category 0, I, II, III or IV. Reference: EN 1991-1-4:2005, 4.3.2 and table 4.1.  @return nothing for an unknown
/// category
[[nodiscard]] std::optional<double> roughness_factor(const std::string& terrain, double height_m);

/// @throws InputError  with the key: a scale that is not positive, a table whose probabilities do not sum to one (within 1e-3)
/// @param file  of the table, for the message
void check_wind_law(const WindLaw& law, const std::string& file = "");

/// A quantity at some mean speeds, in ascending order of speed.
struct OverSpeed {
  std::vector<double> speed_m_s, value;

  /// A probability between its points: linear, from 0 in calm air on; above the last point it is `beyond`.
  [[nodiscard]] double probability(double speed_m_s, double beyond) const;
  /// A damage between its points: a power of the speed from each point to the next, continued beyond both ends.
  /// @pre two points or more
  [[nodiscard]] double damage(double speed_m_s) const;
};

}  // namespace twindeck::reliability
