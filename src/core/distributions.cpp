#include "core/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/error.hpp"

namespace twindeck {

namespace law = boost::math;

double normal_probability(double u) { return law::cdf(law::normal(), u); }

double normal_tail(double u) { return law::cdf(law::complement(law::normal(), u)); }

double normal_quantile(double probability) {
  TWINDECK_ASSERT(probability > 0.0 && probability < 1.0);
  return law::quantile(law::normal(), probability);
}

double two_sided_normal_quantile(double level) {
  TWINDECK_ASSERT(level > 0.0 && level < 1.0);
  return law::quantile(law::complement(law::normal(), 0.5 * (1.0 - level)));
}

double student_two_sided_tail(double t, double degrees) {
  TWINDECK_ASSERT(degrees > 0.0);
  return 2.0 * law::cdf(law::complement(law::students_t(degrees), std::abs(t)));
}

double student_quantile(double degrees, double probability) {
  TWINDECK_ASSERT(degrees > 0.0 && probability > 0.0 && probability < 1.0);
  return law::quantile(law::students_t(degrees), probability);
}

double chi_squared_tail(double x, double degrees) {
  TWINDECK_ASSERT(degrees > 0.0);
  return x <= 0.0 ? 1.0 : law::cdf(law::complement(law::chi_squared(degrees), x));
}

}  // namespace twindeck
