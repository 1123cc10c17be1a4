#include "diagnosis/law_fits.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/lists.hpp"
#include "core/parallel.hpp"
#include "diagnosis/form_base.hpp"
#include "diagnosis/form_magnitudes.hpp"
#include "diagnosis/law_openings.hpp"
#include "diagnosis/law_screen.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kKeptMagnitudes = 10.0;  // nats below the best; smaller terms add nothing
constexpr double kOneFit = 0.01;          // prior deviations; nearer fits count as equal
constexpr double kStands = 1.0;           // least gain in nats of a further fit

/// Classes of a set of causes. The effect sets the scale of the remaining change in each of its contrasts. With several
/// contrasts, how the effect is divided is unknown, and nothing may remain in one of them.
std::vector<ActiveClass> classes_of(const LawSearch& search, const LawSystem& system, const LawAccount& account,
                                    double effect) {
  std::vector<ActiveClass> out = lasting_classes(system);
  std::set<int> contrasts;
  for (const int m : account.members) {
    const std::vector<int>& own = search.entries[static_cast<std::size_t>(m)].contrasts;
    contrasts.insert(own.begin(), own.end());
  }
  for (const int contrast : contrasts)
    if (contrast >= 0)
      out.push_back({kFirstContrast + contrast, left_scale(effect), contrasts.size() == 1 ? std::log(kLeftWithin) : 0.0});
  return out;
}

}  // namespace

void score_at_base(const OneLaw& law, const LawSearch& search, LawAccount& account) {
  struct Choice {
    VectorXd change;
    std::vector<VectorXd> a;
    double square = 0.0;  // of the effect
  };
  std::vector<Choice> choices = {{VectorXd::Zero(search.system.residual.size()), {}, 0.0}};
  for (const int m : account.members) {
    const LawEntry& entry = search.entries[static_cast<std::size_t>(m)];
    std::vector<Choice> next;
    for (const Choice& before : choices)
      for (std::size_t i = 0; i < entry.tried.size(); ++i)
        for (const double t : magnitude_factors(*entry.candidate)) {
          Choice choice = before;
          choice.change += t * search.system.signatures.col(entry.first_signature + static_cast<Index>(i));
          choice.a.push_back(entry.tried[i].a);
          if (is_a_size(*entry.candidate)) choice.a.back()[0] = scaled_magnitude(*entry.candidate, choice.a.back()[0], t);
          choice.square += t * t * entry.effects[i] * entry.effects[i];
          next.push_back(std::move(choice));
        }
    choices = std::move(next);
  }
  MatrixXd left(search.system.residual.size(), std::ssize(choices));
  for (Index k = 0; k < left.cols(); ++k) left.col(k) = search.system.residual - choices[static_cast<std::size_t>(k)].change;
  const OneLaw::Point at = law.at(account.evidence.tau);
  if (!at.exists) return;
  const VectorXd chi_squared = at.whitened(law.coordinates().of(left)).colwise().squaredNorm();
  std::vector<int> kept;
  const Index best = first_of_equals(-chi_squared);
  for (Index k = 0; k < left.cols(); ++k)
    if (chi_squared[k] < chi_squared[best] + 2.0 * kKeptMagnitudes) kept.push_back(static_cast<int>(k));
  const double effect = std::sqrt(choices[static_cast<std::size_t>(best)].square);
  LawHypothesis hypothesis{left(Eigen::all, kept),
                           VectorXd::Constant(std::ssize(kept), -std::log(static_cast<double>(left.cols()))),
                           MatrixXd(left.rows(), 0),
                           {},
                           {},
                           classes_of(search, search.system, account, effect)};
  const LawEvidence evidence = law.scored(hypothesis, account.evidence.tau);
  if (evidence.weight.size() == 0) return;
  const Index most = first_of_equals(evidence.weight);
  const Choice& chosen = choices[static_cast<std::size_t>(kept[static_cast<std::size_t>(most)])];
  account.causes.clear();
  for (std::size_t m = 0; m < account.members.size(); ++m)
    account.causes.push_back({search.entries[static_cast<std::size_t>(account.members[m])].candidate, chosen.a[m]});
  account.effect = std::sqrt(chosen.square);
  account.evidence = evidence;
  account.hypothesis = std::move(hypothesis);
  account.log_weight = evidence.log_evidence + account.log_prior;
  account.scored = true;
}

