#include "dynamics/unit_slips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>

#include "core/statistics.hpp"
#include "dynamics/doubtful_mesh.hpp"

namespace twindeck::dynamics {

namespace {

using Eigen::Index;

struct Band {
  double low, high;
  [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};

constexpr Band material_speed_m_s{1000.0, 13000.0};  ///< from lead to carbon fibre: what a mended unit has to lead to
constexpr Band usual_speed_m_s{2500.0, 6500.0};      ///< concrete, timber, aluminium, steel
/// Steel to which points give up to ten times its mass, and where a modulus in kPa lies below.
constexpr Band carrying_speed_m_s{750.0, 6500.0};
constexpr double slowest_carrying_m_s = 400.0;
constexpr double heavy_kg_m3 = 2200.0;           ///< concrete and metals; soil and rubber, which are slow, lie below
constexpr double longest_structure_m = 10000.0;  ///< one model; the longest bridges have spans of 2 km
constexpr double long_structure_m = 500.0;       ///< from here on members are looked at
constexpr double slenderest_member = 2000.0;     ///< [-] median of element length over depth; a cable in few pieces has 1000
constexpr Band structure_Hz{0.01, 10000.0};      ///< first mode: the longest suspension bridges have 0.03 to 0.05 Hz
/// Tungsten, the densest structural material, lies below. A larger number is a weight per volume, or kilograms among tonnes.
constexpr double densest_kg_m3 = 23000.0;
/// What is denser than lead is faster than gold, with 2000 m/s. A slower one has a weight per volume.
constexpr double denser_than_lead_kg_m3 = 12000.0, slower_than_gold_m_s = 1900.0;
/// Timber weighs 3.4 to 9.8 kN/m3 and has a modulus of 7 to 20 GPa; lead, which is as slow with that density, weighs more.
constexpr Band timber_weight_N_m3{3400.0, 9810.0};
constexpr Band timber_modulus_Pa{7e9, 20e9};

/// Another unit for a number, with what it multiplies the number by.
struct OtherUnit {
  double factor;
  const char* name;
};

std::optional<std::string> density_slip(const fe::Material& m, double speed) {
  for (const OtherUnit& unit : {OtherUnit{1e3, "t/m3"}, OtherUnit{1000.0 / 9.81, "kN/m3, a weight"}, OtherUnit{1e12, "t/mm3"},
                                OtherUnit{1e9, "kg/mm3"}}) {
    const double density = m.density_kg_m3 * unit.factor;
    const double modulus = unit.factor >= 1e9 && m.youngs_modulus_Pa < 1e7 ? 1e6 : 1.0;  // N, mm and t go together
    if (!Band{300.0, 23000.0}.holds(density)) continue;
    if (!usual_speed_m_s.holds(speed * std::sqrt(modulus / unit.factor))) continue;
    return fmt::format(
        "material '{}' has a density of {:g} kg/m3, so that waves run at {:.3g} m/s in it; steel has 5200, concrete "
        "3500: is the density in {}? {}",
        m.name, m.density_kg_m3, speed, unit.name,
        modulus == 1.0        ? "Give kg/m3"
        : unit.factor == 1e12 ? "Frequencies hold in N, mm and t; for lengths and masses write the model in N, m and kg"
                              : "With E in N/mm2 it is t/mm3: divide it by 1000, or write the model in N, m and kg");
  }
  return std::nullopt;
}

/// Density and speed of waves of the materials that structures are made of.
struct KnownMaterial {
  double density_kg_m3, speed_m_s;
};
constexpr std::array<KnownMaterial, 7> known_materials = {{{7850.0, 5170.0},
                                                           {2450.0, 3600.0},
                                                           {2700.0, 5080.0},
                                                           {480.0, 4800.0},
                                                           {750.0, 4200.0},
                                                           {1900.0, 1500.0},
                                                           {1900.0, 900.0}}};
constexpr std::size_t known_in_systems = 4;   ///< in kN and m, hardwood and masonry have the numbers of foams in SI units
constexpr double densest_foam_kg_m3 = 300.0;  ///< no structure is of foam alone

constexpr double alike_in_system = 0.25;  ///< [-] of ln; foams, which have such numbers in SI units, are 0.4 off

/// [-] of ln: least distance to a known material in density and speed together.
double off_known(double density_kg_m3, double speed_m_s, std::size_t among = known_in_systems) {
  double least = std::numeric_limits<double>::infinity();
  for (const KnownMaterial& known : std::span(known_materials).first(among))
    least = std::min(least, std::hypot(std::log(density_kg_m3 / known.density_kg_m3), std::log(speed_m_s / known.speed_m_s)));
  return least;
}

/// @param speed  of waves [m/s]: of the material, or of the structure's mean density where all its mass is in points
/// @param plausible  [m/s] what a mended unit has to lead to
std::optional<std::string> modulus_slip(const fe::Material& m, double density_kg_m3, double speed, const Band& plausible) {
  for (const OtherUnit& unit :
       {OtherUnit{1e6, "in MPa (N/mm2)"}, OtherUnit{1e9, "in GPa"}, OtherUnit{1e3, "in kPa, or in MPa in a model in kN and m"},
        OtherUnit{1e-3, "in Pa in a model in kN and m"}, OtherUnit{1e-6, "in Pa in a model in N and mm"}}) {
    const double mended = speed * std::sqrt(unit.factor);
    if (!plausible.holds(mended)) continue;
    // Soft soil is near metals in kPa, and rigid parts are a round number of times as stiff as steel.
    const bool timber =
        timber_weight_N_m3.holds(gravity_m_s2 * density_kg_m3) && timber_modulus_Pa.holds(unit.factor * m.youngs_modulus_Pa);
    const bool metal = usual_speed_m_s.holds(mended) && density_kg_m3 >= heavy_kg_m3;
    if (m.density_kg_m3 > 0.0 && unit.factor == 1e3 && !metal && !timber) continue;
    if (m.density_kg_m3 > 0.0 && unit.factor < 1.0 && !timber && off_known(density_kg_m3, mended) > alike_in_system) continue;
    const bool own = m.density_kg_m3 > 0.0, soft = unit.factor > 1.0;
    return fmt::format(
        "material '{}' has E = {:g} Pa, so that waves run at {:.3g} m/s in it{}; steel has 5200, concrete 3500: is E {}{}? {}",
        m.name, m.youngs_modulus_Pa, speed, own ? "" : " with the mass of the points", unit.name,
        own || soft ? "" : ", or are the masses in tonnes",
        soft  ? "Give pascals"
        : own ? "Give it in the model's units; a part that is meant to be rigid may keep it"
              : "Give both in the model's units");
  }
  return std::nullopt;
}

/// A unit in which a density may have been given by mistake: weight per volume, or another unit of mass.
struct WeightUnit {
  double density_kg_m3;                    ///< of one of it
  const char* name;                        ///< "lbf/in3"
  double modulus_Pa = 1.0;                 ///< of one unit of stress in a system without a unit of mass of its own
  const char *system = "", *divisor = "";  ///< its name, "" among numbers in SI units; "": a mass, not a weight
};
/// Among SI numbers first; then those of the systems.
constexpr std::array<WeightUnit, 17> weight_units = {
    {{1.0 / gravity_m_s2, "a weight in N/m3 (divide by 9.81)"},
     {1.0 / gravity_in_s2, "a weight in lbf/in3 (is PARAM,WTMASS,.00259 missing?)"},
     {1.0 / gravity_ft_s2, "a weight in lbf/ft3 or kip/ft3 (divide by 32.174)"},
     {1e-3 / gravity_m_s2, "a weight in N/mm3 (divide by 9810)"},
     {1e-3, "in kg where the other units ask for tonnes"},
     {27679.9, "lbf/in3", 6894.757, "lbf and in", "386.09"},
     {16018.46, "kip/ft3", 47880.26, "kip and ft", "32.174"},
     {1e6, "kgf/cm3", 98066.5, "kgf and cm", "980.665"},
     {1e3, "tonf/m3", 9806.65, "tonf and m", "9.80665"},
     {1e3 / gravity_m_s2, "kN/m3", 1e3, "kN and m", "9.80665"},
     {1e9 / gravity_m_s2, "N/mm3", 1e6, "N and mm", "9806.65"},
     {1e3, "t/m3", 1e3, "kN and m"},
     {1.06869e7, "lbf s2/in4", 6894.757, "lbf and in"},
     {1.06869e10, "kip s2/in4", 6894757.0, "kip and in"},
     {515.379, "slug/ft3", 47.88026, "lbf and ft"},
     {515379.0, "kip s2/ft4", 47880.26, "kip and ft"},
     {1e-3, "kg/m3", 1e-3, "N and m"}}};

/// A density that is a weight per volume, or in another unit of mass: in kg/m3 the material is like a known one.
/// @param foams  all materials of the model would be foams in SI units
std::optional<std::string> weight_slip(const fe::Material& m, double speed, bool foams) {
  const bool timber = timber_weight_N_m3.holds(m.density_kg_m3) && timber_modulus_Pa.holds(m.youngs_modulus_Pa);
  const bool slow = m.density_kg_m3 > denser_than_lead_kg_m3 && speed < slower_than_gold_m_s;
  const bool heavy = m.density_kg_m3 >= densest_kg_m3 || slow || timber;
  const WeightUnit* best = nullptr;
  double nearest = 0.4;  // kinds of one material; concrete with all its deck's mass is 0.5 off, divided by 9.81
  for (const WeightUnit& unit : weight_units) {
    const double density = m.density_kg_m3 * unit.density_kg_m3;
    const bool among_si = *unit.system == '\0';
    const double off = off_known(density, std::sqrt(m.youngs_modulus_Pa * unit.modulus_Pa / density),
                                 among_si || foams ? known_materials.size() : known_in_systems);
    if (among_si ? heavy && off < nearest : best == nullptr && off <= alike_in_system) nearest = off, best = &unit;
  }
  if (best == nullptr) return std::nullopt;
  if (*best->system != '\0' && *best->divisor == '\0')
    return fmt::format(
        "material '{}' has E = {:.4g} Pa and a density of {:.4g} kg/m3: are the numbers in {}, with densities in {}? "
        "Frequencies hold; for masses and forces give them in the model's units",
        m.name, m.youngs_modulus_Pa, m.density_kg_m3, best->system, best->name);
  if (*best->system != '\0')
    return fmt::format(
        "material '{}' has E = {:.4g} and a density of {:.4g}: is the density a weight in {}, among numbers in {}? Divide it "
        "by "
        "{}",
        m.name, m.youngs_modulus_Pa, m.density_kg_m3, best->name, best->system, best->divisor);
  return fmt::format(
      "material '{}' has a density of {:.3g} kg/m3, so that waves run at {:.3g} m/s in it; steel has 7850 kg/m3 and 5200 m/s, "
      "concrete 2500 and 3500: is the density {}? Give kg/m3",
      m.name, m.density_kg_m3, speed, best->name);
}

/// Volume of bars and beams with their own and the points' mass; nothing for a model with solids or shells, where masses lie on
/// what is not drawn.
struct Drawn {
  double volume_m3 = 0.0, own_kg = 0.0, points_kg = 0.0, length_m = 0.0;
  [[nodiscard]] double density_kg_m3() const { return (own_kg + points_kg) / volume_m3; }
};

std::optional<Drawn> drawn(const fe::Model& model) {
  Drawn all;
  for (const fe::Element& e : model.elements) {
    const auto at = [&](std::size_t i) { return model.nodes[static_cast<std::size_t>(e.nodes[i])].x_m; };
    if (e.type == fe::ElementType::solid || e.type == fe::ElementType::shell) return std::nullopt;
    const double length = (at(1) - at(0)).norm(), area = model.sections[static_cast<std::size_t>(e.section)].area_m2;
    all.length_m += length;
    all.volume_m3 += length * area;
    all.own_kg += length * area * model.materials[static_cast<std::size_t>(e.material)].density_kg_m3;
  }
  for (const fe::PointMass& mass : model.masses) all.points_kg += mass.mass_kg;
  return all.volume_m3 > 0.0 ? std::optional(all) : std::nullopt;
}

/// Mean density of the structure: all mass that is in it over the volume of its elements.
std::optional<std::string> mean_density_slip(const Drawn& all) {
  // A steel girder that carries its deck as masses has up to ten times its own mass; as weights they have a hundred times it.
  constexpr double most_of_steel = 40.0, steel_kg_m3 = 7850.0;
  if (all.points_kg < all.own_kg || all.density_kg_m3() < most_of_steel * steel_kg_m3) return std::nullopt;
  const double mass_kg = all.own_kg + all.points_kg;
  return fmt::format(
      "the mass of {:.4g} kg ({:.4g} kg per metre of its members) is a mean density of {:.3g} kg/m3 of what is drawn; steel "
      "has "
      "7850: are the masses weights in newtons? Give kilograms; in a deck in N and mm, tonnes",
      mass_kg, mass_kg / all.length_m, all.density_kg_m3());
}

/// @param all  nothing where the volume is not known
std::optional<std::string> material_slip(const fe::Material& m, const std::optional<Drawn>& all, bool foams) {
  if (!(m.density_kg_m3 > 0.0)) {
    // A part without mass may be as stiff as one likes, unless no part has any: then it is the structure.
    if (!all || all->own_kg > 0.0 || !(all->points_kg > 0.0)) return std::nullopt;
    const double carried_m_s = std::sqrt(m.youngs_modulus_Pa / all->density_kg_m3());
    const bool usual = carried_m_s > slowest_carrying_m_s && carried_m_s < material_speed_m_s.high;
    return usual ? std::nullopt : modulus_slip(m, all->density_kg_m3(), carried_m_s, carrying_speed_m_s);
  }
  const double speed = std::sqrt(m.youngs_modulus_Pa / m.density_kg_m3);
  if (const auto weight = weight_slip(m, speed, foams))
    return weight;  // E in kPa would explain the speed too, but not the density
  if (speed < usual_speed_m_s.low) return modulus_slip(m, m.density_kg_m3, speed, material_speed_m_s);
  if (speed <= material_speed_m_s.high) return std::nullopt;
  if (const auto density = density_slip(m, speed)) return density;
  return modulus_slip(m, m.density_kg_m3, speed, material_speed_m_s);
}

double span_of(const fe::Model& model) {
  Eigen::Vector3d low = model.nodes.front().x_m, high = low;
  for (const fe::Node& node : model.nodes) {
    low = low.cwiseMin(node.x_m);
    high = high.cwiseMax(node.x_m);
  }
  return (high - low).norm();
}

/// Length over depth of beams and shells (a depth is that of a rectangle of the same radius of gyration), unsorted.
std::vector<double> slenderness_of(const fe::Model& model) {
  std::vector<double> all;
  for (const fe::Element& e : model.elements) {
    if (e.type != fe::ElementType::beam && e.type != fe::ElementType::shell) continue;
    const fe::Section& s = model.sections[static_cast<std::size_t>(e.section)];
    const double depth = e.type == fe::ElementType::shell
                             ? s.thickness_m
                             : std::sqrt(12.0 * std::max(s.inertia_y_m4, s.inertia_z_m4) / s.area_m2);
    const auto at = [&](std::size_t i) { return model.nodes[static_cast<std::size_t>(e.nodes[i])].x_m; };
    if (depth > 0.0) all.push_back((at(1) - at(0)).norm() / depth);
  }
  return all;
}

std::optional<std::string> length_slip(const fe::Model& model) {
  const double span = span_of(model);
  const std::vector<double> slenderness = slenderness_of(model);
  const double middle = slenderness.empty() ? 0.0 : upper_median(slenderness);
  if (span > longest_structure_m || (span > long_structure_m && middle > slenderest_member))
    return fmt::format("the structure spans {:.4g} m{}: are the coordinates in mm? Give metres", span,
                       middle > 0.0
                           ? fmt::format(", and half of its elements are {:.3g} and more times as long as deep", middle)
                           : std::string());
  return std::nullopt;
}

std::optional<std::string> section_slip(const fe::Model& model) {
  const double span = span_of(model);
  for (const fe::Element& e : model.elements) {
    if (e.type == fe::ElementType::solid) continue;
    const fe::Section& s = model.sections[static_cast<std::size_t>(e.section)];
    const double size = e.type == fe::ElementType::shell ? s.thickness_m : std::sqrt(s.area_m2);
    if (!(size > span)) continue;
    return fmt::format(
        "section '{}' is {:.3g} m across, more than the whole structure ({:.3g} m): is it in mm or cm? Give "
        "m, m2 and m4",
        s.name, size, span);
  }
  return std::nullopt;
}

/// Translating mass: the part of M that moves with a unit displacement along x, y and z, a third of their sum.
double moving_mass(const LoadedModel& loaded) {
  const linalg::SparseMatrix mass = loaded.system.mass(loaded.theta);
  double sum = 0.0;
  for (int direction = 0; direction < 3; ++direction) {
    Eigen::VectorXd unit(mass.rows());
    for (Index i = 0; i < unit.size(); ++i)
      unit[i] = loaded.system.dofs[static_cast<std::size_t>(i)].direction == direction ? 1.0 : 0.0;
    sum += unit.dot(mass.selfadjointView<Eigen::Lower>() * unit);
  }
  return sum / 3.0;
}

}  // namespace

std::vector<std::string> unit_slips(const fe::Model& model) {
  std::vector<std::string> slips;
  if (model.nodes.empty()) return slips;
  const std::optional<Drawn> all = drawn(model);
  std::set<int> used;
  for (const fe::Element& e : model.elements) used.insert(e.material);
  const bool foams = std::ranges::all_of(
      used, [&](int at) { return model.materials[static_cast<std::size_t>(at)].density_kg_m3 < densest_foam_kg_m3; });
  for (const int at : used) {
    const fe::Material& m = model.materials[static_cast<std::size_t>(at)];
    if (const auto slip = material_slip(m, all, foams)) slips.push_back(*slip);
  }
  if (const auto slip = all ? mean_density_slip(*all) : std::nullopt) slips.push_back(*slip);
  if (const auto slip = length_slip(model)) slips.push_back(*slip);
  if (const auto slip = section_slip(model)) slips.push_back(*slip);
  return slips;
}

std::vector<std::string> frequency_slips(const Eigen::VectorXd& computed_Hz, double mass_kg, double span_m) {
  const Index at = first_elastic(computed_Hz);
  if (at == computed_Hz.size() || structure_Hz.holds(computed_Hz[at])) return {};
  const bool slow = computed_Hz[at] < structure_Hz.low;
  return {fmt::format("the first mode is computed at {:.3g} Hz ({:.4g} kg move{}), {} than any structure: {}", computed_Hz[at],
                      mass_kg, span_m > 0.0 ? fmt::format(", span {:.4g} m", span_m) : std::string(),
                      slow ? "slower" : "faster",
                      slow ? "look for a modulus in MPa, coordinates in mm, a stiffness in kN/m or a mass in grams"
                           : "look for a mass in tonnes, a density in t/m3, or sections in mm")};
}

bool warn_of_unit_slips(Reporter& reporter, const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                        const std::vector<MeasuredFrequencies>& measured) {
  std::vector<std::string> slips;
  if (loaded.model) {
    slips = unit_slips(*loaded.model);
    for (const std::string& doubt : doubtful_mesh(*loaded.model)) reporter.warn(doubt);
  }
  for (const std::string& slip : frequency_slips(computed_Hz, moving_mass(loaded), loaded.model ? span_of(*loaded.model) : 0.0))
    slips.push_back(slip);
  const bool doubted = !slips.empty();
  const Eigen::VectorXd compared_Hz = !doubted ? computed_Hz : Eigen::VectorXd();
  for (const MeasuredFrequencies& condition : measured)
    for (const std::string& slip : measured_slips(condition, compared_Hz)) slips.push_back(slip);
  for (const std::string& slip : slips) reporter.warn(slip);
  return doubted;
}

void judge_units(Reporter& reporter, const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                 const std::vector<MeasuredFrequencies>& measured, FactorWithinBounds within_bounds) {
  const bool doubted = warn_of_unit_slips(reporter, loaded, computed_Hz, measured);
  refuse_one_factor(loaded, computed_Hz, measured, within_bounds, doubted);
}

}  // namespace twindeck::dynamics
