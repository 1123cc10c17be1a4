#include "diagnosis/words/place_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.hpp"
#include "diagnosis/words/plain_words.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Vector3d;

constexpr double kShownAxis = 0.05;  ///< of the largest extent; coordinates along a shorter axis are not shown
constexpr double kSamePoint = 1e-3;  ///< of the largest extent; nearer points count as one
constexpr double kNeighbour = 0.1;   ///< of the largest extent; landmarks farther away are not named
constexpr double kCompact = 0.25;    ///< of the largest extent; for larger groups no middle is named
constexpr std::size_t kListed = 3;   ///< points that are listed singly
constexpr double kParts = 100.0;     ///< least number of steps in which coordinates resolve the structure's length
constexpr int kMostDecimals = 4;     ///< of metres; models are built to a tenth of a millimetre

const Vector3d kNowhere = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

bool known(const Vector3d& x) { return x.allFinite(); }

std::vector<std::string> split(const std::string& names) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from <= names.size();) {
    const auto comma = std::min(names.find(',', from), names.size());
    out.push_back(names.substr(from, comma - from));
    from = comma + 1;
  }
  return out;
}

Vector3d middle_of(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& x : points) sum += x;
  return points.empty() ? kNowhere : Vector3d(sum / static_cast<double>(points.size()));
}

/// The most frequent name, of equals the first in the alphabet; "" if there is none.
std::string most_frequent(const std::map<std::string, int>& counts) {
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

std::string words_of_target(fe::Target target, const std::string& of) {
  if (target == fe::Target::matrix_stiffness || target == fe::Target::matrix_mass) return "";
  if (target == fe::Target::youngs_modulus || target == fe::Target::density) return "what is of " + of;
  if (target == fe::Target::spring_stiffness) return "the springs " + of;
  return (target == fe::Target::point_mass ? "the masses " : "what has the section ") + of;
}

}  // namespace

PlaceWords::PlaceWords(const fe::Model* model, const std::vector<fe::DofLabel>& dofs,
                       const std::vector<matching::Channel>& channels, const Places& places)
    : model_(model), channels_(channels), places_(places) {
  measure_extent(dofs);
  if (model_ != nullptr) find_parts();
  find_landmarks();
}

void PlaceWords::measure_extent(const std::vector<fe::DofLabel>& dofs) {
  if (model_ != nullptr) {
    for (const fe::Node& n : model_->nodes) node_x_m_[std::to_string(n.id)] = n.x_m;
  } else {
    for (const fe::DofLabel& dof : dofs) node_x_m_[dof.node] = dof.x_m;
  }
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& [name, x] : node_x_m_) {
    if (!known(x)) continue;
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  if (!(high - low).allFinite()) return;
  const Vector3d extent = high - low;
  extent_m_ = extent.maxCoeff(&axis_);
  if (!(extent_m_ > 0.0)) return;
  for (int k = 0; k < 3; ++k) shown_[static_cast<std::size_t>(k)] = extent[k] > kShownAxis * extent_m_;
  decimals_ = std::clamp(static_cast<int>(std::ceil(std::log10(kParts / extent_m_))), 0, kMostDecimals);
}

void PlaceWords::find_parts() {
  std::map<int, std::map<std::string, int>> elements_of;
  for (const fe::Element& element : model_->elements)
    for (const int n : element.nodes)
      if (!element.group.empty() && element.type != fe::ElementType::stay) ++elements_of[n][element.group];
  for (const auto& [n, counts] : elements_of)
    part_of_node_[std::to_string(model_->nodes[static_cast<std::size_t>(n)].id)] = most_frequent(counts);
}

void PlaceWords::find_landmarks() {
  const auto add = [&](const std::string& words, const Vector3d& x) {
    if (known(x)) landmarks_.push_back({words, x});
  };
  if (model_ != nullptr) {
    const auto at = [&](int n) { return model_->nodes[static_cast<std::size_t>(n)].x_m; };
    for (const fe::Support& s : model_->supports)
      if (!s.name.empty()) add("the support " + s.name, at(s.node));
    for (const fe::Spring& s : model_->springs) {
      if (s.is_damper())
        add("the damper " + s.name, at(s.node));
      else if (s.node2 < 0 && !s.support_name().starts_with("node_"))
        add("the support " + s.support_name(), at(s.node));
    }
    for (const fe::Element& e : model_->elements)
      if (e.type == fe::ElementType::stay && !e.name.empty())
        add("the anchorage of the stay " + e.name, at(e.nodes[0]).z() <= at(e.nodes[1]).z() ? at(e.nodes[0]) : at(e.nodes[1]));
  }
  for (const matching::Channel& channel : channels_) {
    Vector3d x = channel.x_m.value_or(kNowhere);
    if (const auto node = node_x_m_.find(channel.point); !known(x) && node != node_x_m_.end()) x = node->second;
    add("the sensor " + channel.name, x);
  }
}

