#include "ponte/deck_axis.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace twindeck::ponte {

DeckAxis::DeckAxis(const DeckDefinition& deck)
    : radius_m(deck.radius_m), length_m(deck.length_m), end_y_m(deck.end_y_m), crown_z_m(deck.crown_z_m), rise_m(deck.rise_m) {}

Eigen::Vector3d DeckAxis::point(double s_m, double v_m, double w_m) const {
  const double phi_0 = length_m / (2 * radius_m);
  const Eigen::Vector3d centre(0.0, end_y_m - radius_m * std::cos(phi_0),
                               crown_z_m - rise_m * std::pow(2 * s_m / length_m, 2) + w_m);
  return centre + (radius_m + v_m) * radial(s_m);
}

Eigen::Vector3d DeckAxis::radial(double s_m) const { return {std::sin(s_m / radius_m), std::cos(s_m / radius_m), 0.0}; }

Eigen::Vector3d DeckAxis::tangent(double s_m) const { return {std::cos(s_m / radius_m), -std::sin(s_m / radius_m), 0.0}; }

std::vector<double> stay_positions(const StayRow& stay) {
  std::vector<double> out;
  for (int i = 1; i < stay.count; ++i) {
    out.push_back((i - 0.5) * stay.spacing_m);
  }
  out.push_back(out.back() + stay.last_spacing_m);
  return out;
}

std::vector<double> stations(const DeckDefinition& deck, int panels_per_stay_spacing) {
  std::vector<double> fixed = stay_positions(deck.stay);
  fixed.push_back(deck.length_m / 2);
  const double longest = deck.stay.spacing_m / panels_per_stay_spacing;
  std::vector<double> half = {0.0};
  for (const double end : fixed) {
    const double start = half.back();
    // The small number keeps a spacing that is a whole multiple of the panel from being divided once more by rounding.
    const int panels = static_cast<int>(std::ceil((end - start) / longest - 1e-9));
    for (int i = 1; i <= panels; ++i) {
      half.push_back(start + (end - start) * i / panels);
    }
  }
  std::vector<double> out;
  std::transform(half.rbegin(), std::prev(half.rend()), std::back_inserter(out), [](double s) { return -s; });
  out.insert(out.end(), half.begin(), half.end());
  return out;
}

}  // namespace twindeck::ponte