namespace {

bool acts_in_contrast(const LawSearch& search, const LawAccount& account, int contrast) {
  return std::ranges::any_of(account.members, [&](int m) {
    const std::vector<int>& own = search.entries[static_cast<std::size_t>(m)].contrasts;
    return contains(own, contrast);
  });
}

/// Evidence of a set at a fit with its causes in the model. The fit with the largest evidence is kept and replaces the result
/// of the screen.
void weigh_fit(const LawSetting& setting, const LawSearch& search, LawAccount& account, const VectorXd& tau, Fit with) {
  std::vector<bool> acts(setting.plain.map().features().conditions.size(), false);
  for (const int m : account.members) {
    const LawEntry& entry = search.entries[static_cast<std::size_t>(m)];
    const std::vector<bool> own = acting_conditions(setting, *entry.candidate, entry.contrast);
    for (std::size_t c = 0; c < acts.size(); ++c) acts[c] = acts[c] || own[c];
  }
  std::vector<Contrast> contrasts = setting.contrasts;  // only those of the set; the other contrasts have no class
  for (std::size_t c = 0; c < contrasts.size(); ++c)
    if (!acts_in_contrast(search, account, static_cast<int>(c))) contrasts[c].weight.setZero();
  auto system = std::make_shared<FitSystem>(law_system(setting.plain, with, contrasts, account.members.size()));
  if (!can_be_weighed(*system)) return;  // this entry is left out
  const Prediction without = setting.plain.map().predict(with.base, search.base.causes, false);
  const double effect = without.valid ? effect_on(setting.plain, change_between(without, with.all), acts) : account.effect;
  LawHypothesis hypothesis{system->residual,
                           VectorXd::Zero(1),
                           system->signatures,
                           VectorXd(system->signatures.cols()),
                           VectorXd(system->signatures.cols()),
                           classes_of(search, *system, account, effect)};
  Index at = 0;
  for (std::size_t c = search.base.causes.size(); c < with.causes.size(); ++c)
    for (Index k = 0; k < with.causes[c].a.size(); ++k, ++at) {
      hypothesis.low[at] = with.causes[c].candidate->low[k] - with.causes[c].a[k];
      hypothesis.high[at] = with.causes[c].candidate->high[k] - with.causes[c].a[k];
    }
  OpenedEvidence found = scored_with_openings(setting.plain, *system, hypothesis, tau);
  const double weight = found.evidence.log_evidence + account.log_prior;
  if (found.evidence.weight.size() == 0 || (account.refined() && !(weight > account.log_weight))) return;
  account.log_weight = weight;
  account.evidence = std::move(found.evidence);
  account.opened = std::move(found.opened);
  account.hypothesis = std::move(hypothesis);
  account.effect = effect;
  account.causes.assign(with.causes.begin() + std::ssize(search.base.causes), with.causes.end());
  account.with = std::move(with);
  account.system = std::move(system);
  account.scored = true;
}

}  // namespace

void settle(const LawSetting& setting, LawAccount& account, const std::function<LawAccount(const LawAccount&, Fit)>& weighed) {
  for (int round = 0; round < kLeadingRounds; ++round) {
    Fit with = fit_by_own_scales(setting, account);
    if (!with.made()) return;
    LawAccount anew = weighed(account, std::move(with));
    if (!anew.refined() || !anew.scored || (round > 0 && anew.log_weight < account.log_weight + kStands)) return;
    account = std::move(anew);
  }
}

namespace {

void settle_causes(const LawSetting& setting, const LawSearch& search, LawAccount& account) {
  account.settled = true;
  account.first_weight = account.log_weight;
  settle(setting, account, [&](const LawAccount& before, Fit with) {
    LawAccount anew = before;
    anew.system.reset();
    weigh_fit(setting, search, anew, before.evidence.tau, std::move(with));
    return anew;
  });
}

}  // namespace

