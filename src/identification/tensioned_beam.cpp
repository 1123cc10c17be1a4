#include "identification/tensioned_beam.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::identification {

using std::numbers::pi;

namespace {

double ratio_at(double a, double xi) { return a * std::sqrt(1.0 + a * a / (xi * xi)) / pi; }

/// Wave number of the beam without sag: a = n pi + 2 phi(a), a contraction that gains a digit a turn at xi = 6.
double wave_number(int number, const TensionedBeam& beam) {
  const double hinged = number * pi;
  if (beam.fixity <= 0.0) return hinged;
  double a = hinged;
  for (int turn = 0; turn < 60; ++turn) {
    const double b = std::sqrt(a * a + beam.xi * beam.xi), half = std::tanh(0.5 * b);
    const double spring = (a * a + b * b) * (1.0 - beam.fixity) / (beam.fixity * beam.xi);
    const double next = hinged + 2.0 * std::atan(a / ((number % 2 == 0 ? b / half : b * half) + spring));
    const bool settled = std::abs(next - a) < 1e-14 * a;
    a = next;
    if (settled) break;
  }
  return a;
}

/// What vanishes at the wave numbers of the odd modes with sag: (A + C)(w² - lambda²) + 2 lambda² (A tan(a/2)/a + C
/// tanh(b/2)/b), w = pi f/c, times cos(a/2), so that it has no poles.
double odd_mode(double a, const TensionedBeam& beam) {
  const double b = std::sqrt(a * a + beam.xi * beam.xi), cosine = std::cos(0.5 * a), sine = std::sin(0.5 * a),
               half = std::tanh(0.5 * b);
  const double free = 1.0 - beam.fixity, spring = beam.fixity * beam.xi, w = a * b / beam.xi;
  const double first = free * b * b + spring * b * half, second = free * a * a * cosine + spring * a * sine;
  return (first * cosine + second) * (w * w - beam.lambda_squared) +
         2.0 * beam.lambda_squared * (first * sine / a + second * half / b);
}

/// Its root between two points of opposite sign: regula falsi, an end that stays counts half (Illinois).
double odd_root(double low, double high, const TensionedBeam& beam) {
  double at_low = odd_mode(low, beam), at_high = odd_mode(high, beam), root = low;
  if ((at_low > 0.0) == (at_high > 0.0)) return low;  // a sag so small that the root has not moved as far
  for (int turn = 0; turn < 100 && high - low > 1e-12 * high; ++turn) {
    const double before = root;
    root = (low * at_high - high * at_low) / (at_high - at_low);
    const double at_root = odd_mode(root, beam);
    if (at_root == 0.0 || std::abs(root - before) < 1e-13 * root) break;
    if ((at_root > 0.0) == (at_low > 0.0)) {
      low = root;
      at_low = at_root;
      at_high *= 0.5;
    } else {
      high = root;
      at_high = at_root;
      at_low *= 0.5;
    }
  }
  return root;
}

}  // namespace

double frequency_ratio(int number, const TensionedBeam& beam) {
  TWINDECK_ASSERT(number >= 1 && beam.xi > 0.0 && beam.lambda_squared >= 0.0 && beam.fixity >= 0.0 && beam.fixity <= 1.0);
  double a = wave_number(number, beam);
  if (number % 2 == 0 || beam.lambda_squared == 0.0) return ratio_at(a, beam.xi);
  // The root moves up from the beam without sag as lambda² grows, and stays below the next pole of the tangent.
  return ratio_at(odd_root(a * (1.0 + 1e-12), (number + 2) * pi, beam), beam.xi);
}

}  // namespace twindeck::identification
