#include "ponte/member_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ponte/definition_file.hpp"

namespace twindeck::ponte {

namespace {

fe::Section round_section(const std::string& name, double outer_m, double inner_m, double shear_factor) {
  fe::Section out;
  out.name = name;
  out.area_m2 = std::numbers::pi / 4 * (std::pow(outer_m, 2) - std::pow(inner_m, 2));
  out.inertia_y_m4 = out.inertia_z_m4 = std::numbers::pi / 64 * (std::pow(outer_m, 4) - std::pow(inner_m, 4));
  out.torsion_m4 = 2 * out.inertia_y_m4;
  out.shear_area_y_m2 = out.shear_area_z_m2 = shear_factor * out.area_m2;
  return out;
}

void check_wall(DefinitionFile& file, const std::string& path, double width_m, double wall_m) {
  if (2 * wall_m >= width_m) {
    file.fail(path + ".wall", fmt::format("is {:g} m, expected less than half the width ({:g} m)", wall_m, width_m / 2),
              "correct the wall or the width");
  }
}

/// Square hollow section of sharp corners: A = b² - (b-2t)², I = (b⁴ - (b-2t)⁴)/12, J = t (b-t)³ (Bredt), shear areas A/2 (two
/// of four walls).
fe::Section square_hollow_section(const std::string& name, double side_m, double wall_m) {
  const double inner = side_m - 2 * wall_m;
  fe::Section out;
  out.name = name;
  out.area_m2 = side_m * side_m - inner * inner;
  out.inertia_y_m4 = out.inertia_z_m4 = (std::pow(side_m, 4) - std::pow(inner, 4)) / 12;
  out.torsion_m4 = wall_m * std::pow(side_m - wall_m, 3);
  out.shear_area_y_m2 = out.shear_area_z_m2 = 0.5 * out.area_m2;
  return out;
}

}  // namespace

fe::Section tube_section(const std::string& name, double diameter_m, double wall_m) {
  return round_section(name, diameter_m, diameter_m - 2 * wall_m, 0.5);
}

fe::Section solid_circle_section(const std::string& name, double diameter_m) {
  return round_section(name, diameter_m, 0.0, 0.9);
}

fe::Section rectangle_section(const std::string& name, double depth_m, double width_m) {
  const double b = std::max(depth_m, width_m), t = std::min(depth_m, width_m);
  fe::Section out;
  out.name = name;
  out.area_m2 = depth_m * width_m;
  out.inertia_y_m4 = width_m * std::pow(depth_m, 3) / 12;
  out.inertia_z_m4 = depth_m * std::pow(width_m, 3) / 12;
  out.torsion_m4 = b * std::pow(t, 3) * (1.0 / 3 - 0.21 * t / b * (1 - std::pow(t / b, 4) / 12));
  out.shear_area_y_m2 = out.shear_area_z_m2 = out.area_m2 * 5 / 6;
  return out;
}

fe::Section scaled(fe::Section section, double factor) {
  for (double* value : {&section.area_m2, &section.inertia_y_m4, &section.inertia_z_m4, &section.torsion_m4,
                        &section.shear_area_y_m2, &section.shear_area_z_m2}) {
    *value *= factor;
  }
  return section;
}

fe::Section read_member_section(DefinitionFile& file, const std::string& path, const std::string& name) {
  const std::string shape = file.choice(path + ".shape", {"tube", "square_hollow", "rolled"});
  const double scale = file.number(path + ".scale", "", {1e-3, 1e3});
  if (shape == "rolled") {
    fe::Section out;
    out.name = name;
    out.area_m2 = file.number(path + ".area", "m2", {1e-6, 10.0});
    out.inertia_y_m4 = file.number(path + ".inertia_y", "m4", {1e-12, 10.0});
    out.inertia_z_m4 = file.number(path + ".inertia_z", "m4", {1e-12, 10.0});
    out.torsion_m4 = file.number(path + ".torsion", "m4", {1e-12, 10.0});
    out.shear_area_y_m2 = file.number(path + ".shear_area_y", "m2", {0.0, 10.0});
    out.shear_area_z_m2 = file.number(path + ".shear_area_z", "m2", {0.0, 10.0});
    return scaled(out, scale);
  }
  const double width = file.number(path + (shape == "tube" ? ".diameter" : ".side"), "m", {1e-3, 10.0});
  const double wall = file.number(path + ".wall", "m", {1e-4, 5.0});
  check_wall(file, path, width, wall);
  return scaled(shape == "tube" ? tube_section(name, width, wall) : square_hollow_section(name, width, wall), scale);
}

}  // namespace twindeck::ponte
