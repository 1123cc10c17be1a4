#include "blind/form/truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::blind::form {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using What = Feature::What;

constexpr double kShearArea = 0.4;                                 ///< of the area: webs of a box, about
constexpr double kShearModulus = 1.0 / 2.4;                        ///< of E, at Poisson's ratio 0.2
constexpr int kGirderParts = 3, kColumnParts = 2, kBeamParts = 3;  ///< beams of the truth a zone
constexpr double kArea =
    1.0 / 3.0;  ///< a section's area grows with this power of its inertia (depth to the first and the third)
constexpr double kLeastMotion = 0.2;  ///< squared, of the mode that moves the channels most: less is not found in a record
constexpr int kDamperModes = 80;      ///< modes that carry the motion where a damper's stiffness depends on frequency

double factor_in(const std::map<int, double>& factors, int key) {
  const auto at = factors.find(key);
  return at == factors.end() ? 1.0 : at->second;
}

double wave(const Feature& feature, double s) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) sum += feature.wave[k] * std::cos(std::numbers::pi * static_cast<double>(k + 1) * s);
  return sum;
}

/// Builds the truth's frame, part by part.
class Builder {
 public:
  Builder(const Truth& truth, const Change& change) : truth_(truth), layout_(truth.layout), change_(change) {
    for (const Vector2d& x : layout_.nodes) node_.push_back(frame_.add_node(x));
    for (std::size_t e = 0; e < layout_.beams.size(); ++e) add_zone(static_cast<int>(e));
    for (std::size_t b = 0; b < layout_.bearings.size(); ++b) add_bearing(static_cast<int>(b));
    add_floors();
    add_features();
    add_attached();
    if (layout_.first_fixed >= 0) hold_along();
  }
  [[nodiscard]] const PlaneFrame& frame() const { return frame_; }
  [[nodiscard]] int unknown(int coarse_node, int direction) const {
    return frame_.unknown(node_[static_cast<std::size_t>(coarse_node)], direction);
  }

 private:
  struct Zone {
    std::vector<int> nodes;  ///< of the truth, from end to end
  };

  template <typename Use>
  void each(What what, const Use& use) const {
    for (std::size_t i = 0; i < truth_.form.features.size(); ++i) {
      const Feature& f = truth_.form.features[i];
      if (f.what == what && (truth_.form.only < 0 || truth_.form.only == static_cast<int>(i)))
        use(f, truth_.form.severity * f.size);
    }
  }
  [[nodiscard]] double quantity(Quantity::Of of, int material, const std::string& group) const {
    double factor = 1.0;
    for (std::size_t q = 0; q < layout_.quantities.size(); ++q) {
      const Quantity& quantity = layout_.quantities[q];
      if (quantity.of != of) continue;
      const bool named = of == Quantity::Of::floors ||
                         std::count(quantity.materials.begin(), quantity.materials.end(), material) > 0 ||
                         std::count(quantity.groups.begin(), quantity.groups.end(), group) > 0;
      if (named) factor *= truth_.factors[static_cast<Index>(q)];
    }
    return factor;
  }
  /// Place along the structure, 0 to 1.
  [[nodiscard]] double along(const Vector2d& x) const {
    return layout_.girder() ? x.x() / layout_.length_m() : x.y() / layout_.height_m();
  }
  /// 0 in the middle of a span or beam, 1 at its supports.
  [[nodiscard]] double towards_support(const CoarseBeam& beam, const Vector2d& x) const {
    if (!layout_.girder()) {
      const Vector2d a = layout_.nodes[static_cast<std::size_t>(beam.from)],
                     b = layout_.nodes[static_cast<std::size_t>(beam.to)];
      const double t = 2.0 * (x - a).norm() / (b - a).norm() - 1.0;
      return beam.column ? 0.0 : t * t;
    }
    double left = 0.0, right = layout_.length_m();
    for (const Bearing& bearing : layout_.bearings) {
      const double at = layout_.nodes[static_cast<std::size_t>(bearing.node)].x();
      (at <= x.x() ? left : right) = at <= x.x() ? std::max(left, at) : std::min(right, at);
    }
    const double t = 2.0 * (x.x() - left) / (right - left) - 1.0;
    return t * t;
  }

