#include "model_io/inp_scopes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::model_io {
namespace {

constexpr long largest_kept_apart = 1'000'000'000'000'000;  ///< numbers of nodes and elements, as InpFile::integer has it

/// Behind the step with *FREQUENCY; the end of the file without one.
std::size_t end_of_modal_step(const InpFile& file) {
  const auto& cards = file.cards();
  const auto named = [](const char* keyword) { return [keyword](const InpCard& card) { return card.keyword == keyword; }; };
  const auto frequency = std::ranges::find_if(cards, named("FREQUENCY"));
  const auto end = std::find_if(frequency, cards.end(), named("END STEP"));
  return static_cast<std::size_t>(end - cards.begin()) + (end == cards.end() ? 0 : 1);
}

/// *INSTANCE: translation on its first data line; rotation on its second, which comes after the translation.
void place_instance(const InpCard& card, InpScope& scope) {
  if (card.data.empty()) return;
  if (card.data.size() > 2) card.data[2].fail("a third data line is no placement", "give a translation, then a rotation");
  scope.shift_m = card.data[0].vector(0);
  if (card.data.size() < 2) return;
  const InpLine& turn = card.data[1];
  const Eigen::Vector3d a = turn.vector(0), b = turn.vector(3);
  const double angle = turn.number(6) * std::numbers::pi / 180.0;
  if (!((b - a).norm() > 1e-12 * (1.0 + a.norm())))
    turn.fail("the two points of the axis of rotation are one", "give points a and b apart, then the angle");
  if (angle == 0.0) return;
  scope.rotation = Eigen::AngleAxisd(angle, (b - a).normalized()).toRotationMatrix();
  scope.shift_m = (a + scope.rotation * (scope.shift_m - a)).eval();
}

/// Largest and smallest number in the first field of the cards of one keyword, by scope.
struct IdRange {
  long first = 0, last = -1;
};
std::vector<IdRange> ranges_of(const InpPlan& plan, const char* keyword) {
  std::vector<IdRange> ranges(plan.scopes.size());
  for (const InpReading& reading : plan.readings) {
    if (reading.card->keyword != keyword) continue;
    IdRange& range = ranges[fe::slot(reading.scope)];
    for (const InpLine& line : reading.card->data) {
      if (!is_whole_number(line.fields[0])) continue;  // its reader tells what is wrong with it
      const long id = std::min(std::stol(line.fields[0]), largest_kept_apart);
      if (range.last < range.first) range = {id, id};
      range = {std::min(range.first, id), std::max(range.last, id)};
    }
  }
  return ranges;
}

/// What is added to the numbers of each scope, the assembly being the last to be given its numbers.
std::vector<long> offsets_of(const InpFile& file, const std::vector<IdRange>& ranges) {
  const auto count = std::ssize(ranges);
  long step = 1, last = 0;
  for (const IdRange& range : ranges) last = std::max(last, range.last);
  while (step <= last) step *= 10;
  std::vector<long> offsets(ranges.size(), 0);
  std::vector<IdRange> taken;
  for (long turn = 1; turn <= count; ++turn) {
    const long scope = turn % count;  // the instances, then the assembly
    const IdRange range = ranges[static_cast<std::size_t>(scope)];
    if (range.last < range.first) continue;
    const bool overlaps = std::ranges::any_of(
        taken, [&](const IdRange& other) { return range.first <= other.last && other.first <= range.last; });
    if (overlaps && step > largest_kept_apart / count)
      throw InputError({file.path().string(), 0, "*INSTANCE"},
                       fmt::format("the numbers of {} instances, up to {}, cannot be kept apart", count - 1, last),
                       "number nodes and elements from 1");
    const long offset = overlaps ? (turn - 1) * step : 0;
    offsets[static_cast<std::size_t>(scope)] = offset;
    taken.push_back({range.first + offset, range.last + offset});
  }
  return offsets;
}

void number_scopes(const InpFile& file, InpPlan& plan) {
  const std::vector<IdRange> nodes = ranges_of(plan, "NODE");
  const std::vector<long> node_offsets = offsets_of(file, nodes),
                          element_offsets = offsets_of(file, ranges_of(plan, "ELEMENT"));
  for (std::size_t i = 0; i < plan.scopes.size(); ++i) {
    InpScope& scope = plan.scopes[i];
    scope.node_offset = node_offsets[i];
    scope.element_offset = element_offsets[i];
    scope.last_node = nodes[i].last;
    if (scope.node_offset > 0)
      plan.notes.push_back(fmt::format("{}: node n of the file is node {} + n of the model",
                                       scope.name.empty() ? "the assembly" : "instance " + scope.name, scope.node_offset));
  }
}

/// Walks through the cards and keeps where they stand.
class Planner {
 public:
  explicit Planner(const InpFile& file) : file_(file), flat_(std::ranges::none_of(file.cards(), is_instance)) {
    plan_.scopes.emplace_back();
  }

  InpPlan plan() {
    const std::size_t end = end_of_modal_step(file_);
    for (std::size_t i = 0; i < end; ++i) take(file_.cards()[i]);
    if (open_ != nullptr) open_->fail("is not closed", "write *END " + open_->keyword);
    for (const auto& [name, part] : parts_)
      if (!part.used)
        plan_.notes.push_back(
            fmt::format("part '{}' (line {}) has no instance and is left out", part.card->get("NAME"), part.card->line));
    if (end < file_.cards().size())
      plan_.notes.push_back(
          fmt::format("cards below line {}, behind the step with *FREQUENCY, are left out", file_.cards()[end - 1].line));
    number_scopes(file_, plan_);
    return std::move(plan_);
  }

