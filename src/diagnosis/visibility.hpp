#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

/// What a set of rows would see of each cause, before anything is measured.
namespace twindeck::diagnosis {

/// What the rows see of one entry of the catalogue, at the magnitude whose signature is strongest among those that the screen
/// tries.
struct Visibility {
  const Candidate* candidate = nullptr;
  std::optional<double>
      smallest;             ///< magnitude of the first unknown that would be named, in its unit; nothing where none would
  double sigma = 0.0;       ///< length of the signature in standard deviations of the rows
  std::string imitation;    ///< entry of another family that comes nearest; "" where none does
  double separation = 0.0;  ///< how far that one stays away, in standard deviations
  std::string status;       ///< "visible", "these data cannot see it", "too small at the tried magnitude"
};

/// A name needs 1/2 s^2 + ln(prior) of 5 nats, s being the length of the signature in standard deviations.
/// @return an item for each entry of the catalogue that has a signature, in the order of the entries
[[nodiscard]] std::vector<Visibility> visibility(const Inference& inference);

}  // namespace twindeck::diagnosis