  [[nodiscard]] BeamPart properties(int e, const Vector2d& x) const {
    const CoarseBeam& beam = layout_.beams[static_cast<std::size_t>(e)];
    const Material& material = layout_.materials[static_cast<std::size_t>(beam.material)];
    const Section& section = layout_.sections[static_cast<std::size_t>(beam.section)];
    const double modulus = quantity(Quantity::Of::modulus, beam.material, "") * material.youngs_modulus_Pa * change_.beams *
                           factor_in(change_.beam, e) * factor_in(change_.material, beam.material);
    double inertia = 1.0, mass = quantity(Quantity::Of::density, beam.material, "");
    each(What::haunch, [&](const Feature&, double size) { inertia *= std::exp(size * towards_support(beam, x)); });
    mass *= std::pow(inertia, kArea);
    each(What::stiffness, [&](const Feature& f, double size) {
      if (layout_.girder() || beam.column) inertia *= std::exp(size * wave(f, along(x)));
    });
    each(What::mass, [&](const Feature& f, double size) { mass *= std::exp(size * wave(f, along(x))); });
    BeamPart part;
    part.axial_N = modulus * section.area_m2;
    part.bending_N_m2 = modulus * section.inertia_m4 * inertia;
    part.mass_kg_m = material.density_kg_m3 * section.area_m2 * mass;
    each(What::shear, [&](const Feature&, double size) {
      part.shear_N = kShearArea * kShearModulus * modulus * section.area_m2 * std::pow(inertia, kArea) / std::max(size, 1e-9);
    });
    each(What::rotary,
         [&](const Feature&, double size) { part.rotary_kg_m = size * material.density_kg_m3 * section.inertia_m4 * inertia; });
    if (layout_.girder() || beam.column) part.compression_N = change_.compression_N;
    return part;
  }

  /// An end of a beam that turns against its node: the rotation's unknown, -1 where the joint is rigid.
  int turning_end(int node, double size, double bending_N_m2) {
    if (!(size > 0.0)) return -1;
    const int turn = frame_.add_unknown();
    frame_.add_spring({{turn, 1.0}, {frame_.unknown(node, 2), -1.0}}, bending_N_m2 / (size * layout_.span_m));
    return turn;
  }

  void add_zone(int e) {
    const CoarseBeam& beam = layout_.beams[static_cast<std::size_t>(e)];
    const int parts = layout_.girder() ? kGirderParts : beam.column ? kColumnParts : kBeamParts;
    const Vector2d a = layout_.nodes[static_cast<std::size_t>(beam.from)], b = layout_.nodes[static_cast<std::size_t>(beam.to)];
    Zone zone{{node_[static_cast<std::size_t>(beam.from)]}};
    for (int i = 1; i < parts; ++i) zone.nodes.push_back(frame_.add_node(a + (b - a) * i / parts));
    zone.nodes.push_back(node_[static_cast<std::size_t>(beam.to)]);
    for (int i = 0; i < parts; ++i) {
      BeamPart part = properties(e, a + (b - a) * (i + 0.5) / parts);
      part.from = zone.nodes[static_cast<std::size_t>(i)];
      part.to = zone.nodes[static_cast<std::size_t>(i) + 1];
      if (i == 0) {
        each(What::splice, [&](const Feature& f, double size) {
          if (f.place == beam.from) part.turn_from = turning_end(part.from, size, part.bending_N_m2);
        });
        each(What::joint, [&](const Feature& f, double size) {
          if (f.place == 2 * e) part.turn_from = turning_end(part.from, size, part.bending_N_m2);
        });
      }
      if (i == parts - 1)
        each(What::joint, [&](const Feature& f, double size) {
          if (f.place == 2 * e + 1) part.turn_to = turning_end(part.to, size, part.bending_N_m2);
        });
      frame_.add_beam(part);
    }
    zones_.push_back(zone);
  }

