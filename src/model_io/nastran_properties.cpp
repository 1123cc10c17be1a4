#include "model_io/nastran_properties.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model_io/inp_cards.hpp"

namespace twindeck::model_io::nastran {

std::string property_name(const Card& property) { return lower_case(property.name + "_" + Deck::text(property, 0)); }

const Card& Parts::property(const Card& element, long id, const std::vector<std::string>& kinds) const {
  if (const auto found = properties.find(id); found != properties.end()) {
    for (const Card* card : found->second) {
      if (std::find(kinds.begin(), kinds.end(), card->name) != kinds.end()) return *card;
    }
  }
  deck.fail(element, fmt::format("property {} is no {} of this deck", id, fmt::join(kinds, " or ")),
            "give the property, or mend its number");
}

int Parts::material(const Card& from, long id, double added_density, const std::string& owner) {
  const auto found = materials.find(id);
  if (found == materials.end())
    deck.fail(from, fmt::format("material {} is no MAT1 of this deck", id), "give an isotropic material by MAT1");
  const Card& card = *found->second;
  const std::string name = fmt::format("mat1_{}{}", id, added_density > 0.0 ? "_" + owner : "");
  if (const auto known = material_position.find(name); known != material_position.end()) return known->second;
  fe::Material m;
  m.name = name;
  const double e = deck.number_or(card, 1, 0.0), g = deck.number_or(card, 2, 0.0);
  const bool has_ratio = !Deck::blank(card, 3);
  m.poisson_ratio = deck.number_or(card, 3, 0.0);
  if (!(m.poisson_ratio > -1.0 && m.poisson_ratio < 0.5))
    deck.fail(card, fmt::format("Poisson's ratio is {}, expected a value in ]-1, 0.5[", m.poisson_ratio), "steel has 0.3");
  m.youngs_modulus_Pa = e > 0.0 ? e : 2.0 * (1.0 + m.poisson_ratio) * g;
  if (!(m.youngs_modulus_Pa > 0.0)) deck.fail(card, "has no Young's modulus above 0", "give E in field 3");
  if (e > 0.0 && g > 0.0 && !has_ratio) m.poisson_ratio = std::clamp(e / (2.0 * g) - 1.0, -0.99, 0.499);
  m.shear_modulus_Pa = g > 0.0 ? g : m.youngs_modulus_Pa / (2.0 * (1.0 + m.poisson_ratio));
  m.density_kg_m3 = deck.number_or(card, 4, 0.0) + added_density;
  if (!(m.density_kg_m3 >= 0.0) || added_density < 0.0) deck.fail(card, "a density is negative", "check the sign");
  material_position[name] = static_cast<int>(model.materials.size());
  expansion[material_position[name]] = {deck.number_or(card, 5, 0.0), deck.number_or(card, 6, 0.0)};
  model.materials.push_back(m);
  if (added_density > 0.0)
    notes.push_back(
        fmt::format("{}: its nonstructural mass is spread over the section, as density of material {}", owner, name));
  return material_position[name];
}

int Parts::section(const fe::Section& s) {
  const auto [entry, is_new] = section_position.emplace(s.name, static_cast<int>(model.sections.size()));
  if (is_new) model.sections.push_back(s);
  return entry->second;
}

}  // namespace twindeck::model_io::nastran
