#include "diagnosis/files/damper_places.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"

namespace twindeck::diagnosis {

std::vector<DamperMove> read_damper_places(const std::filesystem::path& file, const fe::Model* model) {
  const auto table = io::CsvTable::read(file, {"alternative", "damper", "x_m", "y_m", "z_m"}, {});
  std::vector<std::string> known;
  if (model != nullptr)
    for (const fe::Spring& spring : model->springs)
      if (spring.is_damper() && can_be_moved(spring)) known.push_back(spring.name);
  std::vector<DamperMove> moves;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const std::string name = table.text(r, "alternative"), damper = table.text(r, "damper");
    if (!contains(known, damper))
      table.fail(
          r, "damper",
          fmt::format("'{}' is no damper of the model between a node and the ground{}", damper, did_you_mean(damper, known)),
          known.empty() ? "the model has none: leave damper_places out"
                        : fmt::format("name one of its springs.csv: {}", fmt::join(known, ", ")));
    if (moves.empty() || moves.back().name != name) moves.push_back({name, {}, {}});
    moves.back().dampers.push_back(damper);
    moves.back().x_m.emplace_back(table.number(r, "x_m"), table.number(r, "y_m"), table.number(r, "z_m"));
  }
  return moves;
}

}  // namespace twindeck::diagnosis