  /// How the axis moves across at x: cubic between the truth's nodes of a girder.
  [[nodiscard]] Movement across_at(double x_m) const {
    for (const Zone& zone : zones_)
      for (std::size_t i = 0; i + 1 < zone.nodes.size(); ++i) {
        const double a = frame_.position(zone.nodes[i]).x(), l = frame_.position(zone.nodes[i + 1]).x() - a, t = (x_m - a) / l;
        if (t < -1e-9 || t > 1.0 + 1e-9) continue;
        const int left = zone.nodes[i], right = zone.nodes[i + 1];
        return {{frame_.unknown(left, 1), 1 - 3 * t * t + 2 * t * t * t},
                {frame_.unknown(left, 2), l * (t - 2 * t * t + t * t * t)},
                {frame_.unknown(right, 1), 3 * t * t - 2 * t * t * t},
                {frame_.unknown(right, 2), l * (t * t * t - t * t)}};
      }
    throw InternalError("a bearing stands beside the girder");
  }

  void add_bearing(int b) {
    const Bearing& bearing = layout_.bearings[static_cast<std::size_t>(b)];
    const double translation = quantity(Quantity::Of::springs, -1, bearing.name) * factor_in(change_.bearing, b);
    double arm = 0.0,
           turn = quantity(Quantity::Of::springs, -1, bearing.name + "_turn") * bearing.turn_N_m * factor_in(change_.turn, b);
    each(What::eccentric, [&](const Feature& f, double size) { arm += f.place == b ? size : 0.0; });
    each(What::end_turn, [&](const Feature& f, double size) {
      if (f.place == b) turn += size * stiffest_bending() / layout_.span_m;
    });
    const auto at = change_.shift_m.find(b);
    Movement across = {{unknown(bearing.node, 1), 1.0}};
    if (at != change_.shift_m.end()) across = across_at(layout_.nodes[static_cast<std::size_t>(bearing.node)].x() + at->second);
    across.push_back({unknown(bearing.node, 2), arm});
    frame_.add_spring(across, translation * bearing.z_N_m);
    if (bearing.x_N_m > 0.0) frame_.add_spring({{unknown(bearing.node, 0), 1.0}}, translation * bearing.x_N_m);
    if (turn > 0.0) frame_.add_spring({{unknown(bearing.node, 2), 1.0}}, turn);
  }
  [[nodiscard]] double stiffest_bending() const {
    return layout_.materials.front().youngs_modulus_Pa * layout_.sections.front().inertia_m4;
  }

  /// The bearing that holds along x; below the axis it resists turning too.
  void hold_along() {
    double depth = 0.0;
    each(What::depth, [&](const Feature&, double size) { depth += size; });
    const Section& section = layout_.sections.front();
    constexpr double kStiff = 20.0;  // of the girder's own stiffness along its axis
    frame_.add_spring({{unknown(layout_.first_fixed, 0), 1.0}, {unknown(layout_.first_fixed, 2), depth}},
                      kStiff * layout_.materials.front().youngs_modulus_Pa * section.area_m2 / layout_.length_m());
  }

  void add_floors() {
    double height = 0.0;
    each(What::high_floors, [&](const Feature&, double size) { height += size; });
    for (std::size_t i = 0; i < layout_.floors.size(); ++i) {
      double kg = layout_.floors[i].kg * quantity(Quantity::Of::floors, -1, "");
      each(What::floor, [&](const Feature& f, double size) { kg *= f.place == static_cast<int>(i) ? std::exp(size) : 1.0; });
      add_mass(layout_.floors[i].node, kg, height);
    }
  }
  /// @param height_m  above the axis
  void add_mass(int node, double kg, double height_m) {
    frame_.add_mass({{unknown(node, 0), 1.0}, {unknown(node, 2), -height_m}}, kg);
    frame_.add_mass({{unknown(node, 1), 1.0}}, kg);
  }

