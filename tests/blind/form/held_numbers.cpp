#include "blind/form/held_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/csv.hpp"

namespace twindeck::blind::form {

namespace {

/// Relative. Other processors' kernels move the numbers of the seeds that are held by less; a fault moves some by far more.
constexpr double kHeld = 1e-4;
/// Below it a number is rounding: odds, deviations and shares are of the order of one.
constexpr double kNothing = 1e-7;
constexpr std::size_t kHeldEntries = 12;  ///< of the ranking, the first ones
constexpr std::size_t kHeldBlocks = 4;    ///< of the residual test, the least likely
constexpr std::size_t kHeldLocations = 4;
constexpr std::size_t kPrinted = 8;  ///< differences that are shown

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : seed_(seed) {}
  /// What is no number is left out: it is missed or new where that changes.
  void add(const std::string& name, double value) {
    if (std::isfinite(value)) all_.push_back({seed_, name, value});
  }
  /// A vector by its length and its direction: the mean of its squares, and its product with 1, 2, 3 …
  void add(const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& v) {
    if (v.size() == 0) return;
    add(name + " squared", v.squaredNorm());
    add(name + " in order", v.dot(Eigen::VectorXd::LinSpaced(v.size(), 1.0, static_cast<double>(v.size()))));
  }
  std::vector<HeldNumber> all() && { return std::move(all_); }

 private:
  std::uint64_t seed_;
  std::vector<HeldNumber> all_;
};

void add_fit(Numbers& out, const std::string& of, const diagnosis::Fit& fit) {
  if (!fit.made()) return;
  out.add(of + " chi squared", fit.chi_squared);
  out.add(of + " log determinant", fit.log_determinant);
  out.add(of + " estimate", fit.map.x);
  out.add(of + " prediction", fit.all.g);
  out.add(of + " whitened", fit.whitened);
  for (const diagnosis::Cause& cause : fit.causes) out.add(of + " " + cause.candidate->id(), cause.a);
}

void add_effects(Numbers& out, const diagnosis::Diagnosis& result) {
  for (std::size_t e = 0; e < result.effects.size(); ++e) {
    const diagnosis::Effect& effect = result.effects[e];
    std::string name = fmt::format("cause {}", e + 1);
    for (const std::string& member : effect.cluster) name += " " + member;
    out.add(name + " log odds", effect.log_odds);
    out.add(name + " probability", effect.probability);
    out.add(name + " within_m", effect.within_m);
    for (const diagnosis::EffectParameter& p : effect.parameters) {
      out.add(name + " " + p.name, p.value);
      out.add(name + " " + p.name + " low", p.low);
      out.add(name + " " + p.name + " high", p.high);
    }
    for (const diagnosis::Rival& rival : effect.rivals) out.add(name + " rival " + rival.id, rival.probability);
  }
}

void add_ranking(Numbers& out, const std::vector<diagnosis::Scored>& ranking) {
  for (std::size_t i = 0; i < std::min(kHeldEntries, ranking.size()); ++i) {
    const diagnosis::Scored& scored = ranking[i];
    const std::string name = fmt::format("entry {} {}", i + 1, scored.candidate->id());
    out.add(name + " screen", scored.screen);
    if (scored.weighed()) out.add(name + " log odds", scored.log_odds);
    out.add(name + " remaining", scored.remaining);
    out.add(name + " magnitudes", scored.a);
    out.add(name + " covariance", scored.a_covariance.reshaped());
  }
}

void add_form(Numbers& out, const diagnosis::FormReport& form) {
  for (const auto& [name, scale] : {std::pair{"frequency", &form.frequency}, std::pair{"shape", &form.shape}}) {
    out.add(fmt::format("form {} level", name), scale->level);
    out.add(fmt::format("form {} low", name), scale->low);
    out.add(fmt::format("form {} high", name), scale->high);
  }
  out.add("form gain", form.gain.log_gain);
  out.add("form gain low", form.gain.low);
  out.add("form gain reduction_pct", form.gain.reduction_pct);
  out.add("form gain high_pct", form.gain.high_pct);
}

bool same(double a, double b) { return std::abs(a - b) <= kHeld * std::max(std::abs(a), std::abs(b)) + kNothing; }

using BySeed = std::map<std::uint64_t, std::map<std::string, double>>;

BySeed read_kept(const std::filesystem::path& file) {
  const io::CsvTable table = io::CsvTable::read(file, {"seed", "name", "value"});
  BySeed kept;
  for (std::size_t row = 0; row < table.rows(); ++row)
    kept[static_cast<std::uint64_t>(table.integer(row, "seed"))][table.text(row, "name")] = table.number(row, "value");
  return kept;
}

/// What differs between the numbers of one trial, in words.
std::vector<std::string> moves(const std::map<std::string, double>& here, const std::map<std::string, double>& there) {
  std::vector<std::string> out;
  for (const auto& [name, value] : here)
    if (!there.contains(name))
      out.push_back(fmt::format("{} is new ({:.8g})", name, value));
    else if (!same(value, there.at(name)))
      out.push_back(fmt::format("{} is {:.8g}, held at {:.8g}", name, value, there.at(name)));
  for (const auto& [name, value] : there)
    if (!here.contains(name)) out.push_back(fmt::format("{} is gone (held at {:.8g})", name, value));
  return out;
}

}  // namespace

