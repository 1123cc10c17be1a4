#include "identification/stay_posterior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>

#include "core/distributions.hpp"
#include "core/error.hpp"

namespace twindeck::identification {

using std::numbers::pi;

namespace {

double ratio_at(double a, double xi) { return a * std::sqrt(1.0 + a * a / (xi * xi)) / pi; }

/// Wave number of the beam without sag: a = n pi + 2 phi(a), a contraction that gains one digit per iteration at xi = 6.
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

/// Function whose zeros are the wave numbers of the odd modes with sag: (A + C)(w² - lambda²) + 2 lambda² (A tan(a/2)/a + C
/// tanh(b/2)/b), w = pi f/c, times cos(a/2), so that it has no poles.
double odd_mode(double a, const TensionedBeam& beam) {
  const double b = std::sqrt(a * a + beam.xi * beam.xi), cosine = std::cos(0.5 * a), sine = std::sin(0.5 * a),
               half = std::tanh(0.5 * b);
  const double free = 1.0 - beam.fixity, spring = beam.fixity * beam.xi, w = a * b / beam.xi;
  const double first = free * b * b + spring * b * half, second = free * a * a * cosine + spring * a * sine;
  return (first * cosine + second) * (w * w - beam.lambda_squared) +
         2.0 * beam.lambda_squared * (first * sine / a + second * half / b);
}

/// Root of odd_mode between two points of opposite sign, by regula falsi with the Illinois rule.
double odd_root(double low, double high, const TensionedBeam& beam) {
  double at_low = odd_mode(low, beam), at_high = odd_mode(high, beam), root = low;
  if ((at_low > 0.0) == (at_high > 0.0)) return low;  // the sag is so small that rounding hides the shift of the root
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

/// Bounds of the priors: from a short hanger that is nearly a beam to a string. Irvine's crossover lies at 4 pi² = 39.
constexpr double kLeastXi = 4.0, kMostXi = 4000.0, kMostLambdaSquared = 60.0;
/// [-] relative scatter of a harmonic beyond its stated deviation, because mass and section vary along a cable.
constexpr double kCableScatter = 1e-4;
/// Degrees of freedom of the common factor of all deviations. A cable with sleeves or dampers is no ideal beam: its harmonics
/// differ from the formula by ten deviations and more, so the factor is hardly known beforehand.
constexpr double kFactorFreedom = 1.0;
constexpr double kSectionDeviation = 0.05;  ///< [-] of xi, from ten per cent of EI

struct Ends {
  double fixity, prior;
};
constexpr Ends kEnds[] = {{0.0, 0.45}, {1.0, 0.45}, {0.25, 0.1 / 3.0}, {0.5, 0.1 / 3.0}, {0.75, 0.1 / 3.0}};

void check_harmonics(const std::vector<Harmonic>& harmonics) {
  std::set<int> numbers;
  for (const Harmonic& h : harmonics) {
    if (h.number < 1 || !(h.frequency_Hz > 0.0) || !(h.deviation_Hz > 0.0))
      throw InputError({"", 0, "stay"},
                       fmt::format("harmonic {} has {} Hz with a standard deviation of {}, expected positive numbers", h.number,
                                   h.frequency_Hz, h.deviation_Hz),
                       "give each harmonic a number from 1, a frequency and its standard deviation");
    if (!numbers.insert(h.number).second)
      throw InputError({"", 0, "stay"}, fmt::format("has harmonic {} twice", h.number), "keep one of them");
  }
  if (harmonics.empty()) throw InputError({"", 0, "stay"}, "has no harmonic", "identify modes of the stay");
}

/// A normal law cut off outside an interval: logarithm of the remaining probability, its mean and deviation.
struct CutNormal {
  double log_share = 0.0, mean = 0.0, deviation = 0.0;
  CutNormal(double centre, double sigma, double low, double high) {
    const double a = (low - centre) / sigma, b = (high - centre) / sigma;
    // Far outside the interval, the law is nearly exponential from the nearer bound.
    constexpr double kFar = 6.0;
    if (a > kFar || b < -kFar) {
      const double near = a > kFar ? a : -b;
      log_share = -0.5 * near * near - std::log(near * std::sqrt(2.0 * pi));
      mean = std::clamp(a > kFar ? low + sigma / near : high - sigma / near, low, high);
      deviation = sigma / near;
      return;
    }
    const auto density = [](double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * pi); };
    const double share = normal_probability(b) - normal_probability(a), shift = (density(a) - density(b)) / share;
    log_share = std::log(share);
    mean = std::clamp(centre + sigma * shift, low, high);
    deviation = sigma * std::sqrt(std::max(0.0, 1.0 + (a * density(a) - b * density(b)) / share - shift * shift));
  }
};

/// Likelihood of the harmonics as a function of xi and the ends; c and the sag integrated out.
class Likelihood {
 public:
  Likelihood(const std::vector<Harmonic>& harmonics, const StaySection& section) : harmonics_(harmonics), section_(section) {
    free_ = static_cast<double>(harmonics.size()) - 1.0;
    double logs = 0.0;
    for (const Harmonic& h : harmonics) {
      const double sigma = std::hypot(h.deviation_Hz / h.frequency_Hz, kCableScatter);
      weights_.push_back(1.0 / (sigma * sigma));
      logs += std::log(sigma);
      sum_ += weights_.back();
    }
    constant_ = std::lgamma(0.5 * (kFactorFreedom + free_)) - std::lgamma(0.5 * kFactorFreedom) -
                0.5 * free_ * std::log(kFactorFreedom * pi) - logs - 0.5 * std::log(sum_);
  }

