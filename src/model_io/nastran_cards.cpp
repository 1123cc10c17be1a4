#include "model_io/nastran_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace twindeck::model_io::nastran {
namespace {

/// "Field 4 of line 2": as the manual counts them, ten a line with the first and the last for names.
std::string place_of_field(std::size_t i) {
  return i < 8 ? fmt::format("field {}", i + 2) : fmt::format("field {} of its line {}", i % 8 + 2, i / 8 + 1);
}

/// "3.0+7" and "3.0D7" as "3.0E7"; a leading plus goes.
std::string with_exponent(const std::string& field) {
  std::string result;
  bool exponent = false;
  for (std::size_t i = 0; i < field.size(); ++i) {
    char c = field[i];
    if (c == 'd' || c == 'D' || c == 'e' || c == 'E') {
      c = 'e';
      exponent = true;
    } else if ((c == '+' || c == '-') && i > 0 && !exponent) {
      result += 'e';
      exponent = true;
    }
    if (c != '+') result += c;
  }
  return result;
}

}  // namespace

void Deck::fail(const Card& card, const std::string& problem, const std::string& mend) const {
  const std::string id = card.name + (blank(card, 0) ? "" : " " + card.fields[0]);
  throw InputError({files_[static_cast<std::size_t>(card.file)].string(), card.line, id}, problem, mend);
}

std::string Deck::text(const Card& card, std::size_t i) { return i < card.fields.size() ? card.fields[i] : ""; }

double Deck::number_or(const Card& card, std::size_t i, double fallback) const {
  if (blank(card, i)) return fallback;
  const std::string written = with_exponent(card.fields[i]);
  double value = 0.0;
  const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), value);
  if (error != std::errc() || end != written.data() + written.size() || !(std::abs(value) <= largest_number))
    fail(card, fmt::format("{} is '{}', expected a number", place_of_field(i), card.fields[i]),
         "check the columns of the card");
  return value;
}

double Deck::number(const Card& card, std::size_t i) const {
  if (blank(card, i)) fail(card, place_of_field(i) + " is blank, expected a number", "complete the card");
  return number_or(card, i, 0.0);
}

long Deck::integer_or(const Card& card, std::size_t i, long fallback) const {
  if (blank(card, i)) return fallback;
  if (!is_integer(card.fields[i]))
    fail(card, fmt::format("{} is '{}', expected a whole number", place_of_field(i), card.fields[i]),
         "check the columns of the card");
  return std::stol(card.fields[i]);
}

long Deck::integer(const Card& card, std::size_t i) const {
  if (blank(card, i)) fail(card, place_of_field(i) + " is blank, expected a whole number", "complete the card");
  return integer_or(card, i, 0);
}

std::size_t Deck::size(const Card& card) {
  const auto last = std::find_if(card.fields.rbegin(), card.fields.rend(), [](const std::string& f) { return !f.empty(); });
  return static_cast<std::size_t>(card.fields.rend() - last);
}

bool Deck::is_integer(const std::string& field) {
  const std::size_t sign = !field.empty() && (field[0] == '-' || field[0] == '+') ? 1 : 0;
  return field.size() > sign && field.size() < 18 && field.find_first_not_of("0123456789", sign) == std::string::npos;
}

}  // namespace twindeck::model_io::nastran
