#include "diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twindeck::diagnosis {

namespace {

constexpr double kNearBound = 0.02;  ///< [-] of a parameter's range: nearer than that to its end it stands on the bound

}  // namespace

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