  /// Sag by Gauss-Newton, its likelihood taken as normal about the best value and cut off at the bounds of its prior.
  /// @param sag  to begin with
  [[nodiscard]] StayPart at(double xi, double fixity, double sag) const {
    constexpr double kSettled = 2e-3;  // of ln(1 + lambda²); the last step removes the rest, with an error of second order
    Line line;
    for (int turn = 0; turn < 20; ++turn) {
      line = line_at({xi, std::expm1(sag), fixity}, sag);
      const double next = std::clamp(sag + std::clamp(line.step, -1.0, 1.0), 0.0, kMostSag);
      if (std::abs(next - sag) < kSettled) break;
      sag = next;
    }
    const double scale = (kFactorFreedom + line.chi2) / (kFactorFreedom + free_);
    // If the harmonics do not depend on the sag, the prior decides.
    const double curvature = std::max(line.curvature / scale, 1e-4);
    const double centre = sag + line.step, sigma = 1.0 / std::sqrt(curvature);
    const CutNormal cut(centre, sigma, 0.0, kMostSag);
    StayPart part;
    part.sag = cut.mean;
    part.sag_deviation = cut.deviation;
    part.beam = {xi, std::expm1(cut.mean), fixity};
    part.log_c = line.mean - line.slope * (cut.mean - sag);
    part.log_c_deviation = std::sqrt(scale / sum_ + std::pow(line.slope * cut.deviation, 2));
    part.log_weight = constant_ - 0.5 * (kFactorFreedom + free_) * std::log1p(line.chi2 / kFactorFreedom) +
                      0.5 * curvature * line.step * line.step + cut.log_share + 0.5 * std::log(2.0 * pi / curvature) -
                      std::log(kMostSag) + of_section(part);
    return part;
  }

 private:
  static inline const double kMostSag = std::log1p(kMostLambdaSquared);

  /// ln f_n - ln r_n at one sag: weighted mean, misfit, and the Gauss-Newton step of the sag.
  struct Line {
    double mean = 0.0, chi2 = 0.0, slope = 0.0, step = 0.0, curvature = 0.0;
  };
  [[nodiscard]] Line line_at(const TensionedBeam& beam, double sag) const {
    constexpr double kChange = 1e-3;
    TensionedBeam other = beam;
    other.lambda_squared = std::expm1(sag + kChange);
    Line line;
    std::vector<double> logs, slopes;
    for (std::size_t i = 0; i < harmonics_.size(); ++i) {
      const double ratio = frequency_ratio(harmonics_[i].number, beam);
      const bool feels = harmonics_[i].number % 2 == 1;
      logs.push_back(std::log(harmonics_[i].frequency_Hz / ratio));
      slopes.push_back(feels ? std::log(frequency_ratio(harmonics_[i].number, other) / ratio) / kChange : 0.0);
      line.mean += weights_[i] * logs[i] / sum_;
      line.slope += weights_[i] * slopes[i] / sum_;
    }
    double product = 0.0;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      const double y = logs[i] - line.mean, d = slopes[i] - line.slope;
      line.chi2 += weights_[i] * y * y;
      line.curvature += weights_[i] * d * d;
      product += weights_[i] * d * y;
    }
    line.step = line.curvature > 0.0 ? product / line.curvature : 0.0;
    return line;
  }
  /// Logarithm of the density of ln xi in units of its uniform prior, where the section is known.
  [[nodiscard]] double of_section(const StayPart& part) const {
    if (section_.length_m <= 0.0 || section_.bending_per_mass_m4_s2 <= 0.0) return 0.0;
    const double expected =
        2.0 * section_.length_m * section_.length_m * std::exp(part.log_c) / std::sqrt(section_.bending_per_mass_m4_s2);
    const double off = std::log(part.beam.xi / expected) / kSectionDeviation;
    return std::log(std::log(kMostXi / kLeastXi) / (kSectionDeviation * std::sqrt(2.0 * pi))) - 0.5 * off * off;
  }

