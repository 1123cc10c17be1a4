#include "model_io/inp_materials.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>

#include "core/error.hpp"

namespace twindeck::model_io {
namespace {

/// *ELASTIC and *DENSITY belong to the last *MATERIAL.
fe::Material& current(InpParts& parts, const InpCard& card) {
  if (parts.model.materials.empty()) card.fail("stands before any *MATERIAL", "move it below one");
  return parts.model.materials.back();
}

const InpLine& one_line(const InpCard& card, const char* what) {
  if (card.data.empty()) card.fail("has no data line", fmt::format("give {} below it", what));
  if (card.data.size() > 1) {
    card.data[1].fail("has more than one data line: values that depend on temperature are not supported",
                      fmt::format("give {} at one temperature", what));
  }
  return card.data.front();
}

/// The material of a beam as our own CalculiX files have it (inp_expanded_beam.hpp): one E, no Poisson's ratio, G12 and G13.
void read_beam_constants(InpParts& parts, const InpCard& card, fe::Material& material) {
  if (card.data.size() != 2) {
    card.fail(fmt::format("has {} data lines, expected 2", card.data.size()),
              "give E1, E2, E3, nu12, nu13, nu23, G12, G13 on the first and G23 on the second");
  }
  std::array<double, 9> constants{};
  for (std::size_t i = 0; i < 8; ++i) constants[i] = card.data[0].number(i);
  constants[8] = card.data[1].number(0);
  const bool one_modulus = constants[0] > 0.0 && constants[1] == constants[0] && constants[2] == constants[0];
  if (!one_modulus || constants[3] != 0.0 || constants[4] != 0.0 || constants[5] != 0.0) {
    card.data[0].fail("is orthotropic with several E or Poisson's ratios, which is not supported",
                      "give E and nu of an isotropic material");
  }
  for (std::size_t i = 6; i < 9; ++i) {
    if (constants[i] <= 0.0) card.data[i / 8].fail("a shear modulus is not above 0", "give G12, G13, G23 in Pa");
  }
  material.youngs_modulus_Pa = constants[0];
  material.poisson_ratio = 0.0;
  material.shear_modulus_Pa = constants[6];
  parts.second_shear_moduli[static_cast<int>(parts.model.materials.size()) - 1] = constants[7];
}

}  // namespace

void read_inp_material(InpParts& parts, const InpCard& card) {
  const std::string name = card.required("NAME");
  if (!parts.materials.emplace(upper_case(name), static_cast<int>(parts.model.materials.size())).second) {
    card.fail(fmt::format("material '{}' is defined twice", name), "keep one of the two");
  }
  fe::Material material;
  material.name = name;
  parts.model.materials.push_back(material);
}

void read_inp_elastic(InpParts& parts, const InpCard& card) {
  fe::Material& material = current(parts, card);
  card.allow({"TYPE"});
  const std::string type = upper_case(card.get("TYPE", "ISOTROPIC"));
  if (type == "ENGINEERING CONSTANTS") return read_beam_constants(parts, card, material);
  if (type != "ISOTROPIC" && type != "ISO") {
    card.fail(fmt::format("TYPE={} is not supported, expected ISOTROPIC", type),
              "the members of a frame or deck are isotropic here; give E and nu");
  }
  parts.second_shear_moduli.erase(static_cast<int>(parts.model.materials.size()) - 1);
  const InpLine& line = one_line(card, "E and nu");
  material.youngs_modulus_Pa = line.number(0);
  material.poisson_ratio = line.number_or(1, 0.0);
  if (material.youngs_modulus_Pa <= 0.0) line.fail("E must be above 0", "give E in Pa, and nu");
  DeckModel::check_poisson_ratio(line, material.poisson_ratio);
  material.shear_modulus_Pa = material.youngs_modulus_Pa / (2.0 * (1.0 + material.poisson_ratio));
}

void read_inp_density(InpParts& parts, const InpCard& card) {
  fe::Material& material = current(parts, card);
  const InpLine& line = one_line(card, "the density");
  material.density_kg_m3 = line.number(0);
  if (material.density_kg_m3 < 0.0) line.fail("the density must not be negative", "give it in kg/m3");
}

void read_inp_orientation(InpParts& parts, const InpCard& card) {
  card.allow({"NAME", "SYSTEM", "DEFINITION"});
  const std::string definition = upper_case(card.get("DEFINITION", "COORDINATES"));
  if (upper_case(card.get("SYSTEM", "RECTANGULAR")) != "RECTANGULAR" || (definition != "COORDINATES" && definition != "NODES"))
    card.fail("only SYSTEM=RECTANGULAR by coordinates or nodes is supported", "give the points a and b");
  if (card.data.empty()) card.fail("has no data line", "give the points a and b");
  Eigen::Vector3d a, b;
  if (definition == "NODES") {
    const auto place = [&](std::size_t field) { return parts.place(parts.node(card, parts.node_id(card.data[0], field))); };
    const Eigen::Vector3d origin = !card.data[0].blank(2) ? place(2) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    a = place(0) - origin;
    b = place(1) - origin;
  } else {
    (void)card.data[0].number(5);
    a = card.data[0].vector(0);
    b = card.data[0].vector(3);
  }
  const Eigen::Vector3d z = a.cross(b);
  if (z.norm() < 1e-9 * a.norm() * b.norm() || a.norm() == 0.0) {
    card.data[0].fail("points a and b lie in one direction", "b gives the x'-y' plane");
  }
  InpOrientation axes;
  axes.row(0) = a.normalized();
  axes.row(2) = z.normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  const InpScope& scope = parts.scopes[static_cast<std::size_t>(parts.scope)];
  // Nodes are turned with their instance already.
  if (scope.turned() && definition == "COORDINATES") axes = (axes * scope.rotation.transpose()).eval();
  parts.orientations[parts.key_here(card.required("NAME"))] = axes;
}

}  // namespace twindeck::model_io
