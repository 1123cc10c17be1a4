#include "records/universal_shapes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace twindeck::records {
using Eigen::Index;

namespace {

void read_nodes(UniversalLines& in, bool double_precision, UniversalData& data) {
  const std::string what = double_precision ? "set 2411" : "set 15";
  const auto take = [&](long label, const std::vector<double>& codes, const Eigen::Vector3d& position) {
    data.nodes[label] = position;
    data.axes[label] = {codes.size() > 1 ? label_of(in, codes[1]) : 0, codes.size() > 2 ? label_of(in, codes[2]) : 0};
  };
  for (std::string line; in.next(line);) {
    if (is_delimiter(line)) return;
    const auto numbers = numbers_in(line);
    if (numbers.empty()) continue;
    if (!double_precision) {
      if (numbers.size() < 7) in.fail("holds fewer than a label, three codes and three coordinates", "write set 15 again");
      take(label_of(in, numbers[0]), numbers, Eigen::Vector3d(numbers[4], numbers[5], numbers[6]));
      continue;
    }
    const long label = label_of(in, numbers[0]);
    const auto coordinates = numbers_in(need_inside(in, what));
    if (coordinates.size() < 3) in.fail("holds fewer than three coordinates", "write set 2411 again");
    take(label, numbers, Eigen::Vector3d(coordinates[0], coordinates[1], coordinates[2]));
  }
  in.fail("breaks off in " + what, kCopyAgain);
}

/// Beams have a line with the node of their orientation; then come the nodes, eight a line.
void read_elements(UniversalLines& in, UniversalData& data) {
  for (std::string line; in.next(line);) {
    if (is_delimiter(line)) return;
    const auto head = numbers_in(line);
    if (head.empty()) continue;
    if (head.size() < 6) in.fail("holds fewer than a label, four codes and a number of nodes", "write set 2412 again");
    UniversalElement element{label_of(in, head[0]), label_of(in, head[1]), {}};
    const long nodes = count_in(head[5], in.size()).value_or(0);
    if (is_beam(element.descriptor)) need_inside(in, "set 2412");
    while (std::ssize(element.nodes) < nodes) {
      const auto labels = numbers_in(need_inside(in, "set 2412"));
      if (labels.empty()) in.fail("has fewer nodes than it states", "write set 2412 again");
      for (const double label : labels) element.nodes.push_back(label_of(in, label));
    }
    data.elements.push_back(std::move(element));
  }
  in.fail("breaks off in set 2412", kCopyAgain);
}

void read_lines(UniversalLines& in, UniversalData& data) {
  const auto head = numbers_in(need_inside(in, "set 82"));
  need_inside(in, "set 82");
  const long count = head.size() > 1 ? count_in(head[1], in.size()).value_or(0) : 0;
  std::vector<long> chain;
  const auto finish = [&] {
    if (chain.size() > 1) data.lines.push_back(chain);
    chain.clear();
  };
  long seen = 0;
  for (std::string line; in.next(line);) {
    if (is_delimiter(line)) return finish();
    for (const double number : numbers_in(line)) {
      if (seen++ >= count && count > 0) break;
      if (number == 0.0)
        finish();
      else
        chain.push_back(label_of(in, number));
    }
  }
  in.fail("breaks off in set 82", kCopyAgain);
}

/// Appends the numbers of further lines of set 55 until there are `wanted`, or a line has none.
void read_numbers(UniversalLines& in, std::size_t wanted, std::vector<double>& numbers) {
  while (numbers.size() < wanted) {
    const auto more = numbers_in(need_inside(in, "set 55"));
    if (more.empty()) break;
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
}

/// What set 55 says of its mode: the number, and frequency and damping of a real one or the eigenvalue of a complex one.
void take_mode(const std::vector<double>& integers, const std::vector<double>& reals, long most_codes, NodalResult& result) {
  if (integers.size() > 3) result.mode = static_cast<int>(count_in(integers[3], most_codes).value_or(0));
  if (result.is_complex_mode() && reals.size() >= 2) {
    result.eigenvalue = {reals[0], reals[1]};
    result.frequency_Hz = std::abs(result.eigenvalue) / (2.0 * std::numbers::pi);
    if (std::abs(result.eigenvalue) > 0.0) result.damping_ratio = -reals[0] / std::abs(result.eigenvalue);
  } else if (!reals.empty()) {
    result.frequency_Hz = reals[0];
    if (reals.size() >= 3) result.damping_ratio = reals[2];
    if (reals.size() >= 4 && result.damping_ratio == 0.0) result.damping_ratio = reals[3] / 2.0;  // hysteretic, at resonance
  }
}

/// The lines of set 55 before its nodes. @return values a node
Index read_result_header(UniversalLines& in, NodalResult& result) {
  result.title = field(need_inside(in, "set 55"), 0, 80);
  for (int i = 1; i < 5; ++i) need_inside(in, "set 55");
  const auto type = numbers_in(need_inside(in, "set 55"));
  if (type.size() < 6) in.fail("holds fewer than six codes of the result's type", "write set 55 again");
  constexpr long most_codes = 100000;  // values a node, integers and reals of a result; a sound file has some ten
  result.analysis = static_cast<int>(count_in(type[1], most_codes).value_or(0));
  result.complex = type[4] == 5.0 || type[4] == 6.0;
  const auto per_node = static_cast<Index>(count_in(type[5], most_codes).value_or(0));
  if (per_node == 0) in.fail(fmt::format("states {:.6g} values a node", type[5]), "write set 55 again");
  // Two numbers tell how many integers and reals follow; lines of eight and six.
  std::vector<double> integers = numbers_in(need_inside(in, "set 55")), reals;
  const auto stated = [&](std::size_t k) {
    return static_cast<std::size_t>(integers.size() > k ? count_in(integers[k], most_codes).value_or(0) : 0);
  };
  const std::size_t n_integers = stated(0), n_reals = stated(1);
  read_numbers(in, 2 + n_integers, integers);
  read_numbers(in, n_reals, reals);
  take_mode(integers, reals, most_codes, result);
  return per_node;
}

Eigen::VectorXcd read_node_values(UniversalLines& in, long node, Index per_node, bool complex) {
  const auto wanted = static_cast<std::size_t>(per_node * (complex ? 2 : 1));
  std::vector<double> values;
  read_numbers(in, wanted, values);
  if (values.size() < wanted)
    in.fail(fmt::format("has {} values at node {}, expected {}", values.size(), node, wanted), "write set 55 again");
  Eigen::VectorXcd vector(per_node);
  for (Index k = 0; k < per_node; ++k) {
    const auto at = static_cast<std::size_t>(k);
    vector[k] = complex ? std::complex<double>(values[2 * at], values[2 * at + 1]) : std::complex<double>(values[at]);
  }
  return vector;
}

void read_result(UniversalLines& in, UniversalData& data) {
  NodalResult result;
  const Index per_node = read_result_header(in, result);
  for (std::string line; in.next(line);) {
    if (is_delimiter(line)) {
      data.results.push_back(std::move(result));
      return;
    }
    if (is_blank(line)) continue;
    const long node = integer_or(field(line, 0, 10), 0);
    result.values[node] = read_node_values(in, node, per_node, result.complex);
  }
  in.fail("breaks off in set 55", kCopyAgain);
}

void read_units(UniversalLines& in, UniversalData& data) {
  need_inside(in, "set 164");
  for (std::string line; in.next(line);) {
    if (is_delimiter(line)) return;
    if (const auto numbers = numbers_in(line); !numbers.empty() && !data.has_units) {
      data.has_units = true;
      if (numbers[0] > 0.0 && std::isfinite(numbers[0])) data.length_factor = numbers[0];
    }
  }
  in.fail("breaks off in set 164, expected -1 at its end", kCopyAgain);
}

}  // namespace

bool read_shape_set(UniversalLines& in, long set, UniversalData& data) {
  if (set == 15 || set == 2411) {
    read_nodes(in, set == 2411, data);
  } else if (set == 2412) {
    read_elements(in, data);
  } else if (set == 82) {
    read_lines(in, data);
  } else if (set == 55) {
    read_result(in, data);
  } else if (set == 164) {
    read_units(in, data);
  } else {
    return false;
  }
  return true;
}

}  // namespace twindeck::records
