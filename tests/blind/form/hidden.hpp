#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "blind/form/truth.hpp"

/// What a trial hides, and which answers name it.
namespace twindeck::blind::form {

enum class Category { sound, two_states, conditions, sensors, one_state, outside };
[[nodiscard]] std::string name_of(Category category);

/// Which trial a seed is: of twenty seeds in a row five are sound, four of two states, three of temperature or amplitude, two
/// of sensor faults, three of one state, three outside the catalogue. Families, kinds of structure and levels go round within
/// each.
struct Turn {
  Category category = Category::sound;
  std::string family;  ///< of hidden causes; of a sound trial the test that is made
  Kind kind = Kind::girder_1;
  double level = 0.0;  ///< form error that is asked for, relative
};
[[nodiscard]] Turn turn_of(std::uint64_t seed);
/// Families of hidden causes, those outside the catalogue among them.
[[nodiscard]] std::vector<std::string> families_of(Category category);

/// Answers that are right: a family at an exact place, or within reach of a point.
struct Sought {
  std::set<std::string> families;
  std::vector<std::string> locations;
  std::optional<Eigen::Vector2d> where;  ///< for nodes and zones
  double reach_m = 0.0;
};
/// Whether an answer, "mass@node:7", is one of them. What follows the place in brackets or after '#' (a state) is not looked
/// at.
[[nodiscard]] bool names(const Layout& layout, const Sought& sought, const std::string& answer);
/// Answers that name a feature of the form which sits at one place.
[[nodiscard]] Sought sought_of(const Layout& layout, const Feature& feature);

struct SensorFault {
  enum class What { none, reversed, exchanged, scaled } what = What::none;
  int channel = -1, other = -1;
  double factor = 1.0;
};

struct TestCondition {
  std::string name;
  bool after = false;  ///< in the second state
  std::optional<double> temperature_C, amplitude_m;
  Change change;
};

struct Hidden {
  Turn turn;
  std::string words;  ///< "pier_1 x 0.31"
  Sought sought;
  std::string size_name;  ///< of the catalogue's unknown; "" where the cause has no size
  double size = 0.0;
  std::vector<TestCondition> conditions;
  SensorFault fault;
};

/// Draws a place and a size for a turn's family, and the conditions of the test.
/// @param sound_Hz  frequencies of the truth before anything happens
[[nodiscard]] Hidden draw_hidden(const Layout& layout, const Turn& turn, const Eigen::VectorXd& sound_Hz, Stream& random);

}  // namespace twindeck::blind::form
