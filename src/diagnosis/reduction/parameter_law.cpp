#include "diagnosis/reduction/parameter_law.hpp"

#include <algorithm>
#include <optional>

#include "core/error.hpp"

namespace twindeck::diagnosis {

fe::Coefficient ratio_of(const fe::Coefficient& coefficient, const Eigen::VectorXd& theta) {
  fe::Coefficient out = coefficient;
  const double here = coefficient.value(theta);
  TWINDECK_ASSERT(here != 0.0);
  out.base /= here;
  return out;
}

void add_parameters_of(const fe::Coefficient& coefficient, std::set<int>& parameters) {
  for (const fe::ParameterFactor& factor : coefficient.factors) parameters.insert(factor.parameter);
  if (!coefficient.stay) return;
  for (const auto& factor : {coefficient.stay->modulus, coefficient.stay->density, coefficient.stay->area})
    if (factor) parameters.insert(factor->parameter);
}

bool same_ratio(const fe::Coefficient& a, const fe::Coefficient& b) {
  const auto same_factor = [](const fe::ParameterFactor& p, const fe::ParameterFactor& q) {
    return p.parameter == q.parameter && p.power == q.power && p.reference == q.reference;
  };
  if (!std::equal(a.factors.begin(), a.factors.end(), b.factors.begin(), b.factors.end(), same_factor)) return false;
  const auto moves = [](const fe::Coefficient& c) { return c.stay && (c.stay->modulus || c.stay->density || c.stay->area); };
  if (!moves(a) && !moves(b)) return true;  // sag matters only if parameters change it
  if (!moves(a) || !moves(b)) return false;
  const auto same = [&](const std::optional<fe::ParameterFactor>& p, const std::optional<fe::ParameterFactor>& q) {
    return p.has_value() == q.has_value() && (!p || same_factor(*p, *q));
  };
  const fe::StayModulus &s = *a.stay, &t = *b.stay;
  return s.youngs_modulus_Pa == t.youngs_modulus_Pa && s.law.weight_density_N_m3 == t.law.weight_density_N_m3 &&
         s.law.horizontal_length_m == t.law.horizontal_length_m && s.law.stress_Pa == t.law.stress_Pa &&
         same(s.modulus, t.modulus) && same(s.density, t.density) && same(s.area, t.area);
}

std::size_t position_of(const fe::Coefficient& ratio, std::vector<fe::Coefficient>& ratios) {
  const auto known = std::ranges::find_if(ratios, [&](const auto& other) { return same_ratio(ratio, other); });
  const auto at = static_cast<std::size_t>(known - ratios.begin());
  if (at == ratios.size()) ratios.push_back(ratio);
  return at;
}

}  // namespace twindeck::diagnosis
