#include "fe/uneven_shells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/random.hpp"

namespace twindeck::fe {

namespace {

constexpr int kWaves = 6;
constexpr int kClasses = 3;         // to either side of nominal
constexpr double kClassStep = 0.7;  // in standard deviations: the outermost classes stand for what lies beyond 1.75

double unevenness_at(double x_m, double wavelength_m, std::uint64_t deck) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < kWaves; ++i) {
    const double wavelength = wavelength_m / (1.0 + 2.0 * static_cast<double>(i) / (kWaves - 1));
    sum += std::cos(2.0 * std::numbers::pi * (x_m / wavelength + uniform_number(1, deck, i)));
  }
  return sum / std::sqrt(kWaves / 2.0);
}

}  // namespace

Model with_uneven_shells(Model model, double unevenness, double wavelength_m) {
  TWINDECK_ASSERT(unevenness >= 0.0 && unevenness <= 0.3 && wavelength_m > 0.0);
  if (unevenness == 0.0) return model;
  std::map<std::pair<int, int>, int> made;
  for (Element& element : model.elements) {
    if (element.type != ElementType::shell) continue;
    double x = 0.0;
    const auto corners = static_cast<double>(element.nodes.size());
    for (const int node : element.nodes) x += model.nodes[static_cast<std::size_t>(node)].x_m.x() / corners;
    const Section nominal = model.sections[static_cast<std::size_t>(element.section)];
    // "slab_foot_B" and "slab_foot_C" are one deck: their names agree up to the second underscore.
    const std::string deck = nominal.name.substr(0, nominal.name.find('_', nominal.name.find('_') + 1));
    std::uint64_t deck_number = 0;
    for (const char letter : deck) deck_number = 131 * deck_number + static_cast<unsigned char>(letter);
    const double f = unevenness_at(x, wavelength_m, deck_number);
    const int step = std::clamp(static_cast<int>(std::lround(f / kClassStep)), -kClasses, kClasses);
    if (step == 0) continue;
    const auto [entry, is_new] = made.try_emplace({element.section, step}, static_cast<int>(model.sections.size()));
    if (is_new) {
      Section section = nominal;
      section.name += (step > 0 ? "~+" : "~") + std::to_string(step);
      section.thickness_m *= 1.0 + unevenness * kClassStep * step;
      model.sections.push_back(section);
    }
    element.section = entry->second;
  }
  return model;
}

}  // namespace twindeck::fe