 private:
  struct Part {
    const InpCard* card = nullptr;
    std::vector<const InpCard*> cards;
    bool used = false;
  };

  static bool is_instance(const InpCard& card) { return card.keyword == "INSTANCE"; }

  void take(const InpCard& card) {
    if (flat_) return plan_.readings.push_back({&card, 0});
    if (card.keyword == "PART") return open_part(card);
    if (card.keyword == "INSTANCE") return open_instance(card);
    if (card.keyword == "END PART" || card.keyword == "END INSTANCE") return close(card);
    if (part_ != nullptr) return part_->cards.push_back(&card);
    plan_.readings.push_back({&card, scope_});
  }

  void open_part(const InpCard& card) {
    if (open_ != nullptr) card.fail(fmt::format("stands inside of *{}", open_->keyword), "close that first");
    const std::string name = card.required("NAME");
    const auto [found, is_new] = parts_.emplace(upper_case(name), Part{&card, {}, false});
    if (!is_new) card.fail(fmt::format("part '{}' is defined twice", name), "keep one of the two");
    part_ = &found->second;
    open_ = &card;
  }

  void open_instance(const InpCard& card) {
    if (open_ != nullptr) card.fail(fmt::format("stands inside of *{}", open_->keyword), "close that first");
    card.allow({"NAME", "PART"});
    InpScope scope;
    scope.name = card.required("NAME");
    if (!names_.insert(upper_case(scope.name)).second)
      card.fail(fmt::format("a second instance is called '{}'", scope.name), "give each a name of its own");
    const std::string part = card.required("PART");
    const auto found = parts_.find(upper_case(part));
    if (found == parts_.end()) {
      const auto known = each_of(parts_, [](const auto& entry) { return entry.second.card->get("NAME"); });
      card.fail(fmt::format("no part above is called '{}'{}", part, did_you_mean(part, known)), "define it by *PART");
    }
    place_instance(card, scope);
    scope_ = static_cast<int>(plan_.scopes.size());
    plan_.scopes.push_back(scope);
    found->second.used = true;
    for (const InpCard* inside : found->second.cards) plan_.readings.push_back({inside, scope_});
    open_ = &card;
  }

  void close(const InpCard& card) {
    if (open_ == nullptr || card.keyword != "END " + open_->keyword)
      card.fail("closes nothing that is open", "take it out, or open it above");
    open_ = nullptr;
    part_ = nullptr;
    scope_ = 0;
  }

  const InpFile& file_;
  const bool flat_;  ///< no instance at all: parts are read as they stand
  InpPlan plan_;
  std::map<std::string, Part> parts_;
  std::set<std::string> names_;
  const InpCard* open_ = nullptr;
  Part* part_ = nullptr;
  int scope_ = 0;
};

/// The *BOUNDARY cards in force at the end of those before `end`: OP=NEW in a step drops those before the step.
std::vector<const InpCard*> boundaries_before(const InpFile& file, std::size_t end) {
  std::vector<const InpCard*> before, here;
  bool renewed = false;
  for (std::size_t i = 0; i < end; ++i) {
    const InpCard& card = file.cards()[i];
    if (card.keyword == "STEP") {
      before.insert(before.end(), here.begin(), here.end());
      here.clear();
      renewed = false;
    }
    if (card.keyword != "BOUNDARY") continue;
    if (upper_case(card.get("OP")) == "NEW" && !renewed) {
      before.clear();
      renewed = true;
    }
    here.push_back(&card);
  }
  before.insert(before.end(), here.begin(), here.end());
  return before;
}

/// What *BOUNDARY cards hold: "node or set:direction".
std::set<std::string> held_directions(const std::vector<const InpCard*>& cards) {
  std::set<std::string> held;
  for (const InpCard* card : cards)
    for (const InpLine& line : card->data) {
      const std::string place = upper_case(line.fields[0]), what = line.fields.size() > 1 ? line.word(1) : "";
      if (!is_whole_number(what)) held.insert(place + ":" + what);
      const int first = is_whole_number(what) ? line.component(1) : 0, last = line.blank(2) ? first : line.component(2);
      for (int d = first; d <= last && is_whole_number(what); ++d) held.insert(fmt::format("{}:{}", place, d));
    }
  return held;
}

}  // namespace

InpPlan plan_readings(const InpFile& file) { return Planner(file).plan(); }

std::vector<const InpCard*> boundaries_in_force(const InpFile& file) {
  return boundaries_before(file, end_of_modal_step(file));
}

void refuse_other_supports_than_of_static_steps(const InpFile& file) {
  const auto& cards = file.cards();
  std::size_t modal_step = end_of_modal_step(file);
  while (modal_step > 0 && cards[modal_step - 1].keyword != "STEP") --modal_step;
  if (held_directions(boundaries_in_force(file)) == held_directions(boundaries_before(file, modal_step))) return;
  const auto in_step = cards.begin() + static_cast<std::ptrdiff_t>(modal_step);
  std::find_if(in_step, cards.end(), [](const InpCard& card) { return card.keyword == "BOUNDARY"; })
      ->fail("holds the structure of the modes otherwise than the static step that loads it, which is not read",
             "hold it alike in both: give *BOUNDARY above the first *STEP, or in the static step too");
}

}  // namespace twindeck::model_io
