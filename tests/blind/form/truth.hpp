#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "blind/form/layout.hpp"
#include "blind/form/plane_frame.hpp"

/// The structure as it really is. Input: a layout, factors of its quantities, what its model lacks (a Form), and what has
/// happened to it (a Change). Output: modes on a mesh of two to three beams a zone.
namespace twindeck::blind::form {

/// A respect in which a real structure differs from a coarse Euler-Bernoulli model of it. Sizes are those at severity 1.
struct Feature {
  enum class What {
    shear,        ///< shear flexibility of the section, times size
    rotary,       ///< rotary inertia of the section, times size
    haunch,       ///< deeper towards supports (girders) or joints (beams of frames)
    stiffness,    ///< bending stiffness that varies along the structure, three cosines
    mass,         ///< mass that varies along the structure, three cosines
    splice,       ///< a joint in a girder that turns, at node `place`; size: L/EI
    joint,        ///< a joint of a frame's beam that turns, at end place % 2 of beam place / 2; size: L/EI
    end_turn,     ///< further hold against turning at bearing `place`; size: EI/L
    eccentric,    ///< bearing `place` off its axis; size: m
    depth,        ///< the bearing that holds along x lies below the axis; size: m
    diaphragm,    ///< a mass at node `place`; size: of the total
    floor,        ///< mass of floor `place` differs; size: ln
    high_floors,  ///< floors' masses lie above the joints; size: m
    infill        ///< a wall braces storey `place`; size: of the storey's stiffness
  };
  What what = What::shear;
  int place = -1;
  double size = 0.0;
  std::array<double, 3> wave{};
};

/// A feature that sits at one place is a cause itself, if it is what makes the form error.
[[nodiscard]] bool is_local(Feature::What what);

struct Form {
  std::vector<Feature> features;
  double severity = 0.0;  ///< factor on all sizes
  int only = -1;          ///< this feature alone acts; -1: all
};
[[nodiscard]] Form draw_form(const Layout& layout, Stream& random);

/// What has happened to the structure in a condition of a test.
struct Change {
  double beams = 1.0;          ///< factor on the stiffness of all beams
  std::map<int, double> beam;  ///< … of one beam of the coarse model
  std::map<int, double> material;
  std::map<int, double> bearing;  ///< factor on a bearing's translational stiffness
  std::map<int, double> turn;     ///< … and on its rotational stiffness
  std::map<int, double> shift_m;  ///< how far a bearing stands from its place along x
  struct ToGround {
    int node, direction;  ///< 0 x, 1 z, 2 turn
    double N_m;
  };
  std::vector<ToGround> to_ground;
  struct Tie {
    int from, to;
    double N_m;
  };
  std::vector<Tie> ties;
  std::vector<Floor> masses;
  struct Chain {
    int node;
    std::vector<std::pair<double, double>> kg_Hz;  ///< each mass hangs on the one before it, the first on the node
  };
  std::vector<Chain> chains;
  double compression_N = 0.0;  ///< in all beams of a girder, all columns of a frame
  struct Damper {
    int node;
    double N_m, N_s_m;  ///< spring and dashpot in series, to the ground
  };
  std::optional<Damper> damper;
};

struct Truth {
  Layout layout;
  Eigen::VectorXd factors;  ///< (n_quantities)
  Form form;
};

/// Modes as the coarse model's nodes see them, in ascending frequency.
struct SeenModes {
  Eigen::VectorXd frequency_Hz;  ///< (n)
  Eigen::MatrixXd at_nodes;      ///< (2 n_coarse_nodes × n) x and z of each node, mass-normalised
};

/// @param lowest  so many modes, those too that move no channel
[[nodiscard]] SeenModes modes_of(const Truth& truth, const Change& change, int lowest);
/// The same of those that move the channels, as a test would find them: the lowest `layout.modes` of them.
[[nodiscard]] SeenModes measurable_modes(const Truth& truth, const Change& change);
/// (n_channels × n) of modes at nodes.
[[nodiscard]] Eigen::MatrixXd at_channels(const Layout& layout, const Eigen::MatrixXd& at_nodes);

/// Stiffness against a vertical (girder) or horizontal (frame) force that makes forces of the layout comparable:
/// 48 EI/L³ of the longest span, 12 EI/h³ of a column.
[[nodiscard]] double reference_N_m(const Layout& layout);

}  // namespace twindeck::blind::form
