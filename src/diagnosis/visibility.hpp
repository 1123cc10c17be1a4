#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

/// Visibility of each cause in a set of rows, before anything is measured.
namespace twindeck::diagnosis {

/// Visibility of one entry of the catalogue, at the trial magnitude with the strongest signature.
struct Visibility {
  const Candidate* candidate = nullptr;
  std::optional<double> smallest;  ///< smallest magnitude of the first unknown that would be named, in its unit; empty if none
  double sigma = 0.0;              ///< length of the signature in standard deviations of the rows
  std::string imitation;           ///< nearest entry of another family; "" if there is none
  double separation = 0.0;         ///< part of the signature that the nearest entry cannot imitate, in standard deviations
  std::string status;              ///< "visible", "these data cannot see it", "too small at the tried magnitude"
};

/// A name needs 1/2 s^2 + ln(prior) of 5 nats, s being the length of the signature in standard deviations.
/// @return an item for each entry of the catalogue that has a signature, in the order of the entries
[[nodiscard]] std::vector<Visibility> visibility(const Inference& inference);

}  // namespace twindeck::diagnosis
