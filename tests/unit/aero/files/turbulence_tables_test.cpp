// Oracles: the file's own numbers; each kind of mistake is refused with the words a user needs.
#include <gtest/gtest.h>

#include <string>

#include "aero/files/turbulence_files.hpp"
#include "core/error.hpp"
#include "unit/records/scratch.hpp"

namespace twindeck::aero {
namespace {

using wind::Component;

/// What `read` makes of a file with that text.
template <typename Read>
auto read_text(const Read& read, const std::string& text) {
  const records::Scratch scratch;
  return read(scratch.write("turbulence.csv", text), {Component::along, Component::vertical});
}

template <typename Read>
void expect_line(const Read& read, const std::string& text, const std::string& words) {
  try {
    static_cast<void>(read_text(read, text));
    ADD_FAILURE() << "was read: " << text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

// f S = 1/3.5 from n = 1 to e, which is 1 in all (spectrum_test).
const std::string kFlat = "1,0.2857143\nLETTER,2.718281828,0.2857143\n";
std::string flat(const std::string& letter) {
  return letter + "," + std::string(kFlat).replace(kFlat.find("LETTER"), 6, letter);
}

TEST(TurbulenceTables, SpectraStandByTheirLetters) {
  const std::string head = "component,f_L_over_V,f_S_over_variance\n";
  const auto found = read_text(read_spectra, head + flat("w") + flat("v"));
  ASSERT_TRUE(found[0] && found[2]);
  EXPECT_FALSE(found[1]);
  EXPECT_NEAR(found[2]->density(2.0), 0.2857143 / 2.0, 1e-12);
  expect_line(read_spectra, head + flat("v"), "has too few rows of w (0), expected at least two");
  expect_line(read_spectra, head + flat("x"), "write v (along the wind), u (across it) or w (vertical)");
  expect_line(read_spectra, head + flat("w") + "v,2,0.3\nv,2,0.3\n", ":5: f_L_over_V: is 2 after 2");
  expect_line(read_spectra, head + flat("w") + "v,1,0.3\nv,2,0\n", ":5: f_S_over_variance: is 0, expected a positive number");
  expect_line(read_spectra, head + flat("w") + "v,1,0.2\nv,2.718281828,0.2\n", "of v integrates to 0.7 of the variance");
}

TEST(TurbulenceTables, CoherencesBeginWithOneAndDieOut) {
  const std::string head = "component,reduced_separation,coherence\n", whole = "w,0,1\nw,2,-0.1\nw,3,0\n";
  const auto found = read_text(read_coherences, head + whole + "v,0,1\nv,4,0.005\n");
  ASSERT_TRUE(found[0] && found[2]);
  EXPECT_NEAR(found[2]->at(1.0), 0.45, 1e-15);
  expect_line(read_coherences, head + whole + "v,0,1\nv,1,1.2\nv,4,0\n",
              ":6: coherence: is 1.2, expected a number from -1 to 1");
  expect_line(read_coherences, head + whole + "v,0.1,1\nv,4,0\n", "is 1 at 0.1, expected 1 at 0");
  expect_line(read_coherences, head + whole + "v,0,1\nv,4,0.02\n", ":6: coherence: is 0.02 in the last row of v");
}

}  // namespace
}  // namespace twindeck::aero
