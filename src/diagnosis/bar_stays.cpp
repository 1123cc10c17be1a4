#include "diagnosis/bar_stays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "dynamics/eigenmodes.hpp"
#include "fe/cable.hpp"
#include "fe/swinging_stays.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int cable_pieces = 6;            ///< the third frequency is then 1.4 % low, the first two within 0.3 %
constexpr double least_log_odds = 7.0;     ///< [nats] what acts in all conditions needs so much (decision 0013)
constexpr std::size_t least_channels = 3;  ///< a shape of two channels is like half of all others
constexpr double cable_reach = 2.0;  ///< [-] of the highest measured frequency: a stay that begins above it moves as its ends
                                     ///< do, but for a third of its inertia
constexpr double least_harmonic_std = 0.002;  ///< [-] of a stay's own frequency: what the ends' motion changes it by
constexpr double model_force_std = 0.10;      ///< [-] of a force that nobody measured, as scatter.stay_pull
constexpr double ninety = 1.645;              ///< [-] deviations of a 90 % interval

std::vector<MeasuredShape> shapes_of(const FeatureSet& features) {
  std::map<std::pair<int, std::string>, MeasuredShape> found;
  std::vector<std::pair<int, std::string>> order;
  std::map<std::pair<int, std::string>, std::map<int, std::complex<double>>> values;
  bool without = false;
  for (const Condition& condition : features.conditions) without = without || condition.dampers_on == false;
  for (const Row& row : features.rows) {
    const std::pair<int, std::string> key{row.condition, row.mode};
    if (without && features.conditions[static_cast<std::size_t>(row.condition)].dampers_on.value_or(false)) continue;
    if (row.type == RowType::frequency) {
      found[key] = {row.mode, row.condition, row.value, {}, {}};
      order.push_back(key);
    }
    if (row.type == RowType::shape) values[key][row.channel] += row.value;
    if (row.type == RowType::shape_imag) values[key][row.channel] += std::complex<double>(0.0, row.value);
  }
  std::vector<MeasuredShape> out;
  for (const auto& key : order) {
    const auto& shape = values[key];
    if (shape.size() < least_channels) continue;
    MeasuredShape& mode = found.at(key);
    mode.values.resize(std::ssize(shape));
    for (const auto& [channel, value] : shape) {
      mode.values[std::ssize(mode.channels)] = value;
      mode.channels.push_back(channel);
    }
    out.push_back(std::move(mode));
  }
  return out;
}

/// A stay's force: from its measured frequencies, else the model's.
FoundStay force_of(const Structure& structure, int element, const std::vector<Row>& stay_rows) {
  const fe::Element& stay = structure.model->elements[static_cast<std::size_t>(element)];
  FoundStay out{fe::stay_name(stay), element, 0.0, 0.0, 0.0, false};
  std::vector<fe::StayHarmonic> harmonics;
  double weight = 0.0;
  for (const Row& row : stay_rows) {
    if (row.stay != out.name || !(row.value > 0.0)) continue;
    harmonics.push_back(
        {std::max(1, std::atoi(row.mode.c_str())), row.value, std::max(row.std / row.value, least_harmonic_std)});
    weight += std::pow(harmonics.back().relative_std, -2);
  }
  double std = model_force_std;
  out.force_N = fe::force_of_harmonics(*structure.model, stay, harmonics, cable_pieces);
  out.measured = out.force_N > 0.0;
  if (out.measured)
    std = 2.0 / std::sqrt(weight);  // the force goes with the square of the frequency
  else
    out.force_N = structure.state->stay_pull_N.size() > 0 ? structure.state->stay_pull_N[element] : stay.pull_N;
  out.low_N = out.force_N * std::exp(-ninety * std);
  out.high_N = out.force_N * std::exp(ninety * std);
  return out;
}

/// Stays under force that can swing below `highest_Hz`, with their first frequencies.
struct Candidates {
  std::vector<FoundStay> stays;
  std::vector<fe::Cable> cables;
  std::vector<double> own_Hz;
};
Candidates stays_that_may_swing(const Structure& structure, const std::vector<Row>& stay_rows, double highest_Hz) {
  Candidates out;
  for (std::size_t e = 0; e < structure.model->elements.size(); ++e) {
    const fe::Element& stay = structure.model->elements[e];
    if (stay.type != fe::ElementType::stay) continue;
    FoundStay found = force_of(structure, static_cast<int>(e), stay_rows);
    if (!(found.force_N > 0.0)) continue;
    fe::Cable cable = fe::cable_beyond_bar(*structure.model, stay, found.force_N, cable_pieces);
    const double own = fe::in_plane_frequencies(*structure.model, stay, cable)[0];
    if (own > highest_Hz) continue;
    out.stays.push_back(std::move(found));
    out.cables.push_back(std::move(cable));
    out.own_Hz.push_back(own);
  }
  return out;
}

