#include "aero/yaw_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::aero {
namespace {

Eigen::Matrix3i all(int power) { return Eigen::Matrix3i::Constant(power); }

Eigen::Matrix3i on_oblique_strip() {
  Eigen::Matrix3i powers;
  powers << 1, 1, 2, 1, 1, 2, 2, 2, 3;
  return powers;
}

}  // namespace

std::string name_of(StaticRule rule) {
  return rule == StaticRule::normal ? "normal" : rule == StaticRule::cosine ? "cosine" : "oblique_strip";
}

const std::vector<YawRule>& published_yaw_rules() {
  using enum StaticRule;
  static const std::string cosine_group = "Cosine rule and skew wind theory", wind_group = "Wind Y";
  static const std::vector<YawRule> rules = {
      {"A", "Orthogonal wind", "", normal, 0, all(0), ForceAxes::deck},
      {"C", cosine_group, "Static and dynamic application of the cosine rule", cosine, 1, all(0), ForceAxes::deck},
      {"D", cosine_group, "Static application of the cosine rule and dynamic application of the skew wind theory", cosine, 1,
       all(2), ForceAxes::deck},
      {"G", wind_group, "NS #1", cosine, 1, all(2), ForceAxes::wind},
      {"H", wind_group, "NS #2", oblique_strip, 1, all(0), ForceAxes::wind},
      {"I", wind_group, "NS #3", oblique_strip, 1, all(2), ForceAxes::wind},
  };
  return rules;
}

std::vector<std::string> published_yaw_rule_names() { return each_of(published_yaw_rules(), &YawRule::name); }

YawRule oblique_rule_H() {
  YawRule rule = published_yaw_rule("H");
  rule.name = "H_oblique";
  rule.description = "NS #2, derivatives on the oblique strip";
  rule.inverse_power = on_oblique_strip();
  return rule;
}

const YawRule& published_yaw_rule(const std::string& name) {
  const std::vector<YawRule>& rules = published_yaw_rules();
  const auto found = std::ranges::find(rules, name, &YawRule::name);
  if (found == rules.end())
    throw InputError({"", 0, "rule"}, "'" + name + "' is no model of Table 11", "choose one of A, C, D, G, H, I");
  return *found;
}

const YawRule& Deployment::at(const std::string& deck, double yaw_rad) const {
  for (const Zone& zone : zones)
    if (zone.deck == deck && std::abs(yaw_rad) > zone.beyond_rad) return zone.rule;
  return everywhere;
}

Deployment everywhere(const YawRule& rule) { return {rule.name, rule, {}}; }

double yaw_cosine(double yaw_rad) {
  const double c = std::cos(yaw_rad);
  // A wind along the deck meets no strip; the small margin keeps 1/cos³ from overflowing.
  if (!(std::abs(yaw_rad) < std::numbers::pi / 2) || c < 1e-6)
    throw InputError({"", 0, "yaw"},
                     fmt::format("is {:.6g} degrees, expected less than 90 either way", yaw_rad * 180 / std::numbers::pi),
                     "turn the wind, or leave out the aerodynamic nodes that it blows along");
  return c;
}

Eigen::Matrix3d block_factor(const YawRule& rule, double yaw_rad) {
  const double c = yaw_cosine(yaw_rad);
  return rule.inverse_power.unaryExpr([c](int power) { return std::pow(c, -power); }).cast<double>();
}

double lookup_factor(const YawRule& rule, double yaw_rad) { return std::pow(yaw_cosine(yaw_rad), rule.lookup_power); }

StaticFactor static_factor(const YawRule& rule, double yaw_rad) {
  const double c = yaw_cosine(yaw_rad);
  if (rule.statics == StaticRule::cosine) return {c * c, c * c};
  // B'L' = BL, and B'²L' = B²L/cos.
  if (rule.statics == StaticRule::oblique_strip) return {1.0, 1.0 / c};
  return {1.0, 1.0};
}

StaticFactor static_slope(const YawRule& rule, double yaw_rad) {
  const double c = yaw_cosine(yaw_rad), s = std::sin(yaw_rad);
  if (rule.statics == StaticRule::cosine) return {-2.0 * c * s, -2.0 * c * s};
  if (rule.statics == StaticRule::oblique_strip) return {0.0, s / (c * c)};
  return {0.0, 0.0};
}

}  // namespace twindeck::aero
