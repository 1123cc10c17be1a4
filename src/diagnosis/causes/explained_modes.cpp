#include "diagnosis/causes/explained_modes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "matching/assignment.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double hit =
    0.7;  ///< [-] of the structure's own modes so many are explained: the refined bridge model pairs 9 of 11 measured ones
constexpr double least_chance =
    0.02;  ///< [-] of an accident, and of none: no band and no list of modes is known better than that
constexpr double least_within = 0.02, most_within = 0.10;  ///< [-] see frequency_scatter
constexpr double whole_mac =
    3.0;  ///< [-] what a shape that is wholly unlike costs, in units of `within`; as in the diagnosis' own pairing
constexpr double farthest = 4.0;  ///< [-] in units of `within`: beyond it a frequency says no more than that it is another mode
constexpr double explained_first = 10.0;  ///< [-] more than all costs of a pair: what can be explained is

MatrixXd likeness(const std::vector<MeasuredShape>& measured, const VisibleModes& modes) {
  MatrixXd mac(std::ssize(measured), modes.frequency_Hz.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const MatrixXd seen = modes.shapes(measured[i].channels, Eigen::all);
    const double norm = measured[i].values.squaredNorm();
    for (Index j = 0; j < mac.cols(); ++j) {
      const double norms = norm * seen.col(j).squaredNorm();
      mac(static_cast<Index>(i), j) =
          norms > 0.0 ? std::norm(measured[i].values.dot(seen.col(j).cast<std::complex<double>>())) / norms : 0.0;
    }
  }
  return mac;
}

/// Part of the band in which a shape finds a mode that is like it.
double chance(const Eigen::RowVectorXd& mac, const VisibleModes& modes, const ExplanationRule& rule, double low, double high) {
  double covered = 0.0, end = low;
  for (Index j = 0; j < mac.size(); ++j) {
    if (mac[j] < rule.least_mac || !(modes.frequency_Hz[j] > 0.0)) continue;
    const double f = std::log(modes.frequency_Hz[j]);
    const double from = std::max(f - rule.within, end), to = std::min(f + rule.within, high);
    if (to <= from) continue;
    covered += to - from;
    end = to;
  }
  return std::clamp(covered / (high - low), least_chance, 1.0 - least_chance);
}

}  // namespace

ExplainedModes explain(const std::vector<MeasuredShape>& measured, const VisibleModes& modes, const ExplanationRule& rule) {
  ExplainedModes out;
  const std::size_t n = measured.size();
  out.mode.assign(n, -1);
  out.explained.assign(n, false);
  if (n == 0 || modes.frequency_Hz.size() == 0) return out;
  const MatrixXd mac = likeness(measured, modes);
  std::set<int> conditions;
  double low = std::log(measured[0].frequency_Hz), high = low;
  for (const MeasuredShape& m : measured) {
    conditions.insert(m.condition);
    low = std::min(low, std::log(m.frequency_Hz));
    high = std::max(high, std::log(m.frequency_Hz));
  }
  const auto distance = [&](std::size_t i, Index j) {
    return modes.frequency_Hz[j] > 0.0 ? std::abs(std::log(modes.frequency_Hz[j] / measured[i].frequency_Hz)) / rule.within
                                       : farthest;
  };
  const auto explains = [&](std::size_t i, Index j) {
    return mac(static_cast<Index>(i), j) >= rule.least_mac && distance(i, j) <= 1.0;
  };
  for (const int condition : conditions) {
    std::vector<std::size_t> here;
    for (std::size_t i = 0; i < n; ++i)
      if (measured[i].condition == condition) here.push_back(i);
    MatrixXd gain(std::ssize(here), mac.cols());
    for (std::size_t k = 0; k < here.size(); ++k)
      for (Index j = 0; j < mac.cols(); ++j)
        gain(static_cast<Index>(k), j) = (explains(here[k], j) ? explained_first : 0.0) -
                                         std::min(distance(here[k], j), farthest) -
                                         whole_mac * (1.0 - mac(static_cast<Index>(here[k]), j));
    const std::vector<int> chosen = matching::best_assignment(gain);
    for (std::size_t k = 0; k < here.size(); ++k) {
      out.mode[here[k]] = chosen[k];
      out.explained[here[k]] = chosen[k] >= 0 && explains(here[k], chosen[k]);
      out.count += out.explained[here[k]] ? 1 : 0;
    }
  }
  std::map<std::string, std::pair<double, int>> terms;
  // The band reaches as far beyond the outermost modes as a frequency may be off.
  low -= rule.within;
  high += rule.within;
  for (std::size_t i = 0; i < n; ++i) {
    const double c = chance(mac.row(static_cast<Index>(i)), modes, rule, low, high);
    auto& [sum, times] = terms[measured[i].name];
    sum += out.explained[i] ? std::log(hit / c) : std::log((1.0 - hit) / (1.0 - c));
    ++times;
  }
  for (const auto& [name, term] : terms) out.log_likelihood += term.first / term.second;
  return out;
}

double frequency_scatter(const std::vector<MeasuredShape>& measured, const VisibleModes& modes, double least_mac) {
  const ExplainedModes nearest = explain(measured, modes, {least_mac, most_within});
  std::vector<double> off;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (nearest.explained[i]) off.push_back(std::abs(std::log(modes.frequency_Hz[nearest.mode[i]] / measured[i].frequency_Hz)));
  if (off.empty()) return most_within;
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  return std::clamp(2.0 * *middle / 0.6745, least_within, most_within);
}

}  // namespace twindeck::diagnosis