/// Whether a multiple of a stay's first frequency lies near a mode that the model does not explain.
bool any_near(const Candidates& candidates, const std::vector<MeasuredShape>& measured, const Explanation& before,
              double within) {
  for (std::size_t m = 0; m < measured.size(); ++m)
    for (const double own : candidates.own_Hz)
      for (int harmonic = 1; harmonic <= cable_pieces / 2 && !before.explained[m]; ++harmonic)
        if (std::abs(std::log(harmonic * own / measured[m].frequency_Hz)) <= within) return true;
  return false;
}

std::vector<SwingingCable> reduced(const Structure& structure, const Candidates& candidates, const MatrixXd& shapes,
                                   double highest_Hz) {
  const MatrixXd motion = structure.system->expand(shapes);
  std::vector<SwingingCable> out;
  for (std::size_t i = 0; i < candidates.cables.size(); ++i) {
    const fe::Element& stay = structure.model->elements[static_cast<std::size_t>(candidates.stays[i].element)];
    MatrixXd ends(6, motion.cols());
    ends << motion.middleRows(6 * stay.nodes[0], 3), motion.middleRows(6 * stay.nodes[1], 3);
    out.push_back(swinging_cable(candidates.cables[i].stiffness, candidates.cables[i].mass, ends, highest_Hz));
  }
  return out;
}

int count_below(const Eigen::VectorXd& frequency_Hz, double limit) {
  return static_cast<int>((frequency_Hz.array() <= limit).count());
}

}  // namespace

std::optional<BarStays> find_bar_stays(const Structure& structure, const FeatureSet& features,
                                       const std::vector<Row>& stay_rows, const BarStaysOptions& options) {
  if (structure.model == nullptr || structure.state == nullptr) return std::nullopt;
  const std::vector<MeasuredShape> measured = shapes_of(features);
  if (measured.empty()) return std::nullopt;
  double highest = 0.0;
  for (const MeasuredShape& m : measured) highest = std::max(highest, m.frequency_Hz);
  const Candidates candidates = stays_that_may_swing(structure, stay_rows, cable_reach * highest);
  if (candidates.stays.empty()) return std::nullopt;

  // 1. What the model with bars leaves.
  dynamics::ModalSolver solver(*structure.system);
  const dynamics::EigenModes modes =
      solver.solve(structure.theta, static_cast<int>(std::min<Index>(options.modes, structure.system->size())));
  if (!modes.status.converged) return std::nullopt;
  BarModes bars{modes.eigenvalue, {}};
  const MatrixXd sensors = structure.sensors(modes.shapes);
  bars.channels = sensors(Eigen::seqN(0, sensors.rows() / 4, 4), Eigen::all);
  const VisibleModes visible{modes.frequency_Hz, bars.channels};
  BarStays out;
  out.rule.least_mac = options.least_mac;
  out.rule.within = frequency_scatter(measured, visible, options.least_mac);
  if (!any_near(candidates, measured, explain(measured, visible, out.rule), out.rule.within)) return std::nullopt;

  // 2. The stays whose swinging explains it.
  const std::vector<SwingingCable> cables = reduced(structure, candidates, modes.shapes, cable_reach * highest);
  const StayChoice choice = choose_swinging(bars, cables, candidates.own_Hz, measured, out.rule);
  out.log_odds = choice.log_odds;
  if (!(out.log_odds >= least_log_odds) || choice.after.count <= choice.before.count) return std::nullopt;

  // 3. The model in which they do.
  std::vector<fe::SwingingStay> swinging;
  for (const int i : choice.swinging) {
    out.stays.push_back(candidates.stays[static_cast<std::size_t>(i)]);
    swinging.push_back({out.stays.back().element, out.stays.back().force_N});
  }
  out.extended = fe::with_swinging_stays(*structure.model, swinging, cable_pieces);
  out.modes_in_basis =
      count_below(choice.modes.frequency_Hz, modes.frequency_Hz[std::max<Index>(modes.frequency_Hz.size() / 2, 1) - 1]);
  out.modes_in_band = count_below(choice.modes.frequency_Hz, highest);
  return out;
}

}  // namespace twindeck::diagnosis
