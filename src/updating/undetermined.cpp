#include "updating/undetermined.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twindeck::updating {
namespace {

using Eigen::Index;

constexpr double named_share = 0.1;  // [-] of a unit direction: who takes part less is left out of a sentence
constexpr double at_rest = 1e-6;     // [ranges] within which a parameter is at its initial value

const fe::Parameter& parameter_of(const Weighed& weighed, Index j) {
  return weighed.loaded.system.parameters[static_cast<std::size_t>(weighed.active[static_cast<std::size_t>(j)])];
}

/// The component that a direction consists of, -1 for several.
Index only_component(const Eigen::VectorXd& direction) {
  Index largest = 0;
  const double size = direction.cwiseAbs().maxCoeff(&largest);
  return direction.norm() - size < named_share * named_share * size ? largest : -1;
}

std::string sentence_of_one(const Weighed& weighed, Index j) {
  const fe::Parameter& parameter = parameter_of(weighed, j);
  const double value = weighed.result.theta(weighed.active[static_cast<std::size_t>(j)]);
  const bool stays = std::abs(value - parameter.initial) <= at_rest * (parameter.upper - parameter.lower);
  return fmt::format(
      "the data do not determine {}: nothing that is fitted depends on it, so that {}. Leave it out of `parameters`, or "
      "measure what depends on it",
      parameter.name,
      stays ? fmt::format("it stays at its initial value {:.6g}", parameter.initial)
            : fmt::format("its value {:.6g} means nothing", value));
}

/// One direction is told with steps of one standard deviation of the ranges, as those of `FlatDirection`, the first of them
/// upwards. Of more directions only the names are the same on every processor.
std::string sentence_of_several(const Weighed& weighed, const Eigen::MatrixXd& directions) {
  std::vector<std::string> names, steps;
  double sign = 0.0;
  for (Index j = 0; j < directions.rows(); ++j) {
    if (directions.row(j).norm() < named_share) continue;
    const fe::Parameter& parameter = parameter_of(weighed, j);
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

}  // namespace

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

}  // namespace twindeck::updating
