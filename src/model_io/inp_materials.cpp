#include "model_io/inp_materials.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>

#include "core/error.hpp"

namespace twindeck::model_io {
namespace {

/// *ELASTIC and *DENSITY belong to the last *MATERIAL.
fe::Material& current(InpParts& parts, const InpCard& card) {
  if (parts.model.materials.empty()) parts.file.fail(card, card.line, "stands before any *MATERIAL", "move it below one");
  return parts.model.materials.back();
}

const InpLine& one_line(InpParts& parts, const InpCard& card, const char* what) {
  if (card.data.empty()) parts.file.fail(card, card.line, "has no data line", fmt::format("give {} below it", what));
  if (card.data.size() > 1) {
    parts.file.fail(card, card.data[1].line, "has more than one data line: values that depend on temperature are not supported",
                    fmt::format("give {} at one temperature", what));
  }
  return card.data.front();
}

/// The material of a beam as our own CalculiX files have it (inp_expanded_beam.hpp): one E, no Poisson's ratio, G12 and G13.
void read_beam_constants(InpParts& parts, const InpCard& card, fe::Material& material) {
  if (card.data.size() != 2) {
    parts.file.fail(card, card.line, fmt::format("has {} data lines, expected 2", card.data.size()),
                    "give E1, E2, E3, nu12, nu13, nu23, G12, G13 on the first and G23 on the second");
  }
  std::array<double, 9> constants{};
  for (std::size_t i = 0; i < 8; ++i) constants[i] = parts.file.number(card, card.data[0], i);
  constants[8] = parts.file.number(card, card.data[1], 0);
  const bool one_modulus = constants[0] > 0.0 && constants[1] == constants[0] && constants[2] == constants[0];
  if (!one_modulus || constants[3] != 0.0 || constants[4] != 0.0 || constants[5] != 0.0) {
    parts.file.fail(card, card.data[0].line, "is orthotropic with several E or Poisson's ratios, which is not supported",
                    "give E and nu of an isotropic material");
  }
  for (std::size_t i = 6; i < 9; ++i) {
    if (constants[i] <= 0.0)
      parts.file.fail(card, card.data[i / 8].line, "a shear modulus is not above 0", "give G12, G13, G23 in Pa");
  }
  material.youngs_modulus_Pa = constants[0];
  material.poisson_ratio = 0.0;
  material.shear_modulus_Pa = constants[6];
  parts.second_shear_moduli[static_cast<int>(parts.model.materials.size()) - 1] = constants[7];
}

}  // namespace

void read_inp_material(InpParts& parts, const InpCard& card) {
  const std::string name = parts.file.required(card, "NAME");
  if (!parts.materials.emplace(upper_case(name), static_cast<int>(parts.model.materials.size())).second) {
    parts.file.fail(card, card.line, fmt::format("material '{}' is defined twice", name), "keep one of the two");
  }
  fe::Material material;
  material.name = name;
  parts.model.materials.push_back(material);
}

void read_inp_elastic(InpParts& parts, const InpCard& card) {
  fe::Material& material = current(parts, card);
  parts.file.allow(card, {"TYPE"});
  const std::string type = upper_case(card.get("TYPE", "ISOTROPIC"));
  if (type == "ENGINEERING CONSTANTS") return read_beam_constants(parts, card, material);
  if (type != "ISOTROPIC" && type != "ISO") {
    parts.file.fail(card, card.line, fmt::format("TYPE={} is not supported, expected ISOTROPIC", type),
                    "the members of a frame or deck are isotropic here; give E and nu");
  }
  parts.second_shear_moduli.erase(static_cast<int>(parts.model.materials.size()) - 1);
  const InpLine& line = one_line(parts, card, "E and nu");
  material.youngs_modulus_Pa = parts.file.number(card, line, 0);
  material.poisson_ratio = parts.file.number_or(card, line, 1, 0.0);
  if (material.youngs_modulus_Pa <= 0.0) parts.file.fail(card, line.line, "E must be above 0", "give E in Pa, and nu");
  if (material.poisson_ratio <= -1.0 || material.poisson_ratio >= 0.5) {
    parts.file.fail(card, line.line, "nu must lie in ]-1, 0.5[", "steel has 0.3, concrete 0.2");
  }
  material.shear_modulus_Pa = material.youngs_modulus_Pa / (2.0 * (1.0 + material.poisson_ratio));
}

void read_inp_density(InpParts& parts, const InpCard& card) {
  fe::Material& material = current(parts, card);
  const InpLine& line = one_line(parts, card, "the density");
  material.density_kg_m3 = parts.file.number(card, line, 0);
  if (material.density_kg_m3 < 0.0) parts.file.fail(card, line.line, "the density must not be negative", "give it in kg/m3");
}

void read_inp_orientation(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"NAME", "SYSTEM", "DEFINITION"});
  const std::string definition = upper_case(card.get("DEFINITION", "COORDINATES"));
  if (upper_case(card.get("SYSTEM", "RECTANGULAR")) != "RECTANGULAR" || (definition != "COORDINATES" && definition != "NODES"))
    parts.file.fail(card, card.line, "only SYSTEM=RECTANGULAR by coordinates or nodes is supported", "give the points a and b");
  if (card.data.empty()) parts.file.fail(card, card.line, "has no data line", "give the points a and b");
  Eigen::Vector3d a, b;
  if (definition == "NODES") {
    const auto place = [&](std::size_t field) {
      return parts.model
          .nodes[static_cast<std::size_t>(parts.node(card, card.data[0].line, parts.node_id(card, card.data[0], field)))]
          .x_m;
    };
    const bool has_origin = card.data[0].fields.size() > 2 && !card.data[0].fields[2].empty();
    const Eigen::Vector3d origin = has_origin ? place(2) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    a = place(0) - origin;
    b = place(1) - origin;
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      a[static_cast<int>(i)] = parts.file.number(card, card.data[0], i);
      b[static_cast<int>(i)] = parts.file.number(card, card.data[0], i + 3);
    }
  }
  const Eigen::Vector3d z = a.cross(b);
  if (z.norm() < 1e-9 * a.norm() * b.norm() || a.norm() == 0.0) {
    parts.file.fail(card, card.data[0].line, "points a and b lie in one direction", "b gives the x'-y' plane");
  }
  InpOrientation axes;
  axes.row(0) = a.normalized();
  axes.row(2) = z.normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  const InpScope& scope = parts.scopes[static_cast<std::size_t>(parts.scope)];
  // Nodes are turned with their instance already.
  if (scope.turned() && definition == "COORDINATES") axes = (axes * scope.rotation.transpose()).eval();
  parts.orientations[parts.key_here(parts.file.required(card, "NAME"))] = axes;
}

}  // namespace twindeck::model_io
