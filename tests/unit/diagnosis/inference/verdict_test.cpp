// The rules of the verdict, case by case. Oracle: the rules as decision 0013 states them.
#include "diagnosis/inference/verdict.hpp"

#include <gtest/gtest.h>

namespace twindeck::tests {
namespace {

using diagnosis::guarded;
using diagnosis::rule;
using diagnosis::Verdict;
using diagnosis::Weighed;

Weighed change(double leader) {
  Weighed w;
  w.none = -100.0;
  w.something_else = -103.0;
  w.leader = leader;
  w.in_all_conditions = false;
  w.kappa = 0.001;
  w.effect = 0.02;
  return w;
}

TEST(Rules, OneClearChangeIsNamed) {
  const auto r = rule(change(-90.0));
  EXPECT_EQ(r.verdict, Verdict::named);
  EXPECT_DOUBLE_EQ(r.against_none, 10.0);
  EXPECT_DOUBLE_EQ(r.against_both, 10.0);
  EXPECT_DOUBLE_EQ(r.threshold, 3.0);
  EXPECT_FALSE(r.something_else_in_set);
}

TEST(Rules, ThresholdIsThreeForAChangeAndThirtyTwoForWhatActsInAllConditions) {
  EXPECT_EQ(rule(change(-97.1)).verdict, Verdict::none);
  EXPECT_EQ(rule(change(-96.9)).verdict, Verdict::named);
  Weighed w = change(-68.1);
  w.in_all_conditions = true;
  w.something_else = -1e300;
  EXPECT_EQ(rule(w).verdict, Verdict::none);
  w.leader = -67.9;
  EXPECT_EQ(rule(w).verdict, Verdict::named);
}

TEST(Rules, SeveralMembersAreAmbiguous) {
  Weighed w = change(-90.0);
  w.members = 2;
  EXPECT_EQ(rule(w).verdict, Verdict::ambiguous);
  EXPECT_FALSE(rule(w).something_else_in_set);
}

TEST(Rules, SomethingElseIsAMemberUnlessTheLeaderIsFarAhead) {
  Weighed w = change(-90.0);
  w.none = -300.0;
  w.something_else = -114.9;
  EXPECT_EQ(rule(w).verdict, Verdict::ambiguous);
  EXPECT_TRUE(rule(w).something_else_in_set);
  w.something_else = -115.1;
  EXPECT_EQ(rule(w).verdict, Verdict::named);
  EXPECT_FALSE(rule(w).something_else_in_set);
  w.something_else = -114.9;
  w.none = -114.8;  // a generic change explains nothing: it is no rival
  EXPECT_EQ(rule(w).verdict, Verdict::named);
}

TEST(Rules, SomethingElseThatExplainsMoreMakesItUnknown) {
  Weighed w = change(-90.0);
  w.something_else = -92.0;
  auto r = rule(w);
  EXPECT_EQ(r.verdict, Verdict::ambiguous);
  EXPECT_TRUE(r.something_else_in_set);
  w.something_else = -88.0;  // above the leader, but by less than three
  r = rule(w);
  EXPECT_EQ(r.verdict, Verdict::ambiguous);
  EXPECT_TRUE(r.something_else_in_set);
  w.something_else = -86.9;
  r = rule(w);
  EXPECT_EQ(r.verdict, Verdict::unknown);
  EXPECT_FALSE(r.something_else_in_set);
}

TEST(Rules, MisfitWidensTheOddsAndThenForbidsAName) {
  Weighed w = change(-90.0);
  w.chi_squared_ratio = 1.6;
  EXPECT_DOUBLE_EQ(rule(w).against_none, 10.0 / 1.6);
  EXPECT_EQ(rule(w).verdict, Verdict::named);
  w.chi_squared_ratio = 2.1;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
  w.chi_squared_ratio = 0.3;  // a good fit narrows nothing
  EXPECT_DOUBLE_EQ(rule(w).against_none, 10.0);
}

TEST(Rules, BetweenStatesTheErrorOfALargeEffectMayBeLeft) {
  Weighed w;
  w.none = 0.0;
  w.leader = 4000.0;
  w.chi_squared_ratio = 2.4;
  w.none_chi_squared_ratio = 80.0;
  w.in_all_conditions = false;
  w.effect = 0.05;
  w.size_error = 0.15;  // leaves 1 + 0.15² (80 - 1) = 2.78
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
  w.between_states = true;
  EXPECT_EQ(rule(w).verdict, Verdict::named);
  w.chi_squared_ratio = 2.9;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
}

TEST(Rules, ALargeLeftoverBesideTheEffectIsUnknown) {
  Weighed w = change(-90.0);  // an effect of 0.02
  w.kappa = 0.0079;
  EXPECT_EQ(rule(w).verdict, Verdict::named);
  w.kappa = 0.0081;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
}

TEST(Rules, BetweenStatesALargeLeftoverDoesNotCountFarAheadOfSomethingElse) {
  Weighed w = change(-90.0);
  w.none = -300.0;
  w.kappa = 0.02;
  w.something_else = -125.1;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);  // an amplitude or a temperature: there it counts
  w.between_states = true;
  EXPECT_EQ(rule(w).verdict, Verdict::named);
  w.something_else = -124.9;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
}

TEST(Rules, WhatIsTunedNeedsMoreAndMayLeaveLess) {
  Weighed w = change(-55.1);
  w.tuned = true;
  w.in_all_conditions = true;
  EXPECT_EQ(rule(w).verdict, Verdict::none);
  w.leader = -54.9;
  EXPECT_EQ(rule(w).verdict, Verdict::named);
  w.chi_squared_ratio = 1.6;
  w.leader = 0.0;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
  w.tuned = false;
  EXPECT_EQ(rule(w).verdict, Verdict::named);
}

TEST(Rules, WithoutACauseAChangeOrAMisfitIsUnknownAndElseNone) {
  Weighed w = change(-99.0);
  EXPECT_EQ(rule(w).verdict, Verdict::none);
  w.something_else = -96.9;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
  w.something_else = -97.1;
  EXPECT_EQ(rule(w).verdict, Verdict::none);
  w.none_chi_squared_ratio = 2.1;
  EXPECT_EQ(rule(w).verdict, Verdict::unknown);
}

TEST(Rules, AnEmptyCatalogueSaysNone) {
  Weighed w;
  w.none = -10.0;
  EXPECT_EQ(rule(w).verdict, Verdict::none);
}

TEST(Guard, ANameThatPredictsNothingIsTakenBack) {
  const auto named = rule(change(-90.0));
  EXPECT_EQ(guarded(named, 1.1, false).verdict, Verdict::named);
  EXPECT_EQ(guarded(named, 0.9, false).verdict, Verdict::unknown);
  EXPECT_EQ(guarded(named, -1.0, true).verdict, Verdict::none);
  const auto none = rule(change(-100.0));
  EXPECT_EQ(guarded(none, -1.0, false).verdict, Verdict::none);
}

TEST(Rules, NamesAreThoseOfTheFile) {
  EXPECT_EQ(diagnosis::name_of(Verdict::none), "none");
  EXPECT_EQ(diagnosis::name_of(Verdict::named), "named");
  EXPECT_EQ(diagnosis::name_of(Verdict::ambiguous), "ambiguous");
  EXPECT_EQ(diagnosis::name_of(Verdict::unknown), "unknown");
}

}  // namespace
}  // namespace twindeck::tests