std::vector<HeldNumber> numbers_of(std::uint64_t seed, const diagnosis::Diagnosis& result) {
  Numbers out(seed);
  out.add("verdict " + std::string(name_of(result.verdict)) + " log odds", result.log_odds);
  out.add("threshold", result.threshold);
  out.add("residual", result.residual.statistic);
  out.add("residual dof", result.residual.dof);
  out.add("residual block p value", result.residual.block_p_value);
  for (std::size_t b = 0; b < std::min(kHeldBlocks, result.residual.blocks.size()); ++b)
    out.add("residual of " + result.residual.blocks[b].name, result.residual.blocks[b].statistic);
  for (std::size_t l = 0; l < std::min(kHeldLocations, result.localisation.size()); ++l)
    out.add("location " + result.localisation[l].location, result.localisation[l].score);
  out.add("gain before", result.gain.before);
  out.add("gain after", result.gain.after);
  out.add("gain low_pct", result.gain.low_pct);
  out.add("gain high_pct", result.gain.high_pct);
  add_effects(out, result);
  add_fit(out, "before", result.before);
  add_fit(out, "after", result.after);
  add_ranking(out, result.ranking);
  if (result.form) add_form(out, *result.form);
  return std::move(out).all();
}

bool are_held(const std::vector<HeldNumber>& numbers, const std::filesystem::path& file) {
  const BySeed kept = read_kept(file);
  BySeed found;
  for (const HeldNumber& n : numbers) found[n.seed][n.name] = n.value;
  std::size_t compared = 0, moved = 0;
  for (const auto& [seed, here] : found) {
    if (!kept.contains(seed)) continue;
    ++compared;
    for (const std::string& move : moves(here, kept.at(seed)))
      if (++moved <= kPrinted) fmt::print("  seed {}: {}\n", seed, move);
  }
  fmt::print("numbers held in {}: {} of {} trials compared, {} numbers moved{}\n", file.filename().string(), compared,
             kept.size(), moved, moved == 0 ? "" : "; where that is meant, `make hold` writes them anew");
  return compared > 0 && moved == 0;
}

bool Holding::done(const std::vector<HeldNumber>& numbers) const {
  if (file.empty()) return true;
  if (!write) return are_held(numbers, file);
  io::CsvWriter writer({"seed", "name", "value"});
  for (const HeldNumber& n : numbers) writer.row({static_cast<long>(n.seed), n.name, n.value});
  writer.save(file);
  return true;
}

Holding holding_of(int& argc, char** argv) {
  const std::string last = argc > 2 ? argv[argc - 2] : "";
  if (last != "--held" && last != "--hold") return {};
  argc -= 2;
  return {argv[argc + 1], last == "--hold"};
}

}  // namespace twindeck::blind::form
