#include "model_io/profiles.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace twindeck::model_io {
namespace {

using std::numbers::pi;

bool near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)); }

/// Area, its first and second moments about the origin of the drawing.
struct Moments {
  double area = 0.0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  void add(const Shape::Wall& wall) {
    const Eigen::Vector2d along = wall.to - wall.from, middle = (wall.from + wall.to) / 2.0,
                          across = Eigen::Vector2d(-along[1], along[0]).normalized() * wall.thickness;
    const double a = along.norm() * wall.thickness;
    area += a;
    first += a * middle;
    second += a * (middle * middle.transpose() + (along * along.transpose() + across * across.transpose()) / 12.0);
  }
  /// The triangle from the origin to two corners of a polygon.
  void add(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    const double twice = p[0] * q[1] - p[1] * q[0];
    const Eigen::Vector2d sum = p + q;
    area += twice / 2.0;
    first += twice / 6.0 * sum;
    second += twice / 24.0 * (p * p.transpose() + q * q.transpose() + sum * sum.transpose());
  }
  [[nodiscard]] Eigen::Matrix2d central() const { return second - first * first.transpose() / area; }
};

/// Saint-Venant's torsion constant of a convex polygon by Trefftz' method: Prandtl's function is psi - r²/2 with psi harmonic,
/// the polynomial nearest to r²/2 on the boundary. Integrals of z^k over the area are sums over the edges (Green).
double polygon_torsion(const std::vector<Eigen::Vector2d>& outline, const Moments& moments) {
  using Complex = std::complex<double>;
  constexpr int degree = 16, points = 60;  // an edge; 1e-4 of a square, 1e-3 of flat quadrilaterals
  const double size = std::sqrt(moments.central().trace() / moments.area) * 2.0;
  const Eigen::Vector2d centroid = moments.first / moments.area;
  const auto n = outline.size();
  const auto corner = [&](std::size_t i) {
    const Eigen::Vector2d r = (outline[i % n] - centroid) / size;
    return Complex(r[0], r[1]);
  };
  Eigen::MatrixXd values(static_cast<Eigen::Index>(n) * points, 2 * degree + 1);
  Eigen::VectorXd wanted(values.rows()), integral = Eigen::VectorXd::Zero(values.cols());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Complex a = corner(i), b = corner(i + 1);
    for (int j = 0; j < points; ++j, ++row) {
      const Complex z = (a + b) / 2.0 + (b - a) / 2.0 * std::cos((2 * j + 1) * pi / (2 * points));
      wanted[row] = std::norm(z) / 2.0;
      values(row, 0) = 1.0;
      for (int k = 1; k <= degree; ++k) {
        values(row, 2 * k - 1) = std::pow(z, k).real();
        values(row, 2 * k) = std::pow(z, k).imag();
      }
    }
    if (a == b) continue;
    for (int k = 0; k <= degree; ++k) {
      const Complex part = std::conj(b - a) / (b - a) * (std::pow(b, k + 2) - std::pow(a, k + 2)) /
                           static_cast<double>((k + 1) * (k + 2)) * Complex(0.0, 0.5);
      integral[std::max(0, 2 * k - 1)] += part.real();
      if (k > 0) integral[2 * k] += part.imag();
    }
  }
  const double harmonic = integral.dot(values.colPivHouseholderQr().solve(wanted)) * std::pow(size, 4);
  return 2.0 * std::abs(harmonic) - moments.central().trace();
}

/// Whether a wall runs into another one at a point of its end.
bool is_joined(const Shape& shape, const Shape::Wall& wall, const Eigen::Vector2d& end) {
  return std::ranges::any_of(shape.walls, [&](const Shape::Wall& other) {
    if (&other == &wall) return false;
    const Eigen::Vector2d along = other.to - other.from, from_middle = end - (other.from + other.to) / 2.0;
    const double length = along.norm(), s = std::abs(from_middle.dot(along)) / length,
                 across = std::abs(from_middle[0] * along[1] - from_middle[1] * along[0]) / length;
    const double gap = std::hypot(std::max(0.0, s - length / 2.0), std::max(0.0, across - other.thickness / 2.0));
    return gap <= wall.thickness / 2.0 * (1.0 + 1e-6);
  });
}

