#include "model_io/spread_mass.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/lists.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::model_io {
namespace {

/// Volume of an element: its mass at density 1.
double volume_of(fe::Model& model, fe::Element element) {
  fe::Material unit = model.materials[fe::slot(element.material)];
  unit.density_kg_m3 = 1.0;
  element.material = static_cast<int>(model.materials.size());
  model.materials.push_back(unit);
  const fe::ElementMatrix mass = fe::element_mass(model, element);
  model.materials.pop_back();
  double volume = 0.0;
  for (std::size_t i = 0; i < mass.dofs.size(); ++i)
    for (std::size_t j = 0; j < mass.dofs.size(); ++j)
      if (mass.dofs[i] % 6 == 0 && mass.dofs[j] % 6 == 0)
        volume += mass.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return volume;
}

/// Volume, area or length of an element; 0 where it has none.
double extent_of(const fe::Model& model, const fe::Element& e, MassPer per, double volume) {
  if (per == MassPer::volume) return volume;
  if (per == MassPer::area)
    return e.type == fe::ElementType::shell ? volume / model.sections[fe::slot(e.section)].thickness_m : 0.0;
  if (e.type != fe::ElementType::beam && e.type != fe::ElementType::bar) return 0.0;
  return (model.nodes[fe::slot(e.nodes[1])].x_m + e.offset_m[1] - model.nodes[fe::slot(e.nodes[0])].x_m - e.offset_m[0]).norm();
}

}  // namespace

void spread_mass(DeckModel& deck, const DeckPlace& at, const std::vector<long>& ids, const SpreadMass& mass) {
  fe::Model& model = deck.model;
  struct Piece {
    fe::Element* element;
    double volume, extent;
  };
  std::vector<Piece> spread;
  double extent = 0.0, own_mass = 0.0;
  std::map<long, std::size_t> position;
  for (std::size_t i = 0; i < model.elements.size(); ++i) position.emplace(model.elements[i].id, i);
  for (const long id : ids) {
    const auto first = position.find(id);
    const std::size_t count = first == position.end() ? 0 : deck.pieces.contains(id) ? deck.pieces.at(id) : 1;
    for (std::size_t i = 0; i < count; ++i) {
      fe::Element& e = model.elements[first->second + i];
      const double volume = volume_of(model, e);
      spread.push_back({&e, volume, extent_of(model, e, mass.per, volume)});
      if (!(spread.back().extent > 0.0))
        at.fail(fmt::format("is a mass per {}, and element {} has none", mass.per == MassPer::area ? "area" : "length", id),
                "give beams and bars a mass per length, shells one per area");
      extent += spread.back().extent;
      own_mass += volume * model.materials[fe::slot(e.material)].density_kg_m3;
    }
  }
  if (spread.empty()) at.fail("names no member, shell or solid", "name elements that have a section");
  if (mass.value < 0.0) at.fail(fmt::format("the mass is {:g}, expected 0 or more", mass.value), "check the sign");
  if (mass.as_density && !(own_mass > 0.0))
    at.fail("is spread in shares of the elements' masses, and they have none", "give their material a density");
  std::map<std::pair<int, double>, int> copies;
  double sum = 0.0;
  for (const Piece& piece : spread) {
    const int of = piece.element->material;
    const double own = model.materials[fe::slot(of)].density_kg_m3,
                 added = mass.as_density ? own * mass.value / own_mass
                                         : mass.value * piece.extent / piece.volume / (mass.total ? extent : 1.0);
    sum += added * piece.volume;
    const auto [copy, is_new] = copies.try_emplace({of, added}, static_cast<int>(model.materials.size()));
    piece.element->material = copy->second;
    if (!is_new) continue;
    fe::Material m = model.materials[fe::slot(of)];
    m.density_kg_m3 += added;
    const std::string name = m.name + "_" + mass.owner;
    m.name = name;
    for (int k = 2; contains(each_of(model.materials, &fe::Material::name), m.name); ++k)
      m.name = fmt::format("{}_{}", name, k);
    model.materials.push_back(m);
    if (const auto expands = deck.expansion.find(of); expands != deck.expansion.end())
      deck.expansion[copy->second] = Expansion(expands->second);
  }
  const bool members = std::ranges::any_of(spread, [](const Piece& p) { return p.element->type == fe::ElementType::beam; });
  deck.notes.push_back(fmt::format(
      "{} in line {}: a mass of {:.6g} in the deck's units is spread over {} elements, as density of {} materials *_{}{}",
      at.label, at.line, sum, spread.size(), copies.size(), mass.owner,
      members ? "; it turns with the members, which lowers torsional frequencies: masses at the nodes do not" : ""));
}

}  // namespace twindeck::model_io
