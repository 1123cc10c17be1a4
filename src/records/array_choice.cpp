#include "records/array_choice.hpp"

#include <algorithm>
#include <cmath>
#include <regex>

#include "core/error.hpp"

namespace twindeck::records {

using Eigen::Index;

namespace {

std::string bare(const std::string& name) {
  std::string text = name.substr(name.find_last_of("/.") == std::string::npos ? 0 : name.find_last_of("/.") + 1);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_time(const std::string& name) {
  static const std::regex pattern("t|time|time_?s|times|tempo|zeit|time_?vector|tvec");
  return std::regex_match(bare(name), pattern);
}

}  // namespace

ArrayChoice choose_arrays(const std::vector<NamedArray>& arrays, const std::string& file) {
  ArrayChoice choice;
  Index largest = 0;
  std::size_t best = 0;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const Index size = arrays[i].rows * arrays[i].columns;
    if (size == 1) choice.scalars.push_back(i);
    if (size > largest && !is_time(arrays[i].name)) {
      largest = size;
      best = i;
    }
  }
  if (largest < 16) {
    throw InputError({file, 0, ""}, "holds no array of numbers of sixteen values or more", "store the samples as a two-dimensional array of real numbers");
  }
  const Index samples = arrays[best].longer();
  if (arrays[best].shorter() > 1) {
    choice.data = {best};
    choice.transposed = arrays[best].columns > arrays[best].rows;
  } else {
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (arrays[i].shorter() == 1 && arrays[i].longer() == samples && !is_time(arrays[i].name)) choice.data.push_back(i);
    }
  }
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (arrays[i].shorter() == 1 && arrays[i].longer() == samples && is_time(arrays[i].name)) choice.time = static_cast<int>(i);
  }
  return choice;
}

double rate_of(const std::string& name, double value) {
  static const std::regex rate("fs|f_s|sf|sr|rate|sps|samp\\w*|sampling_?(rate|frequency|freq)(_?hz)?|sample_?rate(_?hz)?|frequency|freq|fsamp|fs_hz");
  static const std::regex step("dt|ts|t_s|delta_?t|step|time_?step|sampling_?(interval|period|time)|interval|xincrement|wf_increment");
  if (!(value > 0.0) || !std::isfinite(value)) return 0.0;
  const std::string text = bare(name);
  if (std::regex_match(text, step)) return 1.0 / value;
  return std::regex_match(text, rate) ? value : 0.0;
}

double rate_of_times(const Eigen::VectorXd& times) {
  const Index n = times.size();
  if (n < 3) return 0.0;
  const double step = (times[n - 1] - times[0]) / static_cast<double>(n - 1);
  if (!(step > 0.0)) return 0.0;
  for (Index i = 1; i < n; ++i) {
    if (std::abs(times[i] - times[i - 1] - step) > 0.1 * step) return 0.0;
  }
  const double rate = 1.0 / step, round = std::round(rate * 1000.0) / 1000.0;
  return std::abs(round / rate - 1.0) < 1e-6 ? round : rate;
}

}  // namespace twindeck::records
