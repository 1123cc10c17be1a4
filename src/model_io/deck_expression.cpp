#include "model_io/deck_expression.hpp"

#include <cctype>
#include <charconv>
#include <cmath>

namespace twindeck::model_io {
namespace {

/// Recursive descent over one expression; `failed` is set by whatever is not understood.
class Parser {
 public:
  Parser(const std::string& text, const Parameters& parameters) : text_(text), parameters_(parameters) {}

  std::optional<double> value() {
    const double result = sum();
    skip_blanks();
    if (failed_ || at_ != text_.size() || !std::isfinite(result)) return std::nullopt;
    return result;
  }

 private:
  static constexpr int deepest = 40;  ///< brackets and signs within one another: more is no expression of a person

  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  [[nodiscard]] char peek() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(const std::string& sign) {
    skip_blanks();
    if (text_.compare(at_, sign.size(), sign) != 0) return false;
    at_ += sign.size();
    return true;
  }

  double sum() {
    double result = product();
    while (!failed_) {
      if (take("+")) {
        result += product();
      } else if (take("-")) {
        result -= product();
      } else {
        break;
      }
    }
    return result;
  }

  double product() {
    double result = power();
    while (!failed_ && (peek() == '*' || peek() == '/')) {
      if (take("/")) {
        result /= power();
      } else if (take("*")) {
        result *= power();
      }
    }
    return result;
  }

  double power() {
    double base = factor();
    while (!failed_ && take("**")) base = std::pow(base, factor());
    return base;
  }

  double factor() {
    if (++depth_ > deepest) failed_ = true;
    double result = 0.0;
    if (failed_) {
      // nothing more is read
    } else if (take("-")) {
      result = -factor();
    } else if (take("+")) {
      result = factor();
    } else if (take("(")) {
      result = sum();
      failed_ = failed_ || !take(")");
    } else if (const char c = peek(); std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') {
      result = parameter();
    } else {
      result = number();
    }
    --depth_;
    return result;
  }

  double parameter() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_')) ++at_;
    const auto found = parameters_.find(upper_case(text_.substr(start, at_ - start)));
    if (found == parameters_.end() || peek() == '(') {
      failed_ = true;
      return 0.0;
    }
    return found->second;
  }

  double number() {
    std::string digits;
    std::size_t end = at_;
    for (; end < text_.size(); ++end) {
      const char c = text_[end];
      const bool exponent = c == 'e' || c == 'E' || c == 'd' || c == 'D';
      const bool sign_of_exponent = (c == '+' || c == '-') && !digits.empty() && digits.back() == 'e';
      if (std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.' && !exponent && !sign_of_exponent) break;
      digits += exponent ? 'e' : c;
    }
    double result = 0.0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), result);
    if (error != std::errc() || stop != digits.data() + digits.size()) failed_ = true;
    at_ = end;
    return result;
  }

  const std::string& text_;
  const Parameters& parameters_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace

std::optional<double> evaluate(const std::string& text, const Parameters& parameters) {
  if (text.empty()) return std::nullopt;
  return Parser(text, parameters).value();
}

}  // namespace twindeck::model_io