/// Shear area of walls in a direction: what runs along it, five sixths where an end is free.
double shear_of_walls(const Shape& shape, int direction) {
  double sum = 0.0;
  for (const Shape::Wall& wall : shape.walls) {
    const Eigen::Vector2d along = wall.to - wall.from;
    const bool joined = is_joined(shape, wall, wall.from) && is_joined(shape, wall, wall.to);
    sum += (joined ? 1.0 : 5.0 / 6.0) * wall.thickness * along[direction] * along[direction] / along.norm();
  }
  return sum;
}

/// Whether each wall has its like across the centroid: then that is the shear centre too.
bool is_point_symmetric(const Shape& shape, const Eigen::Vector2d& centroid) {
  return std::ranges::all_of(shape.walls, [&](const Shape::Wall& wall) {
    const Eigen::Vector2d mirrored = 2.0 * centroid - (wall.from + wall.to) / 2.0;
    const double length = (wall.to - wall.from).norm(), beside = 1e-6 * (length + wall.thickness);
    return std::ranges::any_of(shape.walls, [&](const Shape::Wall& other) {
      return ((other.from + other.to) / 2.0 - mirrored).norm() <= beside &&
             std::abs((other.to - other.from).norm() - length) <= beside && near(other.thickness, wall.thickness, 1e-6);
    });
  });
}

/// Torsion constant and shear areas of a hollow circle (Cowper 1966, table 1).
void complete_circle(const Shape& shape, double nu, fe::Section& s) {
  const double m2 = std::pow(shape.inner / shape.radius, 2), q = (1.0 + m2) * (1.0 + m2);
  s.torsion_m4 = s.inertia_y_m4 + s.inertia_z_m4;
  s.shear_area_y_m2 = s.shear_area_z_m2 = s.area_m2 * 6.0 * (1.0 + nu) * q / ((7.0 + 6.0 * nu) * q + (20.0 + 12.0 * nu) * m2);
}

void complete_walls(const Shape& shape, double nu, fe::Section& s) {
  if (shape.walls.size() == 1) {
    s.torsion_m4 = rectangle_torsion((shape.walls[0].to - shape.walls[0].from).norm(), shape.walls[0].thickness);
    s.shear_area_y_m2 = s.shear_area_z_m2 = s.area_m2 * 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    return;
  }
  s.torsion_m4 = shape.closed_torsion;
  for (const Shape::Wall& wall : shape.walls)
    if (shape.closed_torsion == 0.0) s.torsion_m4 += (wall.to - wall.from).norm() * std::pow(wall.thickness, 3) / 3.0;
  s.shear_area_y_m2 = shear_of_walls(shape, 0);
  s.shear_area_z_m2 = shear_of_walls(shape, 1);
}

auto numbers_of(const fe::Section& s) {
  return std::array{s.area_m2,         s.inertia_y_m4,    s.inertia_z_m4, s.inertia_yz_m4,         s.torsion_m4,
                    s.shear_area_y_m2, s.shear_area_z_m2, s.thickness_m,  s.bending_inertia_ratio, s.shear_thickness_ratio};
}

}  // namespace

Shape rectangles(const std::vector<std::array<double, 4>>& sides) {
  Shape shape;
  for (const auto& [left, lower, right, upper] : sides) {
    const double width = right - left, height = upper - lower;
    shape.fits = shape.fits && width >= 0.0 && height >= 0.0;
    if (!(width > 0.0) || !(height > 0.0)) continue;
    const Eigen::Vector2d middle((left + right) / 2.0, (lower + upper) / 2.0),
        half = width >= height ? Eigen::Vector2d(width / 2.0, 0.0) : Eigen::Vector2d(0.0, height / 2.0);
    shape.walls.push_back({middle - half, middle + half, std::min(width, height)});
  }
  return shape;
}

Shape circle(double radius, double inner) {
  return Shape{.radius = radius, .inner = inner, .fits = radius > 0.0 && inner >= 0.0 && inner < radius};
}

