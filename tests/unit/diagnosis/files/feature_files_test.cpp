// A features folder as the diagnosis takes it. Oracles: the numbers of the files that were written; the message as a user reads
// it.
#include "diagnosis/files/feature_files.hpp"

#include "npy_double.hpp"
#include "unit/io/temporary_folder.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureSet;
using diagnosis::RowType;

class FeatureFiles : public io::test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    write("conditions.toml",
          "[calm]\ndampers = \"on\"\namplitude_m = 0.01\namplitude_channel = \"b\"\ntemperature_C = -4.5\n\n[windy]\nstate = "
          "\"repaired\"\nwind_m_s = 12.0\ndirection_deg = 200.0\npeople = 3\nload = \"truck\"\n");
    write("channels.csv", "channel,point,dx,dy,dz\na,1,1,0,0\nb,2,0,0,-1\nc,3,0,1,0\n");
    write("rows.csv",
          "type,mode,channel,condition,value,std,held_out\nfrequency_Hz,1,,windy,2.5,0.01,\nshape,1,b,calm,1.0,0.02,0\n"
          "shape,1,c,calm,-0.5,0.03,1\nfrequency_Hz,1,,calm,2.6,0.04,\ndamping_ratio_pct,1,,calm,0.7,0.1,\n"
          "stay_frequency_Hz,2,NE5,calm,1.5,0.05,\nstatic_m,,a,windy,-0.002,1e-4,\n");
  }
  FeatureSet read(const records::MeasuredChoice& choice = {}) const { return diagnosis::read_all_features(folder_, choice); }
  std::string said(const records::MeasuredChoice& choice = {}) const {
    return refusal([&] { (void)read(choice); });
  }
};

TEST_F(FeatureFiles, GiveEveryRowWithItsConditionAndChannel) {
  const FeatureSet f = read();
  EXPECT_EQ(f.channels, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(f.direction[1], Eigen::Vector3d(0.0, 0.0, -1.0));
  ASSERT_EQ(f.rows.size(), 7U);
  const RowType types[] = {RowType::frequency,          RowType::shape,   RowType::shape,
                           RowType::frequency,          RowType::damping, RowType::stay_frequency,
                           RowType::static_displacement};
  const int channel[] = {-1, 1, 2, -1, -1, -1, 0};
  const double value[] = {2.5, 1.0, -0.5, 2.6, 0.7, 1.5, -0.002}, std[] = {0.01, 0.02, 0.03, 0.04, 0.1, 0.05, 1e-4};
  const std::string conditions[] = {"windy", "calm", "calm", "calm", "calm", "calm", "windy"};
  for (std::size_t r = 0; r < 7; ++r) {
    EXPECT_EQ(f.rows[r].type, types[r]) << r;
    EXPECT_EQ(f.rows[r].channel, channel[r]) << r;
    EXPECT_EQ(f.rows[r].value, value[r]) << r;
    EXPECT_EQ(f.rows[r].std, std[r]) << r;
    EXPECT_EQ(f.rows[r].held_out, r == 2) << r;
    EXPECT_EQ(f.rows[r].line, static_cast<long>(r) + 2) << r;
    EXPECT_EQ(f.rows[r].stay, r == 5 ? "NE5" : "") << r;
    EXPECT_EQ(f.conditions[static_cast<std::size_t>(f.rows[r].condition)].name, conditions[r]) << r;
  }
  EXPECT_EQ(f.rows[5].mode, "2");
  EXPECT_EQ(f.covariance.size(), 0);
}

TEST_F(FeatureFiles, ConditionsHaveTheirCircumstances) {
  const FeatureSet f = read();
  ASSERT_EQ(f.conditions.size(), 2U);
  const auto &calm = f.conditions[0].name == "calm" ? f.conditions[0] : f.conditions[1],
             &windy = f.conditions[0].name == "calm" ? f.conditions[1] : f.conditions[0];
  EXPECT_EQ(calm.state, "reference");
  EXPECT_EQ(calm.dampers_on, std::optional<bool>(true));
  EXPECT_EQ(calm.amplitude_m, std::optional<double>(0.01));
  EXPECT_EQ(calm.amplitude_channel, "b");
  EXPECT_EQ(calm.temperature_C, std::optional<double>(-4.5));
  EXPECT_FALSE(calm.wind_m_s || calm.direction_deg || calm.people);
  EXPECT_EQ(calm.line, 1);
  EXPECT_EQ(windy.state, "repaired");
  EXPECT_FALSE(windy.dampers_on || windy.amplitude_m || windy.temperature_C);
  EXPECT_EQ(windy.wind_m_s, std::optional<double>(12.0));
  EXPECT_EQ(windy.direction_deg, std::optional<double>(200.0));
  EXPECT_EQ(windy.people, std::optional<double>(3.0));
  EXPECT_EQ(windy.load, "truck");
  EXPECT_EQ(windy.line, 7);
}

TEST_F(FeatureFiles, AChosenConditionKeepsItsRowsAndTheirCovariance) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(7, 7);
  for (int i = 0; i < 7; ++i) covariance(i, i) = 1.0 + i;
  covariance(3, 1) = covariance(1, 3) = 0.25;
  io::write_npy(covariance, folder_ / "covariance.npy");
  records::MeasuredChoice choice;
  choice.conditions.condition = "calm";
  const FeatureSet f = read(choice);
  ASSERT_EQ(f.conditions.size(), 1U);
  ASSERT_EQ(f.rows.size(), 5U);
  EXPECT_EQ(f.rows[0].value, 1.0);
  EXPECT_EQ(f.rows[2].value, 2.6);
  for (const auto& row : f.rows) EXPECT_EQ(row.condition, 0);
  Eigen::MatrixXd expected = Eigen::Vector<double, 5>(2.0, 3.0, 4.0, 5.0, 6.0).asDiagonal();
  expected(2, 0) = expected(0, 2) = 0.25;
  EXPECT_EQ(f.covariance, expected);
}

