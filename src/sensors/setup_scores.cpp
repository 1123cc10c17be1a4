#include "sensors/setup_scores.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"

namespace twindeck::sensors {

using Eigen::Index;
using Eigen::MatrixXd;
namespace {

MatrixXd rows_of(const MatrixXd& phi, const std::vector<Index>& rows) { return phi(rows, Eigen::all); }

/// Random whole numbers below n, one after the other.
struct Draw {
  std::uint64_t seed, stream, at = 0;
  Index below(Index n) { return static_cast<Index>(uniform_number(seed, stream, at++) * static_cast<double>(n)); }
};

/// Points by how far along their deck they stand: "foot_inner" and "foot_outer" at one s are one place of deck "foot".
struct Places {
  std::map<std::string, std::vector<double>> s_m;                                   // of a deck, ascending
  std::map<std::pair<std::string, double>, std::map<std::string, std::size_t>> at;  // (deck, s) -> line -> point
};

std::string deck_of(const std::string& line) { return line.substr(0, line.find('_')); }

Places places_of(const std::vector<LayoutPoint>& points) {
  Places places;
  for (std::size_t i = 0; i < points.size(); ++i) places.at[{deck_of(points[i].line), points[i].s_m}][points[i].line] = i;
  for (const auto& [place, lines] : places.at) places.s_m[place.first].push_back(place.second);
  return places;
}

using DeckPlace = std::pair<std::string, double>;           // deck and s
using Wanted = std::vector<std::pair<std::string, Index>>;  // (line, 0 vertical or 1 radial)

/// A setup of the same family: each place of each deck goes to another that has the lines that are wanted, no two to one. Where
/// places drawn before leave none to a later one, all are drawn anew.
std::vector<Index> moved(const ScoredSetup& setup, const std::vector<LayoutPoint>& points, const Places& places, Draw& draw) {
  std::map<DeckPlace, Wanted> by_place;
  for (const Index row : setup.rows) {
    const LayoutPoint& point = points[static_cast<std::size_t>(row / 2)];
    by_place[{deck_of(point.line), point.s_m}].emplace_back(point.line, row % 2);
  }
  std::vector<Index> rows;
  std::set<DeckPlace> taken;
  const auto fits = [&](const DeckPlace& target, const Wanted& channels) {
    const auto& lines = places.at.at(target);
    return !taken.contains(target) && std::ranges::all_of(channels, [&](const auto& c) { return lines.contains(c.first); });
  };
  for (auto at = by_place.begin(); at != by_place.end();) {
    const auto& deck = at->first.first;
    const Wanted& channels = at->second;
    const std::vector<double>& choices = places.s_m.at(deck);
    if (std::ranges::none_of(choices, [&](double s) { return fits({deck, s}, channels); })) {
      rows.clear();
      taken.clear();
      at = by_place.begin();
      continue;
    }
    DeckPlace target;
    do {
      target = {deck, choices[static_cast<std::size_t>(draw.below(std::ssize(choices)))]};
    } while (!fits(target, channels));
    taken.insert(target);
    for (const auto& [line, direction] : channels)
      rows.push_back(2 * static_cast<Index>(places.at.at(target).at(line)) + direction);
    ++at;
  }
  return rows;
}

std::vector<Index> free_draw(Index n_candidates, long count, Draw& draw) {
  std::set<Index> rows;
  while (std::ssize(rows) < count) rows.insert(draw.below(n_candidates));
  return {rows.begin(), rows.end()};
}

void summarise(ScoredSetup& setup, std::vector<double> drawn) {
  if (drawn.empty()) return;
  std::sort(drawn.begin(), drawn.end());
  setup.draws = std::ssize(drawn);
  setup.best_drawn = drawn.front();
  setup.median_drawn = drawn[drawn.size() / 2];
  const auto better = std::lower_bound(drawn.begin(), drawn.end(), setup.score) - drawn.begin();
  setup.better_drawn_pct = 100.0 * static_cast<double>(better) / static_cast<double>(drawn.size());
}

ScoredSetup named(const std::string& name, const std::string& family, std::vector<Index> rows,
                  const std::vector<LayoutChannel>& candidates) {
  ScoredSetup setup{name, family, std::move(rows), {}};
  for (const Index row : setup.rows) setup.channels.push_back(candidates[static_cast<std::size_t>(row)].channel);
  return setup;
}

ScoredSetup from_file(const std::string& name, const std::vector<LayoutChannel>& setups,
                      const std::vector<LayoutChannel>& candidates) {
  ScoredSetup setup;
  setup.name = name;
  for (const LayoutChannel& channel : sensors::channels_of(setups, name)) {
    setup.family = channel.family;
    setup.channels.push_back(channel.channel);
    const auto at = std::ranges::find_if(
        candidates, [&](const LayoutChannel& c) { return c.point == channel.point && c.direction == channel.direction; });
    TWINDECK_ASSERT(at != candidates.end());
    setup.rows.push_back(at - candidates.begin());
  }
  return setup;
}

/// Setups that are searched for, in this order.
const std::vector<std::string> kSearches = {"effective_independence", "greatest_determinant", "least_R_k"};

std::string free_name(long i) { return "DC" + std::to_string(i + 1); }

/// A choice must gain more than rounding: mirror images on a symmetric structure are worth the same, and two layouts of the
/// same worth could change places for ever. Of equals the first stays.
constexpr double kGain = 1e-12;
/// The same for leverages, which are between 0 and 1.
constexpr double kSameLeverage = 1e-9;

/// The best exchange of one sensor; false if none helps.
bool exchange_one(const MatrixXd& phi, const Worth& worth, Layout& layout) {
  double best = layout.worth;
  std::size_t out = 0;
  Index in = -1;
  for (std::size_t i = 0; i < layout.rows.size(); ++i) {
    std::vector<Index> rows = layout.rows;
    for (Index candidate = 0; candidate < phi.rows(); ++candidate) {
      if (contains(layout.rows, candidate)) continue;
      rows[i] = candidate;
      const double found = worth(rows_of(phi, rows));
      if (found > best + kGain) {
        best = found;
        out = i;
        in = candidate;
      }
    }
  }
  if (in < 0) return false;
  layout.rows[out] = in;
  layout.worth = best;
  ++layout.exchanges;
  return true;
}

double score_of(const MatrixXd& phi, const std::vector<Index>& rows) { return sensors::decoupling_score(rows_of(phi, rows)); }

/// Appends those of the file, each among candidates of its family.
void append_given(const LayoutSettings& config, const std::vector<LayoutPoint>& points,
                  const std::vector<LayoutChannel>& candidates, const std::vector<LayoutChannel>& setups, const MatrixXd& phi,
                  std::uint64_t seed, std::uint64_t& stream, std::vector<ScoredSetup>& out) {
  const Places places = places_of(points);
  for (const std::string& name : setup_names(setups)) {
    out.push_back(from_file(name, setups, candidates));
    out.back().score = score_of(phi, out.back().rows);
    Draw draw{seed, ++stream};
    std::vector<double> drawn;
    for (long i = 0; i < config.draws; ++i) drawn.push_back(score_of(phi, moved(out.back(), points, places, draw)));
    summarise(out.back(), drawn);
  }
}

/// Appends those of the freely drawn setups that decouple most.
void append_drawn(const LayoutSettings& config, const std::vector<LayoutChannel>& candidates, const MatrixXd& phi,
                  std::uint64_t seed, std::uint64_t& stream, std::vector<ScoredSetup>& out) {
  Draw draw{seed, ++stream};
  std::vector<std::pair<double, std::vector<Index>>> free;
  std::vector<double> drawn;
  for (long i = 0; i < config.draws; ++i) {
    std::vector<Index> rows = free_draw(phi.rows(), config.channels, draw);
    drawn.push_back(score_of(phi, rows));
    free.emplace_back(drawn.back(), std::move(rows));
  }
  std::sort(free.begin(), free.end());
  for (long i = 0; i < std::min<long>(config.free_setups, std::ssize(free)); ++i) {
    ScoredSetup setup = named(free_name(i), "dec", free[static_cast<std::size_t>(i)].second, candidates);
    setup.score = free[static_cast<std::size_t>(i)].first;
    summarise(setup, drawn);
    out.push_back(setup);
  }
}

/// Appends setups that are searched for, which may start from those before them. @param scaled  modes of unit norm
void append_searched(const LayoutSettings& config, const std::vector<LayoutChannel>& candidates, const MatrixXd& scaled,
                     std::vector<ScoredSetup>& out) {
  const Index count = config.channels;
  const auto determinant = [](const MatrixXd& part) { return sensors::log_determinant(part); };
  const auto decoupling = [](const MatrixXd& part) { return -sensors::decoupling_score(part); };
  const std::vector<Index> independent = sensors::effective_independence(scaled, count).rows;
  out.push_back(named(kSearches[0], "search", independent, candidates));
  // The determinant is zero for fewer sensors than modes, so that a greedy start from nothing is blind; it starts where
  // Kammer's ends.
  out.push_back(
      named(kSearches[1], "search", sensors::greedy_exchange(scaled, count, determinant, independent).rows, candidates));
  // Exchange ends at a layout that no single exchange betters, of which there are many: it starts from nothing, from Kammer's,
  // and from every setup above that has as many channels.
  Layout least = sensors::greedy_exchange(scaled, count, decoupling);
  std::vector<std::vector<Index>> starts = {independent};
  for (const ScoredSetup& setup : out)
    if (std::ssize(setup.rows) == count) starts.push_back(setup.rows);
  for (const std::vector<Index>& start : starts) {
    Layout found = sensors::greedy_exchange(scaled, count, decoupling, start);
    if (found.worth > least.worth) least = std::move(found);
  }
  out.push_back(named(kSearches[2], "search", least.rows, candidates));
}

}  // namespace

void refuse_unknown_blind_setups(const LayoutSettings& config, const std::vector<LayoutChannel>& setups) {
  std::vector<std::string> known = sensors::setup_names(setups);
  for (long i = 0; i < std::min(config.free_setups, config.draws); ++i) known.push_back(free_name(i));
  known.insert(known.end(), kSearches.begin(), kSearches.end());
  for (const std::string& name : config.blind_setups) {
    if (!contains(known, name))
      throw InputError({"", 0, "blind.setups"}, "'" + name + "' is no setup" + did_you_mean(name, known),
                       "name setups of the layout, DC1 … or a search");
  }
}

std::vector<LayoutChannel> candidate_channels(const std::vector<LayoutPoint>& points) {
  std::vector<LayoutChannel> candidates;
  for (const LayoutPoint& point : points) {
    candidates.push_back(sensors::channel_at(point, "vertical", point.name + "z"));
    candidates.push_back(sensors::channel_at(point, "radial", point.name + "r"));
  }
  return candidates;
}

std::vector<ScoredSetup> score_setups(const LayoutSettings& config, const std::vector<LayoutPoint>& points,
                                      const std::vector<LayoutChannel>& candidates, const std::vector<LayoutChannel>& setups,
                                      const MatrixXd& phi, std::uint64_t seed) {
  const MatrixXd scaled = phi.colwise().normalized();
  std::vector<ScoredSetup> out;
  std::uint64_t stream = 0;
  append_given(config, points, candidates, setups, phi, seed, stream, out);
  append_drawn(config, candidates, phi, seed, stream, out);
  append_searched(config, candidates, scaled, out);
  for (ScoredSetup& setup : out) {
    setup.score = score_of(phi, setup.rows);
    setup.log_determinant = sensors::log_determinant(rows_of(scaled, setup.rows));
  }
  return out;
}

Layout effective_independence(const Eigen::Ref<const MatrixXd>& phi, Index count) {
  if (count < phi.cols() || count > phi.rows()) {
    throw InputError({"", 0, "channels"},
                     "is " + std::to_string(count) + ", expected from " + std::to_string(phi.cols()) + " (one a mode) to " +
                         std::to_string(phi.rows()) + " (candidates)",
                     "ask for another number of sensors");
  }
  Layout layout;
  for (Index i = 0; i < phi.rows(); ++i) layout.rows.push_back(i);
  while (true) {
    const MatrixXd kept = phi(layout.rows, Eigen::all);
    // Leverages are the squared rows of Q; the normal equations would square the condition.
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(kept);
    if (qr.rank() < kept.cols()) {
      throw InputError({"", 0, "candidates"}, "can't tell the modes apart: their shapes at the candidates depend on each other",
                       "add points or directions");
    }
    layout.worth = 2.0 * qr.matrixR().diagonal().head(kept.cols()).cwiseAbs().array().log().sum();
    if (std::ssize(layout.rows) == count) return layout;
    const MatrixXd q = qr.householderQ() * MatrixXd::Identity(kept.rows(), kept.cols());
    const Eigen::VectorXd leverage = q.rowwise().squaredNorm();
    const double smallest = leverage.minCoeff();
    Index least = 0;
    while (leverage[least] > smallest + kSameLeverage) ++least;
    layout.rows.erase(layout.rows.begin() + least);
  }
}

Layout greedy_exchange(const Eigen::Ref<const MatrixXd>& phi, Index count, const Worth& worth,
                       const std::vector<Index>& start) {
  TWINDECK_ASSERT(count > 0 && count <= phi.rows() && std::ssize(start) <= count);
  const MatrixXd all = phi;
  Layout layout;
  layout.rows = start;
  while (std::ssize(layout.rows) < count) {
    double best = -std::numeric_limits<double>::infinity();
    Index next = -1;
    std::vector<Index> rows = layout.rows;
    rows.push_back(0);
    for (Index candidate = 0; candidate < all.rows(); ++candidate) {
      if (contains(layout.rows, candidate)) continue;
      rows.back() = candidate;
      const double found = worth(rows_of(all, rows));
      if (next < 0 || found > best + kGain) {
        best = found;
        next = candidate;
      }
    }
    layout.rows.push_back(next);
  }
  layout.worth = worth(rows_of(all, layout.rows));
  while (exchange_one(all, worth, layout)) {
  }
  std::sort(layout.rows.begin(), layout.rows.end());
  return layout;
}

MatrixXd auto_mac(const Eigen::Ref<const MatrixXd>& phi) {
  const MatrixXd product = phi.transpose() * phi;
  MatrixXd mac(product.rows(), product.cols());
  for (Index i = 0; i < mac.rows(); ++i) {
    for (Index j = 0; j < mac.cols(); ++j) {
      const double norms = product(i, i) * product(j, j);
      mac(i, j) = norms > 0.0 && i != j ? product(i, j) * product(i, j) / norms : 1.0;
    }
  }
  return mac;
}

double decoupling_score(const Eigen::Ref<const MatrixXd>& phi) {
  const Index n = phi.cols();
  TWINDECK_ASSERT(n >= 2);
  return (auto_mac(phi).sum() - static_cast<double>(n)) / static_cast<double>(n * (n - 1));
}

double log_determinant(const Eigen::Ref<const MatrixXd>& phi) {
  // A pivot of R below this share of the largest is rounding: it stands at 1e-15, and shapes are known to 1e-9 at best.
  constexpr double least_pivot = 1e-12;
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  if (phi.rows() < phi.cols()) return nothing;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(phi);
  qr.setThreshold(least_pivot);
  if (qr.rank() < phi.cols()) return nothing;
  return 2.0 * qr.matrixQR().diagonal().cwiseAbs().array().log().sum();
}

}  // namespace twindeck::sensors