  void add_features() {
    each(What::diaphragm, [&](const Feature& f, double size) { add_mass(f.place, size * layout_.total_kg, 0.0); });
    each(What::infill,
         [&](const Feature& f, double size) { add_tie(2 * f.place, 2 * f.place + 3, 2.0 * size * reference_N_m(layout_)); });
  }
  void add_tie(int from, int to, double N_m) {
    const Vector2d along =
        (layout_.nodes[static_cast<std::size_t>(to)] - layout_.nodes[static_cast<std::size_t>(from)]).normalized();
    frame_.add_spring({{unknown(to, 0), along.x()},
                       {unknown(to, 1), along.y()},
                       {unknown(from, 0), -along.x()},
                       {unknown(from, 1), -along.y()}},
                      N_m);
  }

  void add_attached() {
    for (const auto& spring : change_.to_ground) frame_.add_spring({{unknown(spring.node, spring.direction), 1.0}}, spring.N_m);
    for (const auto& tie : change_.ties) add_tie(tie.from, tie.to, tie.N_m);
    for (const Floor& mass : change_.masses) add_mass(mass.node, mass.kg, 0.0);
    for (const auto& chain : change_.chains)
      for (const int direction : {0, 1}) {  // it hangs in both directions alike
        int above = unknown(chain.node, direction);
        for (const auto& [kg, hertz] : chain.kg_Hz) {
          const int own = frame_.add_unknown();
          const double omega = 2.0 * std::numbers::pi * hertz;
          frame_.add_mass({{own, 1.0}}, kg);
          frame_.add_spring({{own, 1.0}, {above, -1.0}}, kg * omega * omega);
          above = own;
        }
      }
  }

  const Truth& truth_;
  const Layout& layout_;
  const Change& change_;
  PlaneFrame frame_;
  std::vector<int> node_;
  std::vector<Zone> zones_;
};

std::array<double, 3> draw_wave(Stream& random) {
  return {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
}

// Sizes are drawn before places, each in a statement of its own: compilers choose the order of a call's arguments.
void draw_girder_form(const Layout& layout, Stream& random, Form& form) {
  const auto add = [&](What what, int place, double size) { form.features.push_back({what, place, size, draw_wave(random)}); };
  const int inner = static_cast<int>(layout.nodes.size()) - 2, bearings = static_cast<int>(layout.bearings.size());
  add(What::haunch, -1, random.between(-0.3, 0.6));
  add(What::stiffness, -1, random.between(0.05, 0.25));
  add(What::mass, -1, random.between(0.03, 0.12));
  const int splices = 2 + random.below(3);
  for (int i = 0; i < splices; ++i) {
    const double size = random.between(0.01, 0.08);
    add(What::splice, 1 + random.below(inner), size);
  }
  for (int b = 0; b < bearings; ++b) {
    add(What::end_turn, b, random.between(0.0, 0.4));
    add(What::eccentric, b, random.between(-0.4, 0.4));
    add(What::diaphragm, layout.bearings[static_cast<std::size_t>(b)].node, random.between(0.0, 0.015));
  }
  const double diaphragm = random.between(0.0, 0.015);
  add(What::diaphragm, 1 + random.below(inner), diaphragm);
  add(What::depth, -1, random.between(0.2, 0.5) * layout.sections[0].depth_m);
}

void draw_frame_form(const Layout& layout, Stream& random, Form& form) {
  const auto add = [&](What what, int place, double size) { form.features.push_back({what, place, size, draw_wave(random)}); };
  add(What::haunch, -1, random.between(-0.2, 0.6));
  add(What::stiffness, -1, random.between(0.1, 0.4));
  for (int e = 0; e < static_cast<int>(layout.beams.size()); ++e)
    if (!layout.beams[static_cast<std::size_t>(e)].column)
      for (const int end : {0, 1}) add(What::joint, 2 * e + end, random.between(0.0, 0.25));
  for (int i = 0; i < static_cast<int>(layout.floors.size()); ++i) add(What::floor, i, random.between(-0.15, 0.15));
  for (const int b : {0, 1}) add(What::eccentric, b, random.between(-0.3, 0.3));
  add(What::high_floors, -1, random.between(0.0, 0.5));
  const int storeys = static_cast<int>(layout.floors.size()) / 2;
  const double infill = random.between(0.0, 0.2);
  add(What::infill, random.below(storeys), infill);
}

}  // namespace