std::string PlaceWords::coordinates(const Vector3d& x) const {
  if (!known(x)) return "";
  std::string out;
  for (int k = 0; k < 3; ++k)
    if (shown_[static_cast<std::size_t>(k)])
      out += fmt::format("{}{} = {} m", out.empty() ? "" : ", ", "xyz"[k], with_decimals(x[k], decimals_));
  return out;
}

std::string PlaceWords::near(const Vector3d& x) const {
  const Landmark* nearest = nullptr;
  double least = kNeighbour * extent_m_;
  for (const Landmark& landmark : landmarks_) {
    const double distance = (landmark.x_m - x).norm();
    if (distance < least) {
      least = distance;
      nearest = &landmark;
    }
  }
  if (nearest == nullptr) return "";
  if (least <= kSamePoint * extent_m_) return ", at " + nearest->words;
  return fmt::format(", {} m from {}", with_decimals(least, std::max(decimals_, 1)), nearest->words);
}

PlaceWords::Points PlaceWords::distinct(const Points& points) const {
  Points out;
  for (const Vector3d& x : points)
    if (known(x) && std::ranges::none_of(out, [&](const Vector3d& y) { return (x - y).norm() <= kSamePoint * extent_m_; }))
      out.push_back(x);
  return out;
}

/// "the support foot at x = 0 m and at x = 5 m". Many points close together are described by their middle; scattered ones are
/// left out.
PlaceInWords PlaceWords::with_points(const std::string& words, const Points& points) const {
  const Points all = distinct(points);
  if (all.empty()) return {words, kNowhere};
  Vector3d low = all[0], high = all[0];
  for (const Vector3d& x : all) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const bool compact = (high - low).norm() <= kCompact * extent_m_;
  const Vector3d middle = middle_of(all);
  if (all.size() > kListed) {
    if (!compact || coordinates(middle).empty()) return {words, kNowhere};
    return {fmt::format("{} round {}", words, coordinates(middle)), middle};
  }
  std::vector<std::string> each;
  for (const Vector3d& x : all)
    if (const std::string here = coordinates(x); !here.empty()) each.push_back("at " + here);
  return {each.empty() ? words : words + " " + listed(each), compact ? middle : kNowhere};
}

PlaceInWords PlaceWords::at(const std::string& location) const {
  const auto colon = location.find(':');
  if (location == "global") return {"the whole structure", kNowhere};
  if (colon == std::string::npos) return {location, kNowhere};
  const std::string kind = location.substr(0, colon), names = location.substr(colon + 1);
  if (kind == "node") return node(names);
  if (kind == "nodes") return nodes(split(names));
  if (kind == "element" || kind == "zone") return zone(location, names);
  if (kind == "support") return support(names);
  if (kind == "stay") return stay(names);
  if (kind == "damper" || kind == "dampers") return dampers(names);
  if (kind == "channel" || kind == "channels") return channels(split(names));
  if (kind == "group") return group(names);
  if (kind == "groups") return groups(split(names));
  if (kind == "mode") return {"mode " + names, kNowhere};
  return {location, kNowhere};
}

PlaceInWords PlaceWords::node(const std::string& name) const {
  const auto found = node_x_m_.find(name);
  if (found == node_x_m_.end()) return {"node " + name, kNowhere};
  const Vector3d& x = found->second;
  const std::string here = coordinates(x);
  if (here.empty()) {
    for (const matching::Channel& channel : channels_)
      if (channel.point == name) return {fmt::format("node {}, at the sensor {}", name, channel.name), x};
    return {"node " + name, x};
  }
  const auto part = part_of_node_.find(name);
  if (part == part_of_node_.end()) return {fmt::format("node {} at {}{}", name, here, near(x)), x};
  return {fmt::format("the {} at {} (node {}{})", part->second, here, name, near(x)), x};
}

PlaceInWords PlaceWords::nodes(const std::vector<std::string>& names) const {
  std::vector<std::string> words;
  Points points;
  for (const std::string& name : names) {
    const PlaceInWords one = node(name);
    words.push_back(one.words);
    points.push_back(one.x_m);
  }
  return {listed(words), middle_of(points)};
}

PlaceInWords PlaceWords::zone(const std::string& location, const std::string& name) const {
  for (const auto& [set, list] : places_.sets) {  // zones, groups and halves of both
    if (model_ == nullptr) break;
    for (const Place& place : list) {
      if (place.id != location) continue;
      std::map<std::string, int> counts;
      for (const int e : place.elements) ++counts[model_->elements[static_cast<std::size_t>(e)].group];
      const std::string group = most_frequent(counts);
      std::string part = group.empty() ? "element " + name : "the " + group;
      if (location.starts_with("zone:")) part = "the structure";  // a zone holds elements of all groups
      const std::string here = coordinates(place.x_m);
      if (here.empty()) return {part, place.x_m};
      const std::string beside = near(place.x_m);
      if (place.elements.size() > 1) return {fmt::format("{} round {}{}", part, here, beside), place.x_m};
      return {group.empty() ? fmt::format("{} at {}{}", part, here, beside)
                            : fmt::format("{} at {} (element {}{})", part, here, name, beside),
              place.x_m};
    }
  }
  return {"element " + name, kNowhere};
}