double bredt(double area, double around, double area2, double around2, double common) {
  // Flows q of the cells at a unit rate of twist: around q - common q' = 2 area.
  const double determinant = around * around2 - common * common;
  const double q = 2.0 * (area * around2 + area2 * common) / determinant,
               q2 = 2.0 * (area2 * around + area * common) / determinant;
  return 2.0 * (area * q + area2 * q2);
}

Shape box(double width, double height, const std::array<double, 4>& walls) {
  const auto& [right, top, left, bottom] = walls;
  const double w = width - (left + right) / 2.0, h = height - (top + bottom) / 2.0;
  Shape shape = rectangles({{0.0, 0.0, width, bottom},
                            {0.0, height - top, width, height},
                            {0.0, bottom, left, height - top},
                            {width - right, bottom, width, height - top}});
  shape.fits = shape.fits && shape.walls.size() == 4 && left + right < width;
  shape.closed_torsion = bredt(w * h, w / top + w / bottom + h / left + h / right);
  return shape;
}

Shape i_shape(double height, const std::array<double, 2>& b, const std::array<double, 2>& t, double web) {
  Shape shape = rectangles({{-b[0] / 2.0, 0.0, b[0] / 2.0, t[0]},
                            {-web / 2.0, t[0], web / 2.0, height - t[1]},
                            {-b[1] / 2.0, height - t[1], b[1] / 2.0, height}});
  for (std::size_t i = 0; i < 2; ++i) shape.fits = shape.fits && (t[i] == 0.0 || b[i] >= web);
  return shape;
}

Shape channel(double height, const std::array<double, 2>& b, const std::array<double, 2>& t, double web, bool as_z) {
  const double left = as_z ? web - b[1] : 0.0;
  Shape shape =
      rectangles({{0.0, 0.0, b[0], t[0]}, {0.0, t[0], web, height - t[1]}, {left, height - t[1], left + b[1], height}});
  shape.fits = shape.fits && b[0] >= web && b[1] >= web;
  return shape;
}

Shape angle(double width, double height, double t_h, double t_v) { return channel(height, {width, t_v}, {t_h, 0.0}, t_v); }

Shape hat(double height, double top, const std::array<double, 2>& brims, const std::array<double, 5>& t) {
  const double a = top / 2.0, v = height - t[2];
  Shape shape = rectangles({{t[3] - a - brims[0], 0.0, t[3] - a, t[0]},
                            {a - t[4], 0.0, a - t[4] + brims[1], t[1]},
                            {-a, v, a, height},
                            {-a, t[0], t[3] - a, v},
                            {a - t[4], t[1], a, v}});
  shape.fits = shape.fits && t[3] + t[4] < top && brims[0] >= t[3] && brims[1] >= t[4];
  return shape;
}

Shape turned(Shape shape) {
  const auto turn = [](Eigen::Vector2d& x) { x = Eigen::Vector2d(-x[1], x[0]); };
  for (Shape::Wall& wall : shape.walls) turn(wall.from), turn(wall.to);
  for (Eigen::Vector2d& corner : shape.outline) turn(corner);
  return shape;
}

