#include "diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace twindeck::diagnosis {
namespace {

constexpr double kLeastSignature = 1e-9;  ///< [-] of an unknown's signature on whitened rows; smaller ones are rounding
constexpr std::size_t kLongestMap = 40;   ///< locations, as many as a figure shows; the scores of others are chance

constexpr double kNearBound = 0.02;  ///< [-] of a parameter's range; a parameter nearer to its end counts as on the bound

}  // namespace

std::vector<LocationScore> location_map(const Inference& inference, const Fit& fit, const std::vector<Scored>& ranking) {
  std::map<std::string, double> best;
  const auto& nuisances = inference.map().nuisances();
  for (std::size_t j = 0; j < nuisances.size(); ++j) {
    const Nuisance& v = nuisances[j];
    if (v.kind == Nuisance::Kind::mode_damping || v.kind == Nuisance::Kind::level) continue;
    const Eigen::VectorXd l =
        fit.total_factor.triangularView<Eigen::Lower>().solve(fit.map.jacobian.col(static_cast<Eigen::Index>(j)));
    if (!(l.norm() > kLeastSignature)) continue;
    const std::string location = v.kind == Nuisance::Kind::parameter ? "group:" + v.name : v.name.substr(0, v.name.find(' '));
    double& score = best[location];
    score = std::max(score, std::abs(l.dot(fit.whitened)) / l.norm());
  }
  for (const Scored& scored : ranking) {
    if (scored.candidate->location == "global" || scored.candidate->hypothesis->measurement || scored.screen <= 0.0) continue;
    double& score = best[scored.candidate->location];
    score = std::max(score, std::sqrt(scored.screen));
  }
  std::vector<LocationScore> map;
  for (const auto& [location, score] : best) map.push_back({location, score});
  std::ranges::stable_sort(map, [](const auto& a, const auto& b) { return a.score > b.score; });
  if (map.size() > kLongestMap) map.resize(kLongestMap);
  return map;
}

std::vector<std::string> parameters_on_bounds(const FeatureMap& map, const Fit& fit) {
  std::vector<std::string> names;
  const auto& nuisances = map.nuisances();
  for (std::size_t j = 0; j < nuisances.size(); ++j) {
    const Nuisance& v = nuisances[j];
    const double range = v.upper - v.lower;
    if (v.kind != Nuisance::Kind::parameter || !std::isfinite(range)) continue;
    const double u = fit.map.x[static_cast<Eigen::Index>(j)];
    if (u < v.lower + kNearBound * range || u > v.upper - kNearBound * range) names.push_back(v.name);
  }
  return names;
}

std::string sentence_of(const Effect& effect) {
  std::string text = effect.cause.candidate->hypothesis->sentence;
  const auto replace = [&](const std::string& key, const std::string& value) {
    for (auto at = text.find(key); at != std::string::npos; at = text.find(key)) text.replace(at, key.size(), value);
  };
  replace("{location}", effect.cause.candidate->location);
  for (const EffectParameter& p : effect.parameters) {
    replace("{" + p.name + "}", fmt::format("{:.4g}", p.value));
    replace("{" + p.name + ".low}", fmt::format("{:.4g}", p.low));
    replace("{" + p.name + ".high}", fmt::format("{:.4g}", p.high));
  }
  return text;
}

}  // namespace twindeck::diagnosis
