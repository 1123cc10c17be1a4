#include "updating/weighing_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/lists.hpp"
#include "sensitivity/frequency_jacobian.hpp"
#include "updating/posterior.hpp"

namespace twindeck::updating {
namespace {

using Eigen::Index;

constexpr double named_component = 0.2;  ///< [prior standard deviations] smaller components of a flat direction are not named
constexpr double as_good = 4.0;  ///< [-] difference of chi² of equally good optima: two standard deviations of one parameter
constexpr double doubtful_score = 3.09;    ///< [deviations] score of chi² that one sound measurement in a thousand exceeds
constexpr double most_of_misfit = 0.4;     ///< [-] share of the squared differences above which a channel is named
constexpr double close_correlation = 0.9;  ///< [-] above this correlation the deviations alone mislead
constexpr double told_share = 0.95;        ///< [-] part of a flat direction that must lie in UpdatingResult::flat

std::vector<std::vector<std::string>> sets_at(const Weighed& weighed, const Eigen::MatrixXd& jacobian) {
  if (jacobian.size() == 0) return {};
  const Eigen::VectorXd half = 0.5 * (weighed.result.box.upper - weighed.result.box.lower);
  return named_sets(weighed.loaded, weighed.active, updating::indistinct_sets(jacobian * half.asDiagonal()));
}

void say_parameters(Reporter& reporter, const Weighed& weighed, const Posterior& posterior) {
  for (Index j = 0; j < posterior.std.size(); ++j) {
    const double value = weighed.result.theta(weighed.active[static_cast<std::size_t>(j)]);
    reporter.say(posterior.is_held[static_cast<std::size_t>(j)]
                     ? fmt::format("{:<14} {:>13.6g}  held by its bound", weighed.parameter(j).name, value)
                     : fmt::format("{:<14} {:>13.6g} +- {:.2g} (std_with_misfit)", weighed.parameter(j).name, value,
                                   posterior.std[j] * posterior.misfit()));
  }
  for (Index j = 0; j < posterior.std.size(); ++j)
    for (Index k = j + 1; k < posterior.std.size(); ++k)
      if (std::abs(posterior.correlation(j, k)) >= close_correlation)
        reporter.say(fmt::format("{} and {} are known together only: correlation {:+.3f}", weighed.parameter(j).name,
                                 weighed.parameter(k).name, posterior.correlation(j, k)));
}

/// Parameters that the rows cannot tell apart, at the initial values or at the optimum, named in sentences.
std::vector<std::string> twin_sentences(const Weighed& weighed) {
  std::vector<std::string> sentences;
  const auto at_optimum = sets_at(weighed, weighed.result.at_optimum.jacobian);
  const auto at_start = sets_at(weighed, weighed.result.at_start.jacobian);
  const auto add = [&](const std::vector<std::string>& names, const char* where) {
    sentences.push_back(
        fmt::format("what is weighed cannot tell {} apart {}: what one does another does as well, so that "
                    "blame may fall on the wrong one. Update one of them, or measure where they differ",
                    fmt::join(names, ", "), where));
  };
  for (const auto& names : at_optimum) add(names, "at the optimum");
  for (const auto& names : at_start)
    if (!contains(at_optimum, names)) add(names, "at the initial values");
  return sentences;
}

/// Whether a flat direction is one of those that the data do not determine at all (UpdatingResult::flat). Another sentence
/// names these.
bool is_told(const UpdatingResult& result, const FlatDirection& flat) {
  if (result.flat.cols() == 0) return false;
  const Eigen::VectorXd per_range = flat.step.cwiseQuotient(result.scale).cwiseQuotient(result.box.upper - result.box.lower);
  return (result.flat.transpose() * per_range).norm() >= told_share * per_range.norm();
}

/// Directions that the rows hardly limit. @param several  true: directions of several parameters; false: of one
/// @param rows  their name
std::vector<std::string> flat_sentences(const Weighed& weighed, const Posterior& posterior, bool several,
                                        const char* rows = "what is weighed") {
  std::vector<std::string> sentences;
  for (const FlatDirection& flat : posterior.flat) {
    if (is_told(weighed.result, flat)) continue;
    std::vector<std::string> parts;
    for (Index j = 0; j < flat.step.size(); ++j)
      if (std::abs(flat.step[j]) >= named_component * posterior.prior_std[j])
        parts.push_back(fmt::format("{} by {:+.3g}", weighed.parameter(j).name, flat.step[j]));
    if ((parts.size() > 1) != several) continue;
    sentences.push_back(fmt::format(
        "flat direction: moving {}{} changes {} by {:.2g} standard deviations only; {}", fmt::join(parts, " and "),
        several ? " together" : "", rows, flat.change,
        several ? "the measurement does not say how they share it" : "its bounds say more of it than the measurement"));
  }
  return sentences;
}

/// Other optima that the rows cannot rule out.
std::vector<std::string> rival_sentences(const Weighed& weighed) {
  const UpdatingResult& result = weighed.result;
  std::vector<std::string> sentences;
  const double least = 2.0 * result.starts.at(static_cast<std::size_t>(result.best)).cost;
  for (const int k : result.optima) {
    const StartResult& start = result.starts.at(static_cast<std::size_t>(k));
    if (k == result.starts.at(static_cast<std::size_t>(result.best)).optimum || 2.0 * start.cost > least + as_good) continue;
    std::vector<std::string> values;
    for (Index j = 0; j < start.theta.size(); ++j)
      values.push_back(fmt::format("{} {:.4g}", weighed.parameter(j).name, start.theta[j]));
    sentences.push_back(fmt::format("another optimum is as good (chi² {:.4g} against {:.4g}): {}", 2.0 * start.cost, least,
                                    fmt::join(values, ", ")));
  }
  return sentences;
}

/// Size of the differences and the channel with the largest share; empty if they are as large as the covariance says.
std::string misfit_sentence(const Weighed& weighed, const Posterior& posterior) {
  if (posterior.chi_squared_score() < doubtful_score) return "";
  std::map<std::string, double> by_channel;
  double sum = 0.0;
  for (const WeighedRow& row : weighed_row_list(weighed)) {
    by_channel[row.channel] += row.difference_std() * row.difference_std();
    sum += row.difference_std() * row.difference_std();
  }
  const auto worst =
      std::max_element(by_channel.begin(), by_channel.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::string sentence = fmt::format(
      "chi² is {:.4g} with {} degrees of freedom: model and measurement differ {:.2g} times as much as the covariance says, "
      "and standard deviations count that much more (std_with_misfit)",
      posterior.chi_squared, posterior.degrees, posterior.misfit());
  if (worst->second < most_of_misfit * sum) return sentence;
  const std::string share = fmt::format(". {:.0f} % of the squared differences ", 100.0 * worst->second / sum);
  if (worst->first.empty()) return sentence + share + "are the frequencies'";
  return sentence + share + "are channel " + worst->first +
         "'s: it may be reversed, exchanged or mis-scaled (s9_diagnosis finds out, --correct puts it right)";
}

constexpr double named_share = 0.1;  // [-] component of a unit direction; parameters with smaller ones are not named
constexpr double at_rest = 1e-6;     // [ranges] a parameter this near to its initial value has not moved

/// The component that a direction consists of, -1 for several.
Index only_component(const Eigen::VectorXd& direction) {
  Index largest = 0;
  const double size = direction.cwiseAbs().maxCoeff(&largest);
  return direction.norm() - size < named_share * named_share * size ? largest : -1;
}

std::string sentence_of_one(const Weighed& weighed, Index j) {
  const fe::Parameter& parameter = weighed.parameter(j);
  const double value = weighed.result.theta(weighed.active[static_cast<std::size_t>(j)]);
  const bool stays = std::abs(value - parameter.initial) <= at_rest * (parameter.upper - parameter.lower);
  return fmt::format(
      "the data do not determine {}: nothing that is fitted depends on it, so that {}. Leave it out of `parameters`, or "
      "measure what depends on it",
      parameter.name,
      stays ? fmt::format("it stays at its initial value {:.6g}", parameter.initial)
            : fmt::format("its value {:.6g} means nothing", value));
}

/// A single direction is given with steps of one standard deviation of the ranges, the first step upwards. Of several
/// directions only the names are given: their steps differ between processors.
std::string sentence_of_several(const Weighed& weighed, const Eigen::MatrixXd& directions) {
  std::vector<std::string> names, steps;
  double sign = 0.0;
  for (Index j = 0; j < directions.rows(); ++j) {
    if (directions.row(j).norm() < named_share) continue;
    const fe::Parameter& parameter = weighed.parameter(j);
    if (sign == 0.0) sign = std::copysign(1.0, directions(j, 0));
    names.push_back(parameter.name);
    const double step = sign * directions(j, 0) * (parameter.upper - parameter.lower) / std::sqrt(12.0);
    steps.push_back(fmt::format("{} by {:+.3g}", parameter.name, step));
  }
  const bool one = directions.cols() == 1;
  return fmt::format(
      "flat {}: {} changes nothing that is fitted, so that the data do not determine {} one by one. Of all values that fit as "
      "well, those nearest the initial ones are given. Update fewer of them, or measure more",
      one ? "direction" : "directions",
      one ? fmt::format("moving {} together", fmt::join(steps, " and "))
          : fmt::format("moving parameters together in {} ways", directions.cols()),
      fmt::join(names, ", "));
}

/// Shift of each paired frequency, in its standard deviations, over half the range of each active parameter.
Eigen::MatrixXd scaled_shifts(const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes,
                              const std::vector<int>& active, const matching::Measured& measured,
                              const matching::Pairing& pairing) {
  const Eigen::MatrixXd exact = sensitivity::frequency_jacobian(loaded.system, loaded.theta, modes);
  Eigen::MatrixXd shifts(static_cast<Index>(pairing.pairs.size()), static_cast<Index>(active.size()));
  for (Index i = 0; i < shifts.rows(); ++i) {
    const matching::ModePair& pair = pairing.pairs[static_cast<std::size_t>(i)];
    for (Index j = 0; j < shifts.cols(); ++j) {
      const int p = active[static_cast<std::size_t>(j)];
      const fe::Parameter& parameter = loaded.system.parameters[static_cast<std::size_t>(p)];
      shifts(i, j) = exact(pair.numerical, p) * 0.5 * (parameter.upper - parameter.lower) /
                     measured.modes.frequency_std_Hz[pair.experimental];
    }
  }
  return shifts;
}

}  // namespace

std::vector<WeighedRow> weighed_row_list(const Weighed& weighed) {
  std::vector<WeighedRow> list;
  const auto n_targets = static_cast<Index>(weighed.pairing.pairs.size());
  for (Index i = 0; i < weighed.rows.covariance.rows(); ++i) {
    WeighedRow& row = list.emplace_back();
    row.at = i;
    row.std = std::sqrt(weighed.rows.covariance(i, i));
    row.updated = weighed.result.at_optimum.predicted[i];
    if (i < n_targets) {
      row.target = static_cast<std::size_t>(i);
      row.type = "frequency_Hz";
      row.value = weighed.measured.modes.frequency_Hz[weighed.pairing.pairs[row.target].experimental];
      continue;
    }
    const ShapeRow& shape = weighed.rows.shape[static_cast<std::size_t>(i - n_targets)];
    row.target = static_cast<std::size_t>(shape.target);
    row.type = shape.imaginary ? "shape_imag" : "shape";
    row.channel = weighed.measured.modes.dofs[static_cast<std::size_t>(shape.channel)].direction;
    row.value = shape.value;
  }
  return list;
}

void say_weighing(Reporter& reporter, const Weighed& weighed, const Posterior& posterior) {
  say_parameters(reporter, weighed, posterior);
  reporter.say(fmt::format("chi² {:.4g} with {} degrees of freedom ({} rows, {} free scales)", posterior.chi_squared,
                           posterior.degrees, weighed.rows.covariance.rows(), weighed.result.at_optimum.scales));
  for (const std::string& sentence : flat_sentences(weighed, posterior, false)) reporter.say(sentence);
  if (const std::string sentence = misfit_sentence(weighed, posterior); !sentence.empty()) reporter.warn(sentence);
  for (const std::string& sentence : twin_sentences(weighed)) reporter.warn(sentence);
  for (const std::string& sentence : flat_sentences(weighed, posterior, true)) reporter.warn(sentence);
  for (const std::string& sentence : rival_sentences(weighed)) reporter.warn(sentence);
}

std::optional<Posterior> posterior_of_frequencies(const Weighed& weighed) {
  Linearised at = weighed.result.at_optimum;
  double chi_squared = 0.0;
  for (Index i = 0; i < at.jacobian.rows(); ++i) {
    const Index mode = weighed.pairing.pairs[static_cast<std::size_t>(i)].experimental;
    const double deviations = weighed.measured.modes.frequency_Hz[mode] / weighed.measured.modes.frequency_std_Hz[mode];
    if (!std::isfinite(deviations)) return std::nullopt;
    chi_squared += at.residual[i] * at.residual[i] * deviations * deviations;
    at.jacobian.row(i) *= deviations;
    at.residual[i] /= deviations;  // J'r stays the same, so the bounds hold the same parameters
  }
  Posterior out = posterior(at, weighed.normalised(), weighed.result.box, weighed.result.scale);
  out.chi_squared = chi_squared;
  return out;
}

void say_flat_frequencies(Reporter& reporter, const Weighed& weighed, const Posterior& posterior) {
  for (const bool several : {false, true})
    for (const std::string& sentence : flat_sentences(weighed, posterior, several, "the paired frequencies"))
      reporter.say(sentence);
}

std::vector<std::string> undetermined_sentences(const Weighed& weighed) {
  const Eigen::MatrixXd& flat = weighed.result.flat;
  std::vector<std::string> sentences;
  std::vector<Index> several;
  for (Index k = 0; k < flat.cols(); ++k) {
    const Index only = only_component(flat.col(k));
    if (only >= 0)
      sentences.push_back(sentence_of_one(weighed, only));
    else
      several.push_back(k);
  }
  if (!several.empty()) sentences.push_back(sentence_of_several(weighed, flat(Eigen::all, several)));
  return sentences;
}

void warn_of_undetermined(Reporter& reporter, const Weighed& weighed) {
  for (const std::string& sentence : undetermined_sentences(weighed)) reporter.warn(sentence);
}

std::vector<std::vector<std::string>> indistinct_parameters(const dynamics::LoadedModel& loaded,
                                                            const dynamics::EigenModes& modes, const std::vector<int>& active,
                                                            const matching::Measured& measured,
                                                            const matching::Pairing& pairing) {
  return named_sets(loaded, active, updating::indistinct_sets(scaled_shifts(loaded, modes, active, measured, pairing)));
}

std::vector<std::vector<std::string>> named_sets(const dynamics::LoadedModel& loaded, const std::vector<int>& active,
                                                 const std::vector<std::vector<int>>& sets) {
  std::vector<std::vector<std::string>> named;
  for (const std::vector<int>& set : sets) {
    std::vector<std::string>& names = named.emplace_back();
    for (const int j : set)
      names.push_back(loaded.system.parameters[static_cast<std::size_t>(active[static_cast<std::size_t>(j)])].name);
  }
  return named;
}

void warn_of_twins(Reporter& reporter, const std::vector<std::vector<std::string>>& sets, bool has_shapes) {
  const char* mend = has_shapes ? "weigh the shapes too (residuals = [\"frequency\", \"shape\"]), or ask s9_diagnosis"
                                : "or ask s9_diagnosis, which weighs the shapes too";
  for (const std::vector<std::string>& names : sets)
    reporter.warn(fmt::format(
        "the paired frequencies cannot tell {} apart: what one does to them another does as well, so that blame may "
        "fall on the wrong one. Update one of them, {}",
        fmt::join(names, ", "), mend));
}

}  // namespace twindeck::updating
