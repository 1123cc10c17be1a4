#pragma once

#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "updating/weighing.hpp"

/// What a weighed update found, in words: agreement, parameters with their deviations, and what cannot be told apart.
namespace twindeck::updating {

/// A measured row beside what the updated model computes for it.
struct WeighedRow {
  Eigen::Index at = 0;                           ///< position among the rows
  std::size_t target = 0;                        ///< position of its pair
  std::string type;                              ///< frequency_Hz, shape, shape_imag
  std::string channel;                           ///< of a shape, else empty
  double value = 0.0, std = 0.0, updated = 0.0;  ///< [Hz] or [-]
  [[nodiscard]] double difference_std() const { return (updated - value) / std; }
};
[[nodiscard]] std::vector<WeighedRow> weighed_row_list(const Weighed& weighed);

/// Parameters that the rows cannot tell apart, at the initial values or at the optimum, named in sentences.
[[nodiscard]] std::vector<std::string> twin_sentences(const Weighed& weighed);
/// Directions that the rows hardly limit. @param several  those of several parameters, else those of one
[[nodiscard]] std::vector<std::string> flat_sentences(const Weighed& weighed, const Posterior& posterior, bool several);
/// Other optima that the rows cannot rule out.
[[nodiscard]] std::vector<std::string> rival_sentences(const Weighed& weighed);
/// Empty where the differences are as large as the covariance says; else how large, and which channel makes most of them.
[[nodiscard]] std::string misfit_sentence(const Weighed& weighed, const Posterior& posterior);

/// All of these, as lines and warnings.
void say_weighing(Reporter& reporter, const Weighed& weighed, const Posterior& posterior);

}  // namespace twindeck::updating