void refine_by_law(const LawSetting& setting, const LawSearch& search, LawAccount& account,
                   const std::vector<VectorXd>& starts) {
  std::vector<std::vector<Cause>> causes = {search.base.causes};
  causes[0].insert(causes[0].end(), account.causes.begin(), account.causes.end());
  if (account.members.size() == 1 && account.across.size() > 0) {
    causes.push_back(causes[0]);
    causes[1].back().a = account.across;
  }
  const VectorXd tau = account.evidence.tau;
  for (const std::vector<Cause>& start : causes)
    for (const VectorXd& x : starts) {
      Fit with = setting.informed.fit(start, x);
      const auto is_same = [&](const VectorXd& before) { return (with.map.x - before).norm() < kOneFit; };
      if (!with.made() || std::ranges::any_of(account.fitted, is_same)) continue;
      account.fitted.push_back(with.map.x);
      weigh_fit(setting, search, account, tau, std::move(with));
    }
}

VectorXd parameters_of(const LawSetting& setting, const LawAccount& account) {
  return account.with.map.x.head(std::ssize(setting.plain.map().nuisances()));
}

void settle_rivals(const LawSetting& setting, LawSearch& search) {
  for (int round = 0; round < kLeadingRounds; ++round) {
    sort_accounts(search.accounts);
    if (search.accounts.empty() || !search.accounts.front().refined()) return;
    const LawAccount leader = search.accounts.front();
    const VectorXd x = parameters_of(setting, leader);
    std::vector<LawAccount*> rivals;
    for (std::size_t i = 0; i < std::min(kMostLeading, search.accounts.size()); ++i) {
      LawAccount& account = search.accounts[i];
      if (account.refined() && !(account.settled && account.beside == leader.members)) rivals.push_back(&account);
    }
    if (rivals.empty()) return;
    parallel_for_told(
        rivals.size(),
        [&](std::size_t i) {
          LawAccount& account = *rivals[i];
          account.beside = leader.members;
          LawAccount anew = account;
          anew.system.reset();
          if (account.members != leader.members) refine_by_law(setting, search, anew, {x});
          account.fitted = anew.fitted;
          const double before = account.settled ? account.first_weight : account.log_weight;
          const bool promises = anew.refined() && anew.log_weight > before;
          if (!account.settled) {
            if (promises) account = anew;
            settle_causes(setting, search, account);
          } else if (promises) {
            settle_causes(setting, search, anew);
            if (anew.log_weight > account.log_weight) account = std::move(anew);
          }
        },
        [&](int done, int of) { setting.progress("rivals fitted", done, of); });
  }
  sort_accounts(search.accounts);
}

Fit fit_by_own_scales(const LawSetting& setting, const LawAccount& account, const std::vector<int>& aside) {
  const LawSystem& system = *account.system;
  VectorXd tau = account.evidence.tau;
  tau[kGains] = 0.0;  // the gains are already unknowns of the fit, and so are elements with their stated scatter
  if (tau[kElements] > 0.0) tau[kElements] = std::sqrt(std::max(tau[kElements] * tau[kElements] - 1.0, 0.0));
  const Index n = system.residual.size();
  MatrixXd share = covariance_at(MatrixXd::Zero(n, n), system.classes, tau);
  for (const int row : aside) share(row, row) += kAside * kAside;
  const FeatureMap& plain = setting.plain.map();
  MatrixXd further = MatrixXd::Zero(plain.values().size(), plain.values().size());
  further(setting.plain.training(), setting.plain.training()) = share;
  FeatureMap map = with_open(plain, account.opened);
  map.add_covariance(further);
  std::vector<Cause> causes = account.with.causes;
  Index at = 0;
  for (std::size_t c = causes.size() - account.causes.size(); c < causes.size(); ++c)
    for (Index k = 0; k < causes[c].a.size(); ++k, ++at) causes[c].a[k] += account.evidence.shift[at];
  return Inference(map, setting.plain.candidates()).fit(causes, account.with.map.x.head(std::ssize(plain.nuisances())));
}

}  // namespace twindeck::diagnosis
