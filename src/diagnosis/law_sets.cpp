#include "diagnosis/law_sets.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/parallel.hpp"
#include "diagnosis/form_magnitudes.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPromises = 3.0;  ///< nats that a set may be below the best smaller one on the linearised base

/// Products of the entries' signatures with the residual and with each other, at one choice of scales.
struct LookAtSets {
  std::set<int> contrasts;  // contrasts whose class is active
  VectorXd along;
  MatrixXd products;
};

class SetScreen {
 public:
  SetScreen(const LawSearch& search, const OneLaw& law) : search_(search) {
    for (const LawAccount& account : search.accounts) {
      if (members_.size() == kMembersOfSets) break;
      if (account.members.size() == 1) members_.push_back(account.members.front());
    }
    std::vector<int> columns;
    for (const int m : members_) {
      const LawEntry& entry = search.entries[static_cast<std::size_t>(m)];
      first_.push_back(std::ssize(columns));
      for (std::size_t i = 0; i < entry.tried.size(); ++i)
        columns.push_back(static_cast<int>(entry.first_signature + static_cast<Index>(i)));
    }
    if (!law.coordinates().exist()) return;
    const MatrixXd changes = law.coordinates().of(search.system.signatures(Eigen::all, columns));
    const MatrixXd left = law.coordinates().of(search.system.residual);
    std::size_t looked = 0;
    for (const LawAccount& account : search.accounts) {
      if (!account.scored) continue;
      if (looked++ == kTried) break;  // sets are weighed at the scales of these accounts
      const OneLaw::Point at = law.at(account.evidence.tau);
      if (!at.exists) continue;
      const MatrixXd s = at.whitened(changes);
      LookAtSets look;
      for (Index c = kFirstContrast; c < account.evidence.tau.size(); ++c)
        if (account.evidence.tau[c] > 0.0) look.contrasts.insert(static_cast<int>(c) - kFirstContrast);
      look.along = s.transpose() * at.whitened(left);
      look.products = linalg::product(s, s, true);
      looks_.push_back(std::move(look));
    }
  }
  [[nodiscard]] std::size_t size() const { return members_.size(); }
  [[nodiscard]] int entry(std::size_t local) const { return members_[local]; }
  [[nodiscard]] bool is_same_cause(std::size_t a, std::size_t b) const {
    const auto of = [&](std::size_t local) -> const LawEntry& {
      return search_.entries[static_cast<std::size_t>(members_[local])];
    };
    return diagnosis::is_same_cause(of(a), of(b));
  }

  /// ln likelihood of a set relative to no cause, summed over magnitudes, with the prior, at the best scales.
  [[nodiscard]] double promise(const std::vector<std::size_t>& set) const {
    double best = -1e300, prior = 0.0;
    std::set<int> contrasts;
    for (const std::size_t m : set) {
      const LawEntry& entry = search_.entries[static_cast<std::size_t>(members_[m])];
      prior += entry.log_prior;
      if (entry.contrast >= 0) contrasts.insert(entry.contrast);
    }
    for (const LookAtSets& look : looks_)
      if (look.contrasts == contrasts) best = std::max(best, prior + summed_over(look, set, 0, {}, 0.0));
    return best;
  }

 private:
  struct Chosen {
    Index column;
    double factor;
  };
  double summed_over(const LookAtSets& look, const std::vector<std::size_t>& set, std::size_t at, std::vector<Chosen> chosen,
                     double value) const {
    if (at == set.size()) return value;
    const LawEntry& entry = search_.entries[static_cast<std::size_t>(members_[set[at]])];
    const std::vector<double> factors = magnitude_factors(*entry.candidate);
    chosen.push_back({});
    double top = -1e300, sum = 0.0;
    for (std::size_t i = 0; i < entry.tried.size(); ++i)
      for (const double t : factors) {
        const Index column = first_[set[at]] + static_cast<Index>(i);
        double here = value + t * look.along[column] - 0.5 * t * t * look.products(column, column);
        for (std::size_t k = 0; k < at; ++k) here -= t * chosen[k].factor * look.products(column, chosen[k].column);
        chosen.back() = {column, t};
        const double term = summed_over(look, set, at + 1, chosen, here);
        if (term > top) {
          sum = sum * std::exp(top - term) + 1.0;
          top = term;
        } else {
          sum += std::exp(term - top);
        }
      }
    return top + std::log(sum / static_cast<double>(entry.tried.size() * factors.size()));
  }

  const LawSearch& search_;
  std::vector<int> members_;
  std::vector<Index> first_;
  std::vector<LookAtSets> looks_;
};

struct Promising {
  std::vector<std::size_t> set;
  double value = 0.0;
};

void keep_best(std::vector<Promising>& found) {
  std::ranges::stable_sort(found, [](const Promising& a, const Promising& b) { return a.value > b.value; });
  if (found.size() > kTried) found.resize(kTried);
}

std::vector<Promising> larger_sets(const SetScreen& screen, const std::vector<Promising>& smaller) {
  std::set<std::vector<std::size_t>> sets;
  for (const Promising& from : smaller)
    for (std::size_t m = 0; m < screen.size(); ++m) {
      std::vector<std::size_t> set = from.set;
      if (std::ranges::any_of(set, [&](std::size_t other) { return screen.is_same_cause(m, other); })) continue;
      set.push_back(m);
      std::sort(set.begin(), set.end());
      sets.insert(std::move(set));
    }
  std::vector<Promising> out;
  for (const auto& set : sets) out.push_back({set, 0.0});
  parallel_for(out.size(), [&](std::size_t i) { out[i].value = screen.promise(out[i].set); });
  return out;
}

}  // namespace

void add_sets(const LawSearch& search, const OneLaw& law, const std::function<void(LawAccount&)>& weigh,
              const Progress& progress, std::vector<LawAccount>& found) {
  const SetScreen screen(search, law);
  std::vector<Promising> smaller;
  for (std::size_t m = 0; m < screen.size(); ++m) smaller.push_back({{m}, screen.promise({m})});
  double best = search.accounts.front().log_weight;
  for (std::size_t size = 2; size <= kMostInASet; ++size) {
    double most = -1e300;
    for (const Promising& s : smaller) most = std::max(most, s.value);
    std::vector<Promising> larger = larger_sets(screen, smaller);
    keep_best(larger);
    std::erase_if(larger, [&](const Promising& l) { return l.value < most - kPromises; });
    std::vector<LawAccount> accounts(larger.size());
    parallel_for_told(
        larger.size(),
        [&](std::size_t i) {
          for (const std::size_t m : larger[i].set) {
            accounts[i].members.push_back(screen.entry(m));
            accounts[i].log_prior += search.entries[static_cast<std::size_t>(accounts[i].members.back())].log_prior;
          }
          weigh(accounts[i]);
        },
        [&](int done, int of) { progress(size == 2 ? "pairs of causes fitted" : "sets of three fitted", done, of); });
    std::erase_if(accounts, [](const LawAccount& a) { return !a.scored; });
    double leading = -1e300;
    for (LawAccount& account : accounts) {
      leading = std::max(leading, account.log_weight);
      found.push_back(std::move(account));
    }
    if (!(leading > best)) return;  // larger sets would not lead either
    best = leading;
    smaller = std::move(larger);
  }
}

}  // namespace twindeck::diagnosis