PlaceInWords PlaceWords::support(const std::string& name) const {
  if (name.starts_with("node_") && node_x_m_.contains(name.substr(5))) {
    const PlaceInWords there = node(name.substr(5));
    return {"the support of " + there.words, there.x_m};
  }
  Points points;
  if (model_ != nullptr) {
    for (const fe::Support& s : model_->supports)
      if (s.name == name) points.push_back(model_->nodes[static_cast<std::size_t>(s.node)].x_m);
    for (const fe::Spring& s : model_->springs)
      if (!s.is_damper() && (s.group == name || s.name == name || one_bearing(*model_, s) == name))
        points.push_back(model_->nodes[static_cast<std::size_t>(s.node)].x_m);
  }
  return with_points("the support " + name, points);
}

PlaceInWords PlaceWords::stay(const std::string& name) const {
  if (model_ != nullptr) {
    for (const fe::Element& e : model_->elements) {
      if (e.type != fe::ElementType::stay || (e.name != name && std::to_string(e.id) != name)) continue;
      const Vector3d a = model_->nodes[static_cast<std::size_t>(e.nodes[0])].x_m,
                     b = model_->nodes[static_cast<std::size_t>(e.nodes[1])].x_m;
      const Vector3d low = a.z() <= b.z() ? a : b;
      const std::string here = coordinates(low);
      return {here.empty() ? "the stay " + name : fmt::format("the stay {}, anchored at {}", name, here), low};
    }
  }
  return {"the stay " + name, kNowhere};
}

PlaceInWords PlaceWords::dampers(const std::string& names) const {
  const auto moved = names.find('@');
  const std::vector<std::string> each = split(names.substr(0, moved));
  const std::string words = fmt::format("the damper{} {}", each.size() > 1 ? "s" : "", listed(each));
  if (moved != std::string::npos) return {fmt::format("{} at the places {}", words, names.substr(moved + 1)), kNowhere};
  Points points;
  if (model_ != nullptr)
    for (const fe::Spring& s : model_->springs)
      if (contains(each, s.name)) points.push_back(model_->nodes[static_cast<std::size_t>(s.node)].x_m);
  return with_points(words, points);
}

PlaceInWords PlaceWords::channels(const std::vector<std::string>& names) const {
  Points points;
  for (const std::string& name : names) {
    const auto found = std::ranges::find_if(channels_, [&](const matching::Channel& c) { return c.name == name; });
    if (found == channels_.end()) continue;
    const auto node = node_x_m_.find(found->point);
    if (found->x_m)
      points.push_back(*found->x_m);
    else if (node != node_x_m_.end())
      points.push_back(node->second);
  }
  const std::string words = fmt::format("the sensor{} {}", names.size() > 1 ? "s" : "", listed(names));
  if (names.size() == 1) return with_points(words, points);
  return {words, distinct(points).size() == 1 ? points[0] : kNowhere};
}

PlaceInWords PlaceWords::groups(const std::vector<std::string>& names) const {
  Points points;
  for (const std::string& name : names) points.push_back(group(name).x_m);
  return with_points("the groups " + listed(names), points);
}

PlaceInWords PlaceWords::group(const std::string& name) const {
  if (model_ == nullptr) return {"the group " + name, kNowhere};
  const auto parameter = std::ranges::find_if(model_->parameters, [&](const fe::Parameter& p) { return p.name == name; });
  const bool is_parameter = parameter != model_->parameters.end();
  const std::vector<std::string> of = is_parameter ? parameter->of : std::vector<std::string>{name};
  const auto is_one = [&](const std::string& candidate) { return contains(of, candidate); };
  Points points;
  for (const fe::Element& e : model_->elements) {
    const auto named = [&](int at, const auto& list) { return at >= 0 && is_one(list[static_cast<std::size_t>(at)].name); };
    const bool in =
        is_one(e.group) || (is_parameter && (named(e.material, model_->materials) || named(e.section, model_->sections)));
    if (!in) continue;
    Points corners;
    for (const int n : e.nodes) corners.push_back(model_->nodes[static_cast<std::size_t>(n)].x_m);
    points.push_back(middle_of(corners));
  }
  for (const fe::Spring& s : model_->springs)
    if (is_one(s.group)) points.push_back(model_->nodes[static_cast<std::size_t>(s.node)].x_m);
  for (const fe::PointMass& m : model_->masses)
    if (is_one(m.group)) points.push_back(model_->nodes[static_cast<std::size_t>(m.node)].x_m);
  if (!is_parameter) return with_points("the group " + name, points);
  const std::string words = words_of_target(parameter->target, listed(of));
  const PlaceInWords where = with_points(words.empty() ? "the parameter " + name : words, points);
  return words.empty() ? where : PlaceInWords{fmt::format("{} (parameter {})", where.words, name), where.x_m};
}

}  // namespace twindeck::diagnosis
