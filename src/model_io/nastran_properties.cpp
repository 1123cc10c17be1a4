#include "model_io/nastran_properties.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace twindeck::model_io::nastran {

std::string property_name(const Card& property) { return lower_case(property.name + "_" + property.text(0)); }

const Card& Parts::property(const DeckPlace& element, long id, const std::vector<std::string>& kinds) const {
  if (const auto found = properties.find(id); found != properties.end()) {
    for (const Card* card : found->second) {
      if (std::find(kinds.begin(), kinds.end(), card->name) != kinds.end()) return *card;
    }
  }
  element.fail(fmt::format("property {} is no {} of this deck", id, fmt::join(kinds, " or ")),
               "give the property, or mend its number");
}

std::pair<long, double> Parts::constant(const Card& card, const std::map<long, double>& of, const char* kind) const {
  const auto found = of.find(card.integer_or(1, card.integer(0)));
  if (found == of.end())
    card.fail(fmt::format("property {} is no {} of this deck", card.integer_or(1, card.integer(0)), kind),
              "give the property, or mend its number");
  return *found;
}

int Parts::material(const DeckPlace& from, long id, double added_density, const std::string& owner) {
  const auto found = materials.find(id);
  if (found == materials.end())
    from.fail(fmt::format("material {} is no MAT1 of this deck", id), "give an isotropic material by MAT1");
  const Card& card = *found->second;
  const std::string name = fmt::format("mat1_{}{}", id, added_density > 0.0 ? "_" + owner : "");
  if (const auto known = material_position.find(name); known != material_position.end()) return known->second;
  fe::Material m;
  m.name = name;
  const double e = card.number_or(1, 0.0), g = card.number_or(2, 0.0);
  const bool has_ratio = !card.blank(3);
  m.poisson_ratio = card.number_or(3, 0.0);
  check_poisson_ratio(card, m.poisson_ratio);
  m.youngs_modulus_Pa = e > 0.0 ? e : 2.0 * (1.0 + m.poisson_ratio) * g;
  if (!(m.youngs_modulus_Pa > 0.0)) card.fail("has no Young's modulus above 0", "give E in field 3");
  if (e > 0.0 && g > 0.0 && !has_ratio) m.poisson_ratio = std::clamp(e / (2.0 * g) - 1.0, -0.99, 0.499);
  m.shear_modulus_Pa = g > 0.0 ? g : m.youngs_modulus_Pa / (2.0 * (1.0 + m.poisson_ratio));
  m.density_kg_m3 = card.number_or(4, 0.0) + added_density;
  if (!(m.density_kg_m3 >= 0.0) || added_density < 0.0) card.fail("a density is negative", "check the sign");
  material_position[name] = static_cast<int>(model.materials.size());
  expansion[material_position[name]] = {card.number_or(5, 0.0), card.number_or(6, 0.0)};
  model.materials.push_back(m);
  if (added_density > 0.0)
    notes.push_back(
        fmt::format("{}: its nonstructural mass is spread over the section, as density of material {}", owner, name));
  return material_position[name];
}

}  // namespace twindeck::model_io::nastran
