#include "blind/modes/random_records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/random.hpp"

namespace twindeck::blind::modes {

namespace {

using Eigen::Index;
using std::numbers::pi;

constexpr double kRate_Hz = 20.0;
constexpr double kHighest_Hz = 7.6;  ///< of a mode: below 0.8 of the Nyquist frequency, which step 3 looks at
constexpr Index kWaves = 24;         ///< sine waves over the structure that shapes are made of
constexpr int kForces = 8;

/// Numbers of one seed in order. Streams do not share numbers.
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(2 * stream) {}
  double between(double low, double high) { return low + (high - low) * uniform_number(seed_, stream_, at_++); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int whole(int low, int high) { return std::min(high, static_cast<int>(between(low, high + 1.0))); }
  bool chance(double p) { return between(0.0, 1.0) < p; }
  double normal() { return normal_number(seed_, stream_ + 1, normals_++); }
  Eigen::Vector3d direction() {
    Eigen::Vector3d d;
    for (double& x : d) x = normal();
    return d.normalized();
  }

 private:
  std::uint64_t seed_, stream_, at_ = 0, normals_ = 0;
};

/// A mode over the structure, 0 <= x <= 1: sines of x times a direction.
struct Mode {
  double frequency_Hz = 0.0, damping_ratio = 0.0;
  Eigen::VectorXd waves = Eigen::VectorXd::Zero(kWaves);
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();

  [[nodiscard]] double at(double x, const Eigen::Vector3d& along) const {
    double sum = 0.0;
    for (Index k = 0; k < kWaves; ++k) sum += waves[k] * std::sin(static_cast<double>(k + 1) * pi * x);
    return sum * direction.dot(along);
  }
};

struct Point {
  double x = 0.0;
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ();
};

double closest_gap(const std::vector<double>& ascending) {
  double gap = 1e300;
  for (std::size_t i = 1; i < ascending.size(); ++i) gap = std::min(gap, ascending[i] / ascending[i - 1] - 1.0);
  return gap;
}

/// Frequencies on a jittered logarithmic grid, some of them with a neighbour 0.3 to 7 % above.
std::vector<double> draw_frequencies(Draw& draw, int count) {
  const int pairs = draw.whole(1, std::max(1, count / 5));
  const int base = count - pairs;
  for (;;) {
    const double low = draw.between(0.5, 1.2), high = draw.between(5.0, 7.0), step = std::log(high / low) / (base - 1);
    std::vector<double> f;
    for (int k = 0; k < base; ++k) f.push_back(low * std::exp(step * (k + draw.between(-0.3, 0.3))));
    for (int p = 0; p < pairs; ++p)
      f.push_back(f[static_cast<std::size_t>(draw.whole(0, base - 1))] * (1.0 + draw.log_between(0.003, 0.07)));
    std::sort(f.begin(), f.end());
    if (closest_gap(f) >= 0.003 && f.back() <= kHighest_Hz) return f;
  }
}

std::vector<Mode> draw_modes(Draw& draw) {
  const std::vector<double> f = draw_frequencies(draw, draw.whole(6, 20));
  const double level = draw.log_between(0.004, 0.025);
  std::vector<Mode> modes;
  for (std::size_t r = 0; r < f.size(); ++r) {
    Mode mode;
    mode.frequency_Hz = f[r];
    mode.damping_ratio = std::clamp(level * std::exp(draw.between(-0.5, 0.5)), 0.003, 0.04);
    for (Index k = 0; k < kWaves; ++k) {
      const double off = std::abs(static_cast<double>(k) - 0.8 * static_cast<double>(r)) / 1.5;
      mode.waves[k] = std::exp(-off) * draw.normal();
    }
    mode.waves.normalize();
    mode.direction = draw.direction();
    // One close neighbour in three has much of the same shape, as bending and torsion of a slender deck have.
    if (r > 0 && f[r] / f[r - 1] < 1.07 && draw.chance(1.0 / 3.0)) {
      const double angle = draw.between(0.3, 1.5);
      mode.waves = std::cos(angle) * modes.back().waves + std::sin(angle) * mode.waves;
      mode.direction = (std::cos(angle) * modes.back().direction + std::sin(angle) * mode.direction).normalized();
    }
    modes.push_back(mode);
  }
  return modes;
}

/// Forces that stay at their points, and loads that cross.
struct Excitation {
  std::string colour;
  double white = 0.2;      ///< share of white noise in a coloured force
  double corner_Hz = 1.0;  ///< of red noise; centre of the hump
  double gust_period_s = 60.0, gust = 0.3;
  double moving = 0.0;
  std::array<Point, kForces> points;
  std::array<double, kForces> level{};
};

Excitation draw_excitation(Draw& draw) {
  Excitation e;
  const std::array<const char*, 3> colours = {"white", "red", "hump"};
  e.colour = colours[static_cast<std::size_t>(draw.whole(0, 2))];
  e.white = draw.between(0.15, 0.4);
  e.corner_Hz = draw.log_between(0.7, 5.0);
  e.gust_period_s = draw.between(30.0, 120.0);
  e.gust = draw.between(0.0, 0.5);
  e.moving = draw.chance(0.5) ? draw.between(0.2, 1.0) : 0.0;
  for (std::size_t j = 0; j < kForces; ++j) {
    e.points[j] = {draw.between(0.03, 0.97), draw.direction()};
    e.level[j] = std::exp(0.4 * draw.normal());
  }
  return e;
}

/// Coloured noise of unit variance or so: red (first order) or with a wide hump (second order, a third of critical damping),
/// never a line that could be taken for a mode.
class Colour {
 public:
  explicit Colour(const Excitation& e) : colour_(e.colour), white_(e.white) {
    const double omega = 2.0 * pi * e.corner_Hz / kRate_Hz;
    if (colour_ == "red") {
      a1_ = std::exp(-omega);
      gain_ = std::sqrt(1.0 - a1_ * a1_);
    } else if (colour_ == "hump") {
      constexpr double damping = 0.35;
      const double decay = std::exp(-damping * omega);
      a1_ = 2.0 * decay * std::cos(omega * std::sqrt(1.0 - damping * damping));
      a2_ = -decay * decay;
      gain_ = std::sqrt((1.0 + a2_) * (std::pow(1.0 - a2_, 2) - a1_ * a1_) / (1.0 - a2_));
    }
  }
  double operator()(double w) {
    if (colour_ == "white") return w;
    const double next = a1_ * x1_ + a2_ * x2_ + gain_ * w;
    x2_ = x1_;
    x1_ = next;
    return (1.0 - white_) * next + white_ * w;
  }