  const std::vector<Harmonic>& harmonics_;
  const StaySection& section_;
  std::vector<double> weights_;
  double free_ = 0.0, sum_ = 0.0, constant_ = 0.0;
};

/// A piece of the unit interval of ln xi.
struct Piece {
  double x, half;
  StayPart part;
  [[nodiscard]] double log_mass() const { return part.log_weight + std::log(2.0 * half); }
};

/// Cuts the interval into pieces that are small where the likelihood varies.
std::vector<Piece> cut_finely(const Likelihood& likelihood, double fixity, Effort effort) {
  constexpr int kFirst = 24, kLevels = 14;
  const bool quick = effort == Effort::quick;
  const double likely = quick ? 5.0 : 8.0;  // [nats] below the largest weight; smaller pieces are not cut further
  const double flat = quick ? 1.0 : 0.3;    // [nats] between neighbours; the sum is then accurate to ten or to one per cent
  const auto piece_at = [&](double x, double half, double sag) {
    return Piece{x, half, likelihood.at(kLeastXi * std::pow(kMostXi / kLeastXi, x), fixity, sag)};
  };
  std::vector<Piece> pieces;
  double sag = std::log1p(3.0);  // first value: a stay with little sag
  for (int i = 0; i < kFirst; ++i) {
    pieces.push_back(piece_at((i + 0.5) / kFirst, 0.5 / kFirst, sag));
    sag = pieces.back().part.sag;
  }
  for (int level = 0; level < kLevels; ++level) {
    double largest = -1e300;
    for (const Piece& piece : pieces) largest = std::max(largest, piece.part.log_weight);
    std::vector<Piece> finer;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto differs = [&](std::size_t k) {
        return k < pieces.size() && std::abs(pieces[k].part.log_weight - pieces[i].part.log_weight) > flat;
      };
      if (pieces[i].part.log_weight < largest - likely || (!differs(i - 1) && !differs(i + 1))) {
        finer.push_back(pieces[i]);
        continue;
      }
      const double h = 0.5 * pieces[i].half;
      finer.push_back(piece_at(pieces[i].x - h, h, pieces[i].part.sag));
      finer.push_back(piece_at(pieces[i].x + h, h, pieces[i].part.sag));
    }
    if (finer.size() == pieces.size()) break;
    pieces = std::move(finer);
  }
  return pieces;
}

}  // namespace

double frequency_ratio(int number, const TensionedBeam& beam) {
  TWINDECK_ASSERT(number >= 1 && beam.xi > 0.0 && beam.lambda_squared >= 0.0 && beam.fixity >= 0.0 && beam.fixity <= 1.0);
  double a = wave_number(number, beam);
  if (number % 2 == 0 || beam.lambda_squared == 0.0) return ratio_at(a, beam.xi);
  // The root moves up from the beam without sag as lambda² grows, and stays below the next pole of the tangent.
  return ratio_at(odd_root(a * (1.0 + 1e-12), (number + 2) * pi, beam), beam.xi);
}

StayPosterior stay_posterior(const std::vector<Harmonic>& harmonics, const StaySection& section, Effort effort) {
  check_harmonics(harmonics);
  const Likelihood likelihood(harmonics, section);
  StayPosterior posterior;
  double most = -1e300, sum = 0.0;
  std::vector<Ends> kinds(std::begin(kEnds), std::end(kEnds));
  if (effort == Effort::quick) std::erase_if(kinds, [](const Ends& ends) { return ends.fixity > 0.0 && ends.fixity < 1.0; });
  if (section.fixity) kinds = {{*section.fixity, 1.0}};
  for (const Ends& ends : kinds) {
    for (Piece& piece : cut_finely(likelihood, ends.fixity, effort)) {
      piece.part.log_weight = piece.log_mass() + std::log(ends.prior);
      most = std::max(most, piece.part.log_weight);
      posterior.parts.push_back(piece.part);
    }
  }
  for (const StayPart& part : posterior.parts) sum += std::exp(part.log_weight - most);
  posterior.log_evidence = most + std::log(sum);
  return posterior;
}

}  // namespace twindeck::identification
