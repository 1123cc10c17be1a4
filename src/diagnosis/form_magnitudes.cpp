#include "diagnosis/form_magnitudes.hpp"

#include <algorithm>
#include <cmath>

namespace twindeck::diagnosis {

bool is_a_size(const Candidate& candidate) {
  return candidate.low.size() > 0 && candidate.tuned < 0 && !candidate.hypothesis->does(Primitive::support_move);
}

std::vector<double> magnitude_factors(const Candidate& candidate) {
  if (candidate.low.size() != 1 || !is_a_size(candidate)) return {1.0};
  return {0.15, 0.3, 0.55, 1.0, 1.5};
}

double scaled_magnitude(const Candidate& candidate, double a, double t) {
  const bool factor = candidate.hypothesis->unknowns[0].name == "factor" || !candidate.log[0];
  return std::clamp(factor ? t * a : a + std::log(t), candidate.low[0], candidate.high[0]);
}

}  // namespace twindeck::diagnosis