 private:
  std::string colour_;
  double white_, a1_ = 0.0, a2_ = 0.0, gain_ = 1.0, x1_ = 0.0, x2_ = 0.0;
};

/// Loads that cross the structure one after the other, some beside each other.
class Traffic {
 public:
  Traffic(const Excitation& e, Draw& draw) : strength_(e.moving), draw_(&draw) { next_s_ = draw.between(0.0, 20.0); }
  /// Calls act(x, force) for each load that is on the structure at this time.
  template <typename Act>
  void at(double time_s, const Act& act) {
    if (strength_ == 0.0) return;
    if (time_s >= next_s_) {
      loads_.push_back({time_s, draw_->between(4.0, 20.0), strength_ * draw_->between(0.5, 2.0)});
      next_s_ = time_s - 12.0 * std::log(draw_->between(1e-9, 1.0));
    }
    std::erase_if(loads_, [&](const Load& load) { return time_s > load.start_s + load.crossing_s; });
    for (const Load& load : loads_) act((time_s - load.start_s) / load.crossing_s, load.force * draw_->normal());
  }

 private:
  struct Load {
    double start_s, crossing_s, force;
  };
  std::vector<Load> loads_;
  double strength_, next_s_ = 0.0;
  Draw* draw_;
};

/// Accelerations of the modal coordinates (n_samples × n_modes) under forces that are constant between samples: with the pole
/// l, z' = l z + Q and q = Im(z)/omega_d, each step is exact.
Eigen::MatrixXd modal_accelerations(const std::vector<Mode>& modes, const Excitation& e, Index n_samples, Draw& draw) {
  const auto n = static_cast<Index>(modes.size());
  Eigen::ArrayXcd pole(n), step(n), gain(n), z = Eigen::ArrayXcd::Zero(n);
  Eigen::ArrayXd omega_d(n);
  Eigen::MatrixXd forces_to_modes(n, kForces);
  constexpr int kTable = 256;
  Eigen::MatrixXd deck(n, kTable + 1);  // what a crossing load does to each mode
  double slowest = 1e300;
  for (Index r = 0; r < n; ++r) {
    const Mode& mode = modes[static_cast<std::size_t>(r)];
    const double omega = 2.0 * pi * mode.frequency_Hz;
    omega_d[r] = omega * std::sqrt(1.0 - mode.damping_ratio * mode.damping_ratio);
    pole[r] = {-mode.damping_ratio * omega, omega_d[r]};
    step[r] = std::exp(pole[r] / kRate_Hz);
    gain[r] = (step[r] - 1.0) / pole[r];
    for (int j = 0; j < kForces; ++j) {
      const auto at = static_cast<std::size_t>(j);
      forces_to_modes(r, j) = e.level[at] * mode.at(e.points[at].x, e.points[at].along);
    }
    for (int i = 0; i <= kTable; ++i) deck(r, i) = mode.at(static_cast<double>(i) / kTable, Eigen::Vector3d::UnitZ());
    slowest = std::min(slowest, -pole[r].real());
  }
  const auto before = static_cast<Index>(std::min(4.0 / slowest, 400.0) * kRate_Hz);  // until the start is forgotten
  std::vector<Colour> colours(kForces, Colour(e));
  Traffic traffic(e, draw);
  Eigen::MatrixXd accelerations(n_samples, n);
  Eigen::VectorXd force(kForces), modal(n);
  for (Index t = -before; t < n_samples; ++t) {
    const double time_s = static_cast<double>(t + before) / kRate_Hz;
    const double level = std::exp(e.gust * std::sin(2.0 * pi * time_s / e.gust_period_s));
    for (int j = 0; j < kForces; ++j) force[j] = level * colours[static_cast<std::size_t>(j)](draw.normal());
    modal.noalias() = forces_to_modes * force;
    traffic.at(time_s, [&](double x, double f) { modal += f * deck.col(static_cast<Index>(std::lround(x * kTable))); });
    if (t >= 0) accelerations.row(t) = ((pole * pole * z).imag() / omega_d + modal.array()).transpose();
    z = step * z + gain * modal.array();
  }
  return accelerations;
}

/// Adds the lines of a machine at one point, each scaled to its share of what the channels show without it.
void add_machine(RandomRecords& out, const std::vector<Mode>& modes, const std::vector<double>& share, const Point& machine,
                 const std::vector<Point>& points, Draw& draw) {
  for (TrueSetup& setup : out.setups) {
    const double ambient = std::sqrt(setup.record.squaredNorm() / static_cast<double>(setup.record.size()));
    const double start = draw.between(0.0, 2.0 * pi);
    // The speed's deviation: first order, 20 s, 0.03 %.
    const double memory = std::exp(-1.0 / (20.0 * kRate_Hz));
    double off = 0.0, angle = start;
    Eigen::VectorXd angles(setup.record.rows());
    for (double& a : angles) {
      if (out.machine_wanders) off = memory * off + std::sqrt(1.0 - memory * memory) * 3e-4 * draw.normal();
      angle += 2.0 * pi * out.machine_Hz.front() * (1.0 + off) / kRate_Hz;
      a = angle;
    }
    for (std::size_t h = 0; h < out.machine_Hz.size(); ++h) {
      const double omega = 2.0 * pi * out.machine_Hz[h];
      Eigen::VectorXcd motion = Eigen::VectorXcd::Zero(setup.record.cols());
      for (const Mode& mode : modes) {
        const double own = 2.0 * pi * mode.frequency_Hz;
        const std::complex<double> q = -omega * omega * mode.at(machine.x, machine.along) /
                                       std::complex<double>(own * own - omega * omega, 2.0 * mode.damping_ratio * own * omega);
        for (Index c = 0; c < motion.size(); ++c) {
          const Point& p = points[static_cast<std::size_t>(setup.channels[static_cast<std::size_t>(c)])];
          motion[c] += q * mode.at(p.x, p.along);
        }
      }
      motion *= share[h] * ambient * std::sqrt(2.0 * static_cast<double>(motion.size())) / motion.norm();
      const double multiple = static_cast<double>(h + 1);
      for (Index t = 0; t < setup.record.rows(); ++t) {
        const std::complex<double> turn = std::polar(1.0, multiple * angles[t]);
        setup.record.row(t) += (motion * turn).real().transpose();
      }
    }
  }
}

/// A speed whose lines in the band keep away from all modes; 0 if sixty draws find none.
double machine_speed(const std::vector<Mode>& modes, Draw& draw, std::size_t& lines) {
  const std::size_t wanted = static_cast<std::size_t>(draw.whole(1, 3));
  for (int attempt = 0; attempt < 60; ++attempt) {
    const double f = draw.log_between(0.8, 6.0);
    lines = std::min(wanted, static_cast<std::size_t>(kHighest_Hz / f));
    bool clear = true;
    for (std::size_t h = 1; h <= lines; ++h) {
      for (const Mode& mode : modes) {
        const double gap = std::abs(static_cast<double>(h) * f - mode.frequency_Hz);
        clear = clear && gap > 0.02 * mode.frequency_Hz && gap > 2.0 * mode.damping_ratio * mode.frequency_Hz;
      }
    }
    if (clear) return f;
  }
  lines = 0;
  return 0.0;
}

/// Who measures what: channels of each setup among all.
void draw_setups(RandomRecords& out, Draw& draw) {
  const int count = draw.chance(0.25) ? draw.whole(2, 3) : 1;
  if (count == 1) {
    out.n_channels = draw.whole(4, 24);
    out.minutes = draw.log_between(5.0, 60.0);
    out.setups.resize(1);
    for (Index c = 0; c < out.n_channels; ++c) out.setups.front().channels.push_back(c);
    return;
  }
  out.minutes = draw.log_between(5.0, 20.0);
  const int references = draw.whole(2, 4), roving = draw.whole(2, 6);
  for (int r = 0; r < references; ++r) out.references.push_back(r);
  for (int s = 0; s < count; ++s) {
    TrueSetup setup;
    setup.channels = out.references;
    for (int c = 0; c < roving; ++c) setup.channels.push_back(references + s * roving + c);
    out.setups.push_back(std::move(setup));
  }
  out.n_channels = references + count * roving;
}

}  // namespace

RandomRecords random_records(std::uint64_t seed) {
  RandomRecords out;
  out.seed = seed;
  out.rate_Hz = kRate_Hz;
  Draw draw(seed, 1);
  const std::vector<Mode> modes = draw_modes(draw);
  draw_setups(out, draw);
  const Excitation excitation = draw_excitation(draw);
  out.excitation = excitation.colour;
  out.moving = excitation.moving;
  out.noise_dB = draw.between(10.0, 40.0);
  std::vector<Point> points;
  for (Index c = 0; c < out.n_channels; ++c)
    points.push_back({draw.between(0.03, 0.97), Eigen::Vector3d::Unit(draw.whole(0, 2))});
  std::vector<double> ascending;
  for (const Mode& mode : modes) {
    TrueMode truth{mode.frequency_Hz, mode.damping_ratio, Eigen::VectorXd(out.n_channels)};
    for (Index c = 0; c < out.n_channels; ++c)
      truth.shape[c] = mode.at(points[static_cast<std::size_t>(c)].x, points[static_cast<std::size_t>(c)].along);
    out.modes.push_back(std::move(truth));
    ascending.push_back(mode.frequency_Hz);
  }
  out.closest_pct = 100.0 * closest_gap(ascending);
  std::size_t lines = 0;
  const double speed = draw.chance(0.5) ? machine_speed(modes, draw, lines) : 0.0;
  std::vector<double> share;
  for (std::size_t h = 1; h <= lines; ++h) {
    out.machine_Hz.push_back(static_cast<double>(h) * speed);
    share.push_back(draw.log_between(0.2, 1.5));
  }
  out.machine_wanders = draw.chance(0.5);
  const Point machine{draw.between(0.05, 0.95), draw.direction()};
  const auto samples = static_cast<Index>(60.0 * out.minutes * kRate_Hz);
  for (std::size_t s = 0; s < out.setups.size(); ++s) {
    Draw own(seed, 10 + s);
    TrueSetup& setup = out.setups[s];
    const Eigen::MatrixXd modal = modal_accelerations(modes, excitation, samples, own);
    Eigen::MatrixXd shapes(static_cast<Index>(modes.size()), static_cast<Index>(setup.channels.size()));
    for (Index c = 0; c < shapes.cols(); ++c) {
      for (Index r = 0; r < shapes.rows(); ++r)
        shapes(r, c) = out.modes[static_cast<std::size_t>(r)].shape[setup.channels[static_cast<std::size_t>(c)]];
    }
    setup.record.noalias() = modal * shapes;
  }
  if (lines > 0) add_machine(out, modes, share, machine, points, draw);
  for (std::size_t s = 0; s < out.setups.size(); ++s) {
    Draw own(seed, 20 + s);
    Eigen::MatrixXd& record = out.setups[s].record;
    const double noise =
        std::pow(10.0, -out.noise_dB / 20.0) * std::sqrt(record.squaredNorm() / static_cast<double>(record.size()));
    for (double& value : record.reshaped()) value += noise * own.normal();
  }
  return out;
}

}  // namespace twindeck::blind::modes