bool is_local(What what) {
  return what == What::splice || what == What::joint || what == What::end_turn || what == What::diaphragm ||
         what == What::floor || what == What::infill;
}

Form draw_form(const Layout& layout, Stream& random) {
  Form form;
  form.features.push_back({What::shear, -1, random.between(0.0, 0.5), {}});
  form.features.push_back({What::rotary, -1, random.between(0.0, 0.5), {}});
  if (layout.girder())
    draw_girder_form(layout, random, form);
  else
    draw_frame_form(layout, random, form);
  return form;
}

SeenModes modes_of(const Truth& truth, const Change& change, int lowest) {
  const Builder builder(truth, change);
  FrameModes modes = builder.frame().modes();
  const Index count = std::min<Index>(lowest, modes.omega2.size());
  if (change.damper) {
    const Change::Damper damper = *change.damper;
    const double time_s = damper.N_s_m / damper.N_m;
    const auto storage = [=](double omega) {
      return damper.N_m * std::pow(omega * time_s, 2) / (1.0 + std::pow(omega * time_s, 2));
    };
    const int direction = truth.layout.direction;
    modes = with_varying_spring(modes, {{builder.unknown(damper.node, direction), 1.0}}, storage, static_cast<int>(count),
                                kDamperModes);
  }
  SeenModes seen{modes.omega2.head(count).cwiseSqrt() / (2.0 * std::numbers::pi),
                 MatrixXd(2 * static_cast<Index>(truth.layout.nodes.size()), count)};
  for (std::size_t i = 0; i < truth.layout.nodes.size(); ++i)
    for (const int d : {0, 1})
      seen.at_nodes.row(2 * static_cast<Index>(i) + d) = modes.shapes.row(builder.unknown(static_cast<int>(i), d)).head(count);
  return seen;
}

MatrixXd at_channels(const Layout& layout, const MatrixXd& at_nodes) {
  MatrixXd out(static_cast<Index>(layout.channel_nodes.size()), at_nodes.cols());
  for (std::size_t c = 0; c < layout.channel_nodes.size(); ++c)
    out.row(static_cast<Index>(c)) = at_nodes.row(2 * layout.channel_nodes[c] + layout.direction);
  return out;
}

SeenModes measurable_modes(const Truth& truth, const Change& change) {
  constexpr int kBeyond = 12;  // modes along the axis, and of attached masses, lie between those that are measured
  const SeenModes all = modes_of(truth, change, truth.layout.modes + kBeyond);
  const Eigen::VectorXd motion = at_channels(truth.layout, all.at_nodes).colwise().squaredNorm().transpose();
  const double least = kLeastMotion * motion.maxCoeff();
  std::vector<Index> kept;
  for (Index i = 0; i < motion.size() && static_cast<int>(kept.size()) < truth.layout.modes; ++i)
    if (motion[i] >= least) kept.push_back(i);
  return {all.frequency_Hz(kept), all.at_nodes(Eigen::all, kept)};
}

double reference_N_m(const Layout& layout) {
  const double bending = layout.materials.front().youngs_modulus_Pa * layout.sections.front().inertia_m4;
  return (layout.girder() ? 48.0 : 12.0) * bending / std::pow(layout.span_m, 3);
}

}  // namespace twindeck::blind::form