TEST_F(FeatureFiles, QualityIsTheWorstOfEachChannelByItsCorrectedName) {
  write("quality.csv", "channel,samples,clipped,drift_rms,remark\na,1000,20,-0.3,x\na,500,25,0.1,\nb,0,7,0.2,\nc,100,,,\n");
  records::MeasuredChoice choice;
  choice.corrections.push_back({"a", records::Correction::Action::exchange, "c"});
  const FeatureSet plain = read(), f = read(choice);
  EXPECT_EQ(plain.clipped.at("a"), 0.05);
  EXPECT_EQ(plain.drift.at("a"), 0.3);
  EXPECT_EQ(plain.drift.at("b"), 0.2);
  EXPECT_FALSE(plain.clipped.contains("b"));  // of no samples nothing is said
  EXPECT_EQ(f.clipped.at("c"), 0.05);
  EXPECT_EQ(f.drift.at("c"), 0.3);
  EXPECT_EQ(f.clipped.at("a"), 0.0);
}

TEST_F(FeatureFiles, CorrectionsAreInTheRows) {
  records::MeasuredChoice choice;
  choice.corrections = {{"b", records::Correction::Action::reverse, ""},
                        {"c", records::Correction::Action::scale, "", 2.0},
                        {"b", records::Correction::Action::exchange, "c"}};
  const FeatureSet f = read(choice);
  EXPECT_EQ(f.rows[1].value, -1.0);
  EXPECT_EQ(f.channels[static_cast<std::size_t>(f.rows[1].channel)], "c");
  EXPECT_EQ(f.rows[2].value, -1.0);
  EXPECT_NEAR(f.rows[2].std, 0.06, 1e-15);
  EXPECT_EQ(f.channels[static_cast<std::size_t>(f.rows[2].channel)], "b");
  EXPECT_EQ(f.conditions[static_cast<std::size_t>(f.rows[1].condition)].amplitude_channel, "c");
}

TEST_F(FeatureFiles, WhatDoesNotFitTogetherIsRefused) {
  write("channels.csv", "channel,point,dx,dy,dz\na,1,1,0,0\nbb,2,0,0,1\nc,3,0,1,0\n");
  EXPECT_EQ(said(), "conditions.toml: amplitude_channel: 'b' of condition calm is not in channels.csv");
  SetUp();
  records::MeasuredChoice choice;
  choice.corrections.push_back({"d", records::Correction::Action::reverse, ""});
  EXPECT_NE(said(choice).find("'d'"), std::string::npos) << said(choice);
  write("rows.csv", "type,mode,channel,condition,value,std\nfrequency_Hz,1,,calm,2.6,0.04\n");
  choice = {};
  choice.conditions.condition = "windy";
  EXPECT_EQ(said(choice), "rows.csv: holds no row that can be used");
  EXPECT_EQ(said(), "");
}

