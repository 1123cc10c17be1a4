#include "model_io/equal_masses.hpp"

#include <fmt/format.h>

#include <map>

namespace twindeck::model_io {

void group_equal_masses(std::vector<fe::PointMass>& masses) {
  std::map<double, int> count;
  for (const fe::PointMass& mass : masses) ++count[mass.mass_kg];
  for (fe::PointMass& mass : masses)
    if (count[mass.mass_kg] > 1) mass.group = fmt::format("mass_of_{:g}", mass.mass_kg);
}

}  // namespace twindeck::model_io
