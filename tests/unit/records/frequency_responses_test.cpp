// Oracles: the accelerance of a modal model in closed form, written by the test's own writer; reciprocity; the words of
// refusals.
#include "records/frequency_responses.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "records/inspect.hpp"
#include "scratch.hpp"
#include "universal_responses.hpp"

namespace twindeck::records {
namespace {

using test::WrittenFunction;

test::ModalModel two_modes() {
  test::ModalModel model;
  model.frequency_Hz = Eigen::Vector2d(5.0, 9.0);
  model.damping_ratio = Eigen::Vector2d(0.01, 0.02);
  model.shapes.resize(4, 2);
  model.shapes << 0.3, 0.8, 0.6, 0.4, 0.9, -0.3, 1.2, -0.7;
  return model;
}

const Eigen::VectorXd kLines = Eigen::VectorXd::LinSpaced(81, 2.0, 12.0);

/// The function of points 1 … 4, direction z.
WrittenFunction function_between(long response, long reference) {
  WrittenFunction w;
  w.response = response;
  w.reference = reference;
  w.f = kLines;
  w.h = two_modes().accelerance(response - 1, reference - 1, kLines);
  return w;
}

/// Responses at all points to the hammer at point 1, or with the hammer roving and the sensor at point 1.
std::vector<WrittenFunction> one_test(bool hammer_roves) {
  std::vector<WrittenFunction> all;
  for (long point = 1; point <= 4; ++point)
    all.push_back(hammer_roves ? function_between(1, point) : function_between(point, 1));
  return all;
}

const char* const kAsWritten =
    "[[record]]\nsetup = \"ST1\"\nfile = \"h.unv\"\nchannels = [\"1+z\", \"2+z\", \"3+z\", \"4+z\"]\n";

/// Writes a campaign around the file h.unv. @param toml  campaign.toml
void write_campaign(const Scratch& scratch, const std::vector<WrittenFunction>& functions, bool binary = false,
                    const std::string& toml = kAsWritten, const std::string& quantity = "acceleration,m/s^2") {
  std::string channels = "channel,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain\n", text;
  for (int point = 1; point <= 4; ++point) channels += fmt::format("{}+z,{},0,0,0,0,1,{},1\n", point, point, quantity);
  scratch.write("channels.csv", channels);
  scratch.write("campaign.toml", toml);
  for (const WrittenFunction& w : functions) text += universal_function(w, binary);
  scratch.write("h.unv", text);
}

FrequencyResponses read_responses(const Scratch& scratch) {
  const Campaign campaign = read_campaign(scratch.file(""));
  return read_frequency_responses(campaign, record_groups(campaign, {"", "", kFrfKind, {}}).front());
}

std::string refusal_of(const std::vector<WrittenFunction>& functions, const std::string& toml = kAsWritten,
                       const std::string& quantity = "acceleration,m/s^2") {
  const Scratch scratch;
  write_campaign(scratch, functions, false, toml, quantity);
  try {
    static_cast<void>(read_responses(scratch));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

// Text has 12 digits, single precision seven, and the uneven abscissa of binary sets is single too.
TEST(FrequencyResponses, TextAndBinarySingleAndDoubleEvenAndUnevenAreRead) {
  for (const bool binary : {false, true})
    for (const bool even : {false, true})
      for (const int data_type : {5, 6})
        for (const bool roves : {false, true}) {
          const Scratch scratch;
          std::vector<WrittenFunction> functions = one_test(roves);
          for (WrittenFunction& w : functions) {
            w.data_type = data_type;
            w.even = even;
          }
          write_campaign(scratch, functions, binary);
          const FrequencyResponses read = read_responses(scratch);
          ASSERT_EQ(read.values.cols(), 4);
          EXPECT_EQ(read.others, std::vector<std::string>{"1+z"});
          EXPECT_EQ(read.quantity, "acceleration");
          EXPECT_LT((read.frequency_Hz - kLines).cwiseAbs().maxCoeff(), 1e-5);
          for (Eigen::Index c = 0; c < 4; ++c) {
            const Eigen::VectorXcd truth = two_modes().accelerance(c, 0, kLines);
            EXPECT_LT((read.values.col(c) - truth).norm(), (data_type == 5 ? 1e-6 : 1e-10) * truth.norm());
          }
        }
}

// One file a point, in their own order; velocities over force are accelerations divided by i omega.
TEST(FrequencyResponses, FilesOfOnePointEachAreOneSetupAndQuantitiesAreConverted) {
  const Scratch scratch;
  std::string toml, channels = "channel,quantity,unit,gain\n";
  for (long point = 4; point >= 1; --point) {
    WrittenFunction w = function_between(point, 2);
    channels += fmt::format("{}+z,{},1\n", point, point == 1 ? "velocity,m/s" : "acceleration,m/s^2");
    if (point == 1) {
      w.h.array() /= std::complex<double>(0.0, 2.0 * std::numbers::pi) * kLines.array();
      w.quantity = 11;
      w.unit = "m/s";
    }
    scratch.write(fmt::format("p{}.unv", point), universal_function(w, true));
    toml += fmt::format("[[record]]\nsetup = \"ST1\"\nfile = \"p{}.unv\"\nchannels = [\"{}+z\"]\n", point, point);
  }
  scratch.write("channels.csv", channels);
  scratch.write("campaign.toml", toml);
  const FrequencyResponses read = read_responses(scratch);
  EXPECT_EQ(read.channels, (std::vector<std::string>{"4+z", "3+z", "2+z", "1+z"}));
  for (Eigen::Index c = 0; c < 4; ++c) {
    const Eigen::VectorXcd truth = two_modes().accelerance(3 - c, 1, kLines);
    EXPECT_LT((read.values.col(c) - truth).norm(), 1e-10 * truth.norm()) << c;
  }
}

TEST(FrequencyResponses, ALineAtZeroIsLeftOutAndCoherencesToo) {
  const Scratch scratch;
  std::vector<WrittenFunction> functions = one_test(false);
  for (WrittenFunction& w : functions) {
    w.f = Eigen::VectorXd::LinSpaced(81, 0.0, 12.0);
    w.h[0] = std::numeric_limits<double>::quiet_NaN();
  }
  functions.push_back(functions[1]);
  functions.back().function = 6;
  functions.back().data_type = 4;
  write_campaign(scratch, functions);
  const FrequencyResponses read = read_responses(scratch);
  EXPECT_EQ(read.frequency_Hz.size(), 80);
  EXPECT_GT(read.frequency_Hz[0], 0.0);
  ASSERT_FALSE(read.notes.empty());
  expect_words(read.notes.front(), {"h.unv", "1 coherences are left out"});
}

TEST(FrequencyResponses, GainsAndUnitsAreApplied) {
  const Scratch scratch;
  std::vector<WrittenFunction> functions = one_test(false);
  for (WrittenFunction& w : functions) w.unit = "g";
  write_campaign(scratch, functions, false, kAsWritten, "acceleration,g");
  EXPECT_NE(refusal_of(functions).find("channels.csv"), std::string::npos);  // g in the file, m/s^2 there
  std::string channels = "channel,quantity,unit,gain\n";
  for (int point = 1; point <= 4; ++point)
    channels += fmt::format("{}+z,acceleration,g,{}\n", point, point == 2 ? -9.80665 : 9.80665);
  scratch.write("channels.csv", channels);
  const FrequencyResponses read = read_responses(scratch);
  EXPECT_LT((read.values.col(0) - 9.80665 * functions[0].h).norm(), 1e-9 * functions[0].h.norm());
  EXPECT_LT((read.values.col(1) + 9.80665 * functions[1].h).norm(), 1e-9 * functions[1].h.norm());
}

TEST(FrequencyResponses, InspectionTellsThePoints) {
  const Scratch scratch;
  write_campaign(scratch, one_test(true));
  std::string text;
  for (const std::string& line : describe(inspect(scratch.file("h.unv")))) text += line + "\n";
  expect_words(text, {"4 frequency response functions, 4 points, 1 responses (the hammer roved), 81 lines, 2 to 12 Hz", "3+z"});
  EXPECT_EQ(text.find("sampling rate"), std::string::npos);
}

TEST(FrequencyResponses, WhatIsNoneIsRefusedByNameAndPlace) {
  const auto changed = [](const auto& change) {
    std::vector<WrittenFunction> functions = one_test(false);
    change(functions[2]);
    return refusal_of(functions);
  };
  expect_words(changed([](WrittenFunction& w) { w.reference = w.reference_direction = 0; }),
               {"h.unv", "set 58 number 3", "names no reference node"});
  expect_words(changed([](WrittenFunction& w) { w.response = w.response_direction = 0; }), {"names no response node"});
  expect_words(changed([](WrittenFunction& w) { w.data_type = 4; }), {"real values", "without phase"});
  expect_words(changed([](WrittenFunction& w) { w.function = 2; }), {"auto-spectrum", "expected frequency response"});
  expect_words(changed([](WrittenFunction& w) { w.function = 1, w.abscissa = 17, w.data_type = 4; }), {"1 time series"});
  expect_words(changed([](WrittenFunction& w) { w.f *= 1.001; }), {"81 lines", "2.002", "but the first function has 81"});
  expect_words(changed([](WrittenFunction& w) { w.over = 12; }), {"data of type 12 over data of type 12"});
  expect_words(changed([](WrittenFunction& w) { w.quantity = 11; }), {"3+z", "is velocity over force"});
  expect_words(changed([](WrittenFunction& w) { w.h[7] = NAN; }), {"no number at 2.875 Hz"});
  expect_words(changed([](WrittenFunction& w) { w.h.setZero(); }), {"3+z", "is 0 at all lines"});
  expect_words(changed([](WrittenFunction& w) { w.response = 2; }), {"3+z"});
  std::vector<WrittenFunction> functions = one_test(false);
  functions.push_back(function_between(2, 3));
  expect_words(refusal_of(functions), {"1+z", "has no function for reference 3+z"});
  functions.back() = function_between(2, 1);
  expect_words(refusal_of(functions), {"2+z", "is there twice for reference 1+z"});
}

TEST(FrequencyResponses, KindsThatContradictTheFileAreRefused) {
  const std::string stated = std::string(kAsWritten) + "kind = \"ambient\"\n";
  expect_words(refusal_of(one_test(false), stated), {"campaign.toml:5", "is \"ambient\"", "frequency response functions"});
  const std::string mixed = std::string(kAsWritten) +
                            "[[record]]\nsetup = \"ST1\"\nkind = \"wind\"\nfile = \"w.csv\"\nsampling_rate_Hz = 50\n"
                            "channels = [\"1+z\"]\n";
  expect_words(refusal_of(one_test(false), mixed), {"campaign.toml:6", "ST1 holds time series", "line 1"});
  std::vector<WrittenFunction> series = one_test(false);
  for (WrittenFunction& w : series) w.function = 1, w.abscissa = 17, w.data_type = 4;
  expect_words(refusal_of(series, std::string(kAsWritten) + "kind = \"frf\"\n"), {"h.unv", "time series"});
  expect_words(refusal_of(series), {"campaign.toml:1", "sampling_rate_Hz", "is missing"});
}

}  // namespace
}  // namespace twindeck::records