fe::Model with_stays() {
  fe::Model model;
  fe::Element stay;
  stay.type = fe::ElementType::stay;
  stay.name = "NE5";
  stay.id = 4;
  model.elements.push_back(stay);
  stay.name = "";
  stay.id = 31;
  model.elements.push_back(stay);
  fe::Element beam;
  beam.name = "girder";
  model.elements.push_back(beam);
  return model;
}

TEST_F(FeatureFiles, AStayThatTheModelLacksIsRefusedWithItsLine) {
  const fe::Model model = with_stays(), none;
  FeatureSet f = read();
  const auto unknown = [&](const fe::Model* of) { return refusal([&] { diagnosis::refuse_unknown_stays(f, of, folder_); }); };
  EXPECT_EQ(unknown(&model), "");
  f.rows[5].stay = "31";  // a stay without a name goes by its number
  EXPECT_EQ(unknown(&model), "");
  f.rows[5].stay = "girder";
  EXPECT_EQ(unknown(&model), "rows.csv:7: channel: 'girder' is no stay of the model; name a stay of the model's elements.csv");
  f.rows[5].stay = "NE6";
  EXPECT_EQ(
      unknown(&model),
      "rows.csv:7: channel: 'NE6' is no stay of the model (did you mean 'NE5'?); name a stay of the model's elements.csv");
  const std::string out =
      "rows.csv:7: channel: 'NE6' is no stay of the model; the model has no stays; leave the row out, or stay_frequency_Hz as "
      "a whole (left_out)";
  EXPECT_EQ(unknown(nullptr), out);
  EXPECT_EQ(unknown(&none), out);
  f.rows.erase(f.rows.begin() + 5);
  EXPECT_EQ(unknown(nullptr), "");
}

TEST_F(FeatureFiles, AStayWithoutAPullIsRefusedWithItsLine) {
  const FeatureSet f = read();
  diagnosis::Places places;
  const auto slack = [&] { return refusal([&] { diagnosis::refuse_slack_stays(f, places, folder_); }); };
  const std::string refused =
      "rows.csv:7: channel: stay 'NE5' has no pull in the model, so that its frequency is not computed; give its pull in "
      "elements.csv and a rule of prestress in model.toml, or leave the row out";
  EXPECT_EQ(slack(), refused);
  diagnosis::Place stay{"stay:NE5", Eigen::Vector3d::Zero(), {}, {}, {}, {}, {}}, other = stay;
  other.id = "stay:NE6";
  other.attributes["f_cable"] = 1.2;
  places.sets["stays"] = {stay, other};
  EXPECT_EQ(slack(), refused);
  places.sets["stays"][0].attributes["f_cable"] = 1.5;
  EXPECT_EQ(slack(), "");
}

TEST_F(FeatureFiles, ALoadThatTheModelLacksIsRefusedWithItsLine) {
  const auto unknown = [&] { return refusal([&] { diagnosis::refuse_unknown_loads(folder_, folder_ / "model"); }); };
  EXPECT_EQ(unknown(), "conditions.toml:12: load: names the load case 'truck', but the model has none: " +
                           (folder_ / "model/loads.csv").string() +
                           " is not there or empty; write the file with columns load,node,direction,value,unit, or leave the "
                           "key out");
  write("model/loads.csv", "load,node,direction,value,unit\ntrucks,1,z,-1000,N\ncrowd,1,z,-10,N\n");
  EXPECT_EQ(unknown(), "conditions.toml:12: load: 'truck' is no load case of " + (folder_ / "model/loads.csv").string() +
                           " (did you mean 'trucks'?); name one of trucks, crowd, or add it there");
  write("model/loads.csv", "load,node,direction,value,unit\ntrucks,1,z,-1000,N\ntruck,1,z,-10,N\n");
  EXPECT_EQ(unknown(), "");
}

}  // namespace
}  // namespace twindeck::tests
