#include "blind/held_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/csv.hpp"

namespace twindeck::blind {

namespace {

/// Relative. Other processors' kernels move the numbers of the seeds that are held by less; a fault moves some by far more.
constexpr double kHeld = 1e-4;
/// Below it a number is rounding: odds, deviations and shares are of the order of one.
constexpr double kNothing = 1e-7;
constexpr std::size_t kPrinted = 8;  ///< differences that are shown

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

}  // namespace

void HeldNumbers::add(const std::string& name, double value) {
  if (std::isfinite(value)) all_.push_back({seed_, name, value});
}

void HeldNumbers::add(const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& v) {
  if (v.size() == 0) return;
  add(name + " squared", v.squaredNorm());
  add(name + " in order", v.dot(Eigen::VectorXd::LinSpaced(v.size(), 1.0, static_cast<double>(v.size()))));
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

}  // namespace twindeck::blind
