#include "model_io/inp_profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace twindeck::model_io {
namespace {

using std::numbers::pi;

bool near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)); }

/// Hollow circle of outer radius r and inner radius m r (Cowper 1966, table 1).
fe::Section pipe(double r, double inner, double nu) {
  fe::Section s;
  const double m2 = inner * inner / (r * r), q = (1.0 + m2) * (1.0 + m2);
  s.area_m2 = pi * (r * r - inner * inner);
  s.inertia_y_m4 = s.inertia_z_m4 = pi / 4.0 * (std::pow(r, 4) - std::pow(inner, 4));
  s.torsion_m4 = 2.0 * s.inertia_y_m4;
  s.shear_area_y_m2 = s.shear_area_z_m2 = s.area_m2 * 6.0 * (1.0 + nu) * q / ((7.0 + 6.0 * nu) * q + (20.0 + 12.0 * nu) * m2);
  return s;
}

fe::Section rectangle(double a, double b, double nu) {
  fe::Section s;
  s.area_m2 = a * b;
  s.inertia_y_m4 = a * b * b * b / 12.0;
  s.inertia_z_m4 = b * a * a * a / 12.0;
  s.torsion_m4 = rectangle_torsion(a, b);
  s.shear_area_y_m2 = s.shear_area_z_m2 = s.area_m2 * 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
  return s;
}

/// Walls t1 (at +n1, -n1) and t2 (at +n2, -n2).
fe::Section box(double a, double b, double t1, double t2) {
  fe::Section s;
  const double ai = a - 2.0 * t1, bi = b - 2.0 * t2;
  s.area_m2 = a * b - ai * bi;
  s.inertia_y_m4 = (a * b * b * b - ai * bi * bi * bi) / 12.0;
  s.inertia_z_m4 = (b * a * a * a - bi * ai * ai * ai) / 12.0;
  const double enclosed = (a - t1) * (b - t2);
  s.torsion_m4 = 4.0 * enclosed * enclosed / (2.0 * (a - t1) / t2 + 2.0 * (b - t2) / t1);
  s.shear_area_y_m2 = 2.0 * t2 * (a - 2.0 * t1);
  s.shear_area_z_m2 = 2.0 * t1 * (b - 2.0 * t2);
  return s;
}

/// Height h along n2, flanges b × t, web w.
fe::Section i_beam(double h, double b, double t, double w) {
  fe::Section s;
  const double web = h - 2.0 * t;
  s.area_m2 = 2.0 * b * t + web * w;
  s.inertia_y_m4 = (b * h * h * h - (b - w) * web * web * web) / 12.0;
  s.inertia_z_m4 = (2.0 * t * b * b * b + web * w * w * w) / 12.0;
  s.torsion_m4 = (2.0 * b * t * t * t + web * w * w * w) / 3.0;
  s.shear_area_y_m2 = 2.0 * b * t * 5.0 / 6.0;
  s.shear_area_z_m2 = web * w;
  return s;
}

const std::map<std::string, std::size_t>& sizes() {
  static const std::map<std::string, std::size_t> known = {{"RECT", 2}, {"CIRC", 1}, {"PIPE", 2}, {"BOX", 6}, {"I", 7}};
  return known;
}

auto numbers_of(const fe::Section& s) {
  return std::array{s.area_m2,         s.inertia_y_m4,    s.inertia_z_m4, s.inertia_yz_m4,        s.torsion_m4,
                    s.shear_area_y_m2, s.shear_area_z_m2, s.thickness_m,  s.bending_inertia_ratio};
}

}  // namespace

int find_or_add_section(std::vector<fe::Section>& sections, fe::Section section) {
  const std::string wanted = section.name;
  for (int count = 2;; ++count) {
    const auto other =
        std::find_if(sections.begin(), sections.end(), [&](const fe::Section& s) { return s.name == section.name; });
    if (other == sections.end()) break;
    if (numbers_of(*other) == numbers_of(section)) return static_cast<int>(other - sections.begin());
    section.name = fmt::format("{}_{}", wanted, count);
  }
  sections.push_back(std::move(section));
  return static_cast<int>(sections.size()) - 1;
}

std::size_t profile_size(const std::string& profile) {
  const auto found = sizes().find(profile);
  return found == sizes().end() ? 0 : found->second;
}

const std::vector<std::string>& profile_names() {
  static const std::vector<std::string> names = {"BOX", "CIRC", "I", "PIPE", "RECT"};
  return names;
}

double rectangle_torsion(double a, double b) {
  const double longer = std::max(a, b), shorter = std::min(a, b), ratio = shorter / longer;
  // J/(l s³) = 1/3 - 64 s/(pi^5 l) sum over odd n of tanh(n pi l / 2 s)/n^5
  double sum = 0.0;
  for (int n = 1; n <= 19; n += 2) sum += std::tanh(n * pi / (2.0 * ratio)) / std::pow(n, 5);
  return longer * std::pow(shorter, 3) * (1.0 / 3.0 - 64.0 * ratio / std::pow(pi, 5) * sum);
}

fe::Section profile_section(const std::string& profile, const std::vector<double>& v, double nu, std::string& problem) {
  if (std::any_of(v.begin(), v.end(), [](double x) { return x <= 0.0; })) {
    problem = "a dimension is not above 0";
    return {};
  }
  if (profile == "RECT") return rectangle(v[0], v[1], nu);
  if (profile == "CIRC") return pipe(v[0], 0.0, nu);
  if (profile == "PIPE") {
    if (v[1] > v[0]) problem = "the wall is thicker than the outer radius";
    return pipe(v[0], v[0] - std::min(v[0], v[1]), nu);
  }
  if (profile == "BOX") {
    if (!near(v[2], v[4], 1e-9) || !near(v[3], v[5], 1e-9)) problem = "opposite walls differ, which is not supported";
    if (2.0 * v[2] >= v[0] || 2.0 * v[3] >= v[1]) problem = "the walls fill the box";
    return box(v[0], v[1], v[2], v[3]);
  }
  if (!near(2.0 * v[0], v[1], 1e-9) || !near(v[2], v[3], 1e-9) || !near(v[4], v[5], 1e-9)) {
    problem = "the I is not doubly symmetric about its origin, which is not supported";
  }
  if (2.0 * v[4] >= v[1] || v[6] > v[2]) problem = "flanges or web do not fit";
  return i_beam(v[1], v[2], v[4], v[6]);
}

std::optional<Profile> recognise_pipe(const fe::Section& s, double tolerance) {
  if (s.area_m2 <= 0.0 || s.inertia_y_m4 <= 0.0 || s.inertia_z_m4 <= 0.0) return std::nullopt;
  if (std::abs(s.inertia_yz_m4) > tolerance * s.inertia_y_m4) return std::nullopt;
  if (!near(s.inertia_y_m4, s.inertia_z_m4, tolerance) || !near(s.torsion_m4, s.inertia_y_m4 + s.inertia_z_m4, tolerance)) {
    return std::nullopt;
  }
  // R² + r² = 4 I / A,  R² - r² = A / pi
  const double sum = 4.0 * s.inertia_y_m4 / s.area_m2, difference = s.area_m2 / pi;
  const double outer = std::sqrt((sum + difference) / 2.0), inner2 = (sum - difference) / 2.0;
  if (inner2 <= tolerance * outer * outer) return std::nullopt;
  return Profile{"PIPE", {outer, outer - std::sqrt(inner2)}};
}

}  // namespace twindeck::model_io
