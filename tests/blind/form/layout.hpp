#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "blind/form/stream.hpp"
#include "fe/model.hpp"

/// What an engineer has drawn: the structure that the coarse model and the truth have in common. The model takes it as it is;
/// the truth adds what drawings leave out (truth.hpp).
namespace twindeck::blind::form {

enum class Kind { girder_1, girder_2, girder_3, frame };
[[nodiscard]] std::string name_of(Kind kind);

/// A beam of the coarse model.
struct CoarseBeam {
  int from = 0, to = 0;
  int material = 0, section = 0;
  bool column = false;
};
struct Material {
  std::string name;
  double youngs_modulus_Pa, density_kg_m3;
};
struct Section {
  std::string name;
  double area_m2, inertia_m4, depth_m;
};
/// Springs between a node and the ground. Turning springs are a group of their own, NAME_turn.
struct Bearing {
  std::string name;
  int node = 0;
  double x_N_m = 0.0, z_N_m = 0.0, turn_N_m = 0.0;  ///< 0: free
};
struct Floor {
  int node = 0;
  double kg = 0.0;
};
/// A bounded parameter of the fit: a factor on what it names.
struct Quantity {
  enum class Of { modulus, density, springs, floors };
  std::string name;
  Of of = Of::modulus;
  std::vector<int> materials;       ///< positions, for a modulus or a density
  std::vector<std::string> groups;  ///< of springs
  double lower = 1.0, upper = 1.0;  ///< factors
};

struct Layout {
  Kind kind = Kind::girder_1;
  std::vector<Eigen::Vector2d> nodes;
  std::vector<CoarseBeam> beams;
  std::vector<Material> materials;
  std::vector<Section> sections;
  std::vector<Bearing> bearings;
  std::vector<Floor> floors;
  std::vector<Quantity> quantities;
  std::vector<int> channel_nodes;
  int direction = 1;                  ///< of the channels: 0 x, 1 z
  int modes = 8;                      ///< measured
  int first_fixed = -1;               ///< node that is held along x; -1: none
  double span_m = 1.0, zone_m = 1.0;  ///< a typical span or storey; the length of a beam
  double total_kg = 0.0;
  [[nodiscard]] double length_m() const { return nodes.back().x() - nodes.front().x(); }
  [[nodiscard]] double height_m() const { return nodes.back().y() - nodes.front().y(); }
  [[nodiscard]] bool girder() const { return kind != Kind::frame; }
};

/// A structure of a kind with drawn sizes: girders of 12 to 18 beams, 5 to 7 parameters; frames of seven or eight storeys, 5
/// parameters; 10 to 16 channels, 6 to 10 modes.
[[nodiscard]] Layout draw_layout(Kind kind, Stream& random);

/// The model that is fitted: Euler-Bernoulli beams, uniform, one a zone, rigid joints.
[[nodiscard]] fe::Model coarse_model(const Layout& layout);

/// Name of a channel: "c7z", at node 7 of the model (ids from 1).
[[nodiscard]] std::string channel_name(const Layout& layout, int channel);

}  // namespace twindeck::blind::form
