#include <array>
#include <string_view>

#include "blind/form/hidden.hpp"
#include "core/error.hpp"

namespace twindeck::blind::form {

namespace {

/// Twenty trials: S sound, T two states, A temperature or amplitude, F sensor faults, O one state, X outside. The first six
/// hold one of each.
constexpr std::string_view kTurns = "STAFOXSTSAOXSTFASTOX";
static_assert(kTurns.size() == 20);
constexpr std::array<double, 3> kLevels = {0.005, 0.01, 0.02};

Category category_of(char letter) {
  switch (letter) {
    case 'S':
      return Category::sound;
    case 'T':
      return Category::two_states;
    case 'A':
      return Category::conditions;
    case 'F':
      return Category::sensors;
    case 'O':
      return Category::one_state;
    default:
      return Category::outside;
  }
}

/// Kinds of structure that can have a family.
std::vector<Kind> kinds_of(const std::string& family) {
  if (family == "lost") return {Kind::girder_2, Kind::girder_3};
  if (family == "moved" || family == "prop") return {Kind::girder_1, Kind::girder_2, Kind::girder_3};
  if (family == "brace") return {Kind::frame};
  return {Kind::girder_1, Kind::girder_2, Kind::girder_3, Kind::frame};
}

}  // namespace

std::string name_of(Category category) {
  switch (category) {
    case Category::sound:
      return "sound";
    case Category::two_states:
      return "two states";
    case Category::conditions:
      return "temperature, amplitude";
    case Category::sensors:
      return "sensors";
    case Category::one_state:
      return "one state";
    case Category::outside:
      break;
  }
  return "outside";
}

std::vector<std::string> families_of(Category category) {
  switch (category) {
    case Category::sound:
      return {"one test", "two states", "temperatures", "amplitudes", "repeated test"};
    case Category::two_states:
      return {"group", "zone", "mass", "soft bearing", "stiff bearing", "lost", "moved", "prop", "oscillator", "brace", "turn"};
    case Category::conditions:
      return {"temperature of all", "frozen bearing", "sliding bearing"};
    case Category::sensors:
      return {"reversed", "exchanged", "scaled"};
    case Category::one_state:
      return {"mass", "bearing", "oscillator", "zone"};
    case Category::outside:
      break;
  }
  return {"ground turn",       "coupled oscillators", "axial force", "gap",
          "hardening bearing", "nonlinear damper",    "snow",        "vee of temperature"};
}

Turn turn_of(std::uint64_t seed) {
  const std::uint64_t round = seed / kTurns.size(), place = seed % kTurns.size();
  Turn turn;
  turn.category = category_of(kTurns[place]);
  std::uint64_t in_round = 0, before = 0;
  for (std::size_t i = 0; i < kTurns.size(); ++i) {
    in_round += kTurns[i] == kTurns[place] ? 1 : 0;
    before += kTurns[i] == kTurns[place] && i < place ? 1 : 0;
  }
  const std::uint64_t number = round * in_round + before;  // among the trials of this category
  const std::vector<std::string> families = families_of(turn.category);
  turn.family = families[number % families.size()];
  // Where families and levels would keep step, the level moves on by one in each round of the families.
  const std::uint64_t shift = families.size() % kLevels.size() == 0 ? number / families.size() : 0;
  turn.level = kLevels[(number + shift) % kLevels.size()];
  const std::vector<Kind> kinds = kinds_of(turn.family);
  turn.kind = kinds[(number % families.size() + number / families.size()) % kinds.size()];
  return turn;
}

}  // namespace twindeck::blind::form