ProfileSection profile_section(const Shape& shape, double nu) {
  Moments moments;
  for (const Shape::Wall& wall : shape.walls) moments.add(wall);
  for (std::size_t i = 0; i < shape.outline.size(); ++i)
    moments.add(shape.outline[i], shape.outline[(i + 1) % shape.outline.size()]);
  ProfileSection profile;
  fe::Section& s = profile.section;
  if (shape.radius > 0.0) {
    moments.area = pi * (std::pow(shape.radius, 2) - std::pow(shape.inner, 2));
    moments.second = pi / 4.0 * (std::pow(shape.radius, 4) - std::pow(shape.inner, 4)) * Eigen::Matrix2d::Identity();
  }
  if (moments.area < 0.0) moments = {-moments.area, -moments.first, -moments.second};  // corners in clockwise order
  if (!shape.fits || !(moments.area > 0.0)) return profile;
  const Eigen::Matrix2d central = moments.central();
  profile.centroid = moments.first / moments.area;
  s.area_m2 = moments.area;
  s.inertia_y_m4 = central(1, 1);
  s.inertia_z_m4 = central(0, 0);
  s.inertia_yz_m4 = central(0, 1);
  if (shape.radius > 0.0) {
    complete_circle(shape, nu, s);
  } else if (shape.walls.empty()) {
    s.torsion_m4 = polygon_torsion(shape.outline, moments);
    s.shear_area_y_m2 = s.shear_area_z_m2 = 5.0 / 6.0 * s.area_m2;
  } else {
    complete_walls(shape, nu, s);
    profile.beside = !is_point_symmetric(shape, profile.centroid);
  }
  constexpr double rounding = 1e-12;  // [-] of a product of inertia that is none
  if (std::abs(s.inertia_yz_m4) < rounding * (s.inertia_y_m4 + s.inertia_z_m4)) s.inertia_yz_m4 = 0.0;
  const std::array needed{s.inertia_y_m4, s.inertia_z_m4, s.torsion_m4, s.shear_area_y_m2, s.shear_area_z_m2};
  profile.possible = std::ranges::all_of(needed, [](double x) { return std::isfinite(x) && x > 0.0; });
  return profile;
}

fe::Section upright(const ProfileSection& profile) {
  fe::Section s = profile.section;
  std::swap(s.inertia_y_m4, s.inertia_z_m4);
  std::swap(s.shear_area_y_m2, s.shear_area_z_m2);
  s.inertia_yz_m4 = -s.inertia_yz_m4;
  return s;
}

std::string note_beside(const std::string& section) {
  return fmt::format(
      "section '{}': its shear centre lies beside its centroid; both are taken as one, so that bending does not "
      "twist the members (model them by shells where that matters)",
      section);
}

int find_or_add_section(std::vector<fe::Section>& sections, fe::Section section) {
  const std::string wanted = section.name;
  for (int count = 2;; ++count) {
    const auto other = std::ranges::find(sections, section.name, &fe::Section::name);
    if (other == sections.end()) break;
    if (numbers_of(*other) == numbers_of(section)) return static_cast<int>(other - sections.begin());
    section.name = fmt::format("{}_{}", wanted, count);
  }
  sections.push_back(std::move(section));
  return static_cast<int>(sections.size()) - 1;
}

double rectangle_torsion(double a, double b) {
  const double longer = std::max(a, b), shorter = std::min(a, b), ratio = shorter / longer;
  // J/(l s³) = 1/3 - 64 s/(pi^5 l) sum over odd n of tanh(n pi l / 2 s)/n^5
  double sum = 0.0;
  for (int n = 1; n <= 19; n += 2) sum += std::tanh(n * pi / (2.0 * ratio)) / std::pow(n, 5);
  return longer * std::pow(shorter, 3) * (1.0 / 3.0 - 64.0 * ratio / std::pow(pi, 5) * sum);
}

std::optional<Profile> recognise_pipe(const fe::Section& s, double tolerance) {
  if (s.area_m2 <= 0.0 || s.inertia_y_m4 <= 0.0 || s.inertia_z_m4 <= 0.0) return std::nullopt;
  if (std::abs(s.inertia_yz_m4) > tolerance * s.inertia_y_m4) return std::nullopt;
  if (!near(s.inertia_y_m4, s.inertia_z_m4, tolerance) || !near(s.torsion_m4, s.inertia_y_m4 + s.inertia_z_m4, tolerance))
    return std::nullopt;
  // R² + r² = 4 I / A,  R² - r² = A / pi
  const double sum = 4.0 * s.inertia_y_m4 / s.area_m2, difference = s.area_m2 / pi;
  const double outer = std::sqrt((sum + difference) / 2.0), inner2 = (sum - difference) / 2.0;
  if (inner2 <= tolerance * outer * outer) return std::nullopt;
  return Profile{"PIPE", {outer, outer - std::sqrt(inner2)}};
}

}  // namespace twindeck::model_io
