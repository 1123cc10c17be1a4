#include "aero/files/turbulence_sets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "core/error.hpp"
#include "io/csv.hpp"

namespace twindeck::aero {

wind::TurbulenceSet read_turbulence_set(const std::filesystem::path& file, const std::string& name) {
  std::vector<std::string> columns = {
      "set",           "roughness_m", "minimum_height_m", "kappa", "sigma_u_over_v", "sigma_w_over_v", "scale_u_over_v",
      "scale_w_over_v"};
  for (const wind::Component c : wind::components) {
    for (const char* axis : {"along", "across", "vertical"}) columns.push_back("decay_" + wind::paper_letter(c) + "_" + axis);
  }
  const io::CsvTable table = io::CsvTable::read(file, columns, {"code"});
  std::vector<std::string> known;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    known.push_back(table.text(row, "set"));
    if (known.back() != name) continue;
    const auto positive = [&](const std::string& column) {
      const double value = table.number(row, column);
      if (!(value > 0.0)) table.fail(row, column, fmt::format("is {}, expected a positive number", value));
      return value;
    };
    wind::TurbulenceSet set;
    set.name = name;
    set.roughness_m = positive("roughness_m");
    set.minimum_height_m = positive("minimum_height_m");
    if (set.minimum_height_m <= set.roughness_m) table.fail(row, "minimum_height_m", "lies below the roughness length");
    set.kappa = positive("kappa");
    set.sigma_ratio = {1.0, positive("sigma_u_over_v"), positive("sigma_w_over_v")};
    set.scale_ratio = {1.0, positive("scale_u_over_v"), positive("scale_w_over_v")};
    for (const wind::Component c : wind::components) {
      const std::string decay = "decay_" + wind::paper_letter(c) + "_";
      set.decay[static_cast<std::size_t>(c)] = {positive(decay + "along"), positive(decay + "across"),
                                                positive(decay + "vertical")};
    }
    return set;
  }
  throw InputError({file.string(), 0, "set"}, "has no set '" + name + "'" + did_you_mean(name, known),
                   fmt::format("choose one of {}", fmt::join(known, ", ")));
}

}  // namespace twindeck::aero
