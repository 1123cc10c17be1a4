#include "diagnosis/causes/bar_stays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "dynamics/eigenmodes.hpp"
#include "fe/cable.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int cable_pieces = 6;            ///< with six pieces the third frequency is 1.4 % low, the first two are within 0.3 %
constexpr double least_log_odds = 7.0;     ///< [nats] least ln odds for swinging stays: a thousand to one
constexpr std::size_t least_channels = 3;  ///< with two channels, a shape resembles half of all others
constexpr double cable_reach = 2.0;  ///< [-] of the highest measured frequency. A stay with a higher first frequency follows
                                     ///< its ends, except for a third of its inertia
constexpr double least_harmonic_std = 0.002;  ///< [-] change of a stay's own frequency by the motion of its ends
constexpr double twin_force_std = 0.05;       ///< [-] difference of the forces of mirror-image stays, from the site's records
constexpr double twin_tolerance = 0.01;       ///< [-] of length and modelled force: difference of mirror images by meshing
constexpr double model_force_std = 0.10;      ///< [-] of a force that was not measured, as scatter.stay_pull

std::vector<MeasuredShape> shapes_of(const FeatureSet& features) {
  std::map<std::pair<int, std::string>, MeasuredShape> found;
  std::vector<std::pair<int, std::string>> order;
  std::map<std::pair<int, std::string>, std::map<int, std::complex<double>>> values;
  bool without = false;
  for (const Condition& condition : features.conditions) without = without || condition.dampers_on == false;
  for (const Row& row : features.rows) {
    const std::pair<int, std::string> key{row.condition, row.mode};
    if (without && features.condition_of(row).dampers_on.value_or(false)) continue;
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

double model_force(const Structure& structure, int element) {
  return structure.state->stay_pull_N.size() > 0 ? structure.state->stay_pull_N[element]
                                                 : structure.model->elements[static_cast<std::size_t>(element)].pull_N;
}

/// Whether two stays are mirror images: equal section, material, length and modelled force.
bool are_twins(const Structure& structure, int a, int b) {
  const fe::Element& one = structure.model->elements[static_cast<std::size_t>(a)];
  const fe::Element& other = structure.model->elements[static_cast<std::size_t>(b)];
  const auto length = [&](const fe::Element& stay) {
    const auto& nodes = structure.model->nodes;
    return (nodes[static_cast<std::size_t>(stay.nodes[1])].x_m - nodes[static_cast<std::size_t>(stay.nodes[0])].x_m).norm();
  };
  const double forces = model_force(structure, a) / model_force(structure, b);
  return one.section == other.section && one.material == other.material &&
         std::abs(length(one) / length(other) - 1.0) < twin_tolerance && std::abs(forces - 1.0) < twin_tolerance;
}

/// Force at which a stay has its measured frequencies; 0 if none was measured.
FoundStay measured_force(const Structure& structure, int element, const std::vector<Row>& stay_rows) {
  const fe::Element& stay = structure.model->elements[static_cast<std::size_t>(element)];
  FoundStay out{fe::stay_name(stay), element, 0.0, 0.0, ForceSource::measured};
  std::vector<fe::StayHarmonic> harmonics;
  double weight = 0.0;
  for (const Row& row : stay_rows) {
    if (row.stay != out.name || !(row.value > 0.0)) continue;
    harmonics.push_back(
        {std::max(1, std::atoi(row.mode.c_str())), row.value, std::max(row.std / row.value, least_harmonic_std)});
  }
  out.force_N = fe::force_of_harmonics(*structure.model, stay, harmonics, cable_pieces);
  if (!(out.force_N > 0.0)) return out;
  const Eigen::VectorXd f =
      fe::in_plane_frequencies(*structure.model, stay, fe::cable_beyond_bar(*structure.model, stay, out.force_N, cable_pieces));
  double misfit = 0.0, rows = 0.0;
  for (const fe::StayHarmonic& h : harmonics) {
    if (h.number > f.size()) continue;
    misfit += std::pow(std::log(f[h.number - 1] / h.frequency_Hz) / h.relative_std, 2);
    weight += std::pow(h.relative_std, -2);
    rows += 1.0;
  }
  // The force is proportional to the squared frequency. Rows that disagree (with and without sleeves) increase its deviation
  // (Birge 1932).
  out.relative_std = 2.0 * std::sqrt(std::max(1.0, misfit / std::max(1.0, rows - 1.0)) / weight);
  return out;
}

/// Force of every stay under tension: from its own frequencies, else from those of its mirror image, else from the model.
std::vector<FoundStay> forces(const Structure& structure, const std::vector<Row>& stay_rows) {
  std::vector<FoundStay> out;
  for (std::size_t e = 0; e < structure.model->elements.size(); ++e)
    if (structure.model->elements[e].type == fe::ElementType::stay)
      out.push_back(measured_force(structure, static_cast<int>(e), stay_rows));
  for (FoundStay& stay : out) {
    if (stay.force_N > 0.0) continue;
    double sum = 0.0;
    int twins = 0;
    for (const FoundStay& other : out) {
      if (other.source != ForceSource::measured || !(other.force_N > 0.0) || !are_twins(structure, stay.element, other.element))
        continue;
      sum += other.force_N;
      ++twins;
    }
    stay.source = twins > 0 ? ForceSource::twin : ForceSource::model;
    stay.force_N = twins > 0 ? sum / twins : model_force(structure, stay.element);
    stay.relative_std = twins > 0 ? twin_force_std : model_force_std;
  }
  std::erase_if(out, [](const FoundStay& stay) { return !(stay.force_N > 0.0); });
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
  for (FoundStay& found : forces(structure, stay_rows)) {
    const fe::Element& stay = structure.model->elements[static_cast<std::size_t>(found.element)];
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
bool any_near(const Candidates& candidates, const std::vector<MeasuredShape>& measured, const ExplainedModes& before,
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

/// ln of the likelihood ratio of a stay's own frequencies, as a cable against a bar without frequencies. The lowest frequency
/// does not count, because the force was found from it.
double own_log_odds(const FoundStay& stay, const fe::Cable& cable, const Structure& structure,
                    const std::vector<Row>& stay_rows, const ExplanationRule& rule) {
  const fe::Element& element = structure.model->elements[static_cast<std::size_t>(stay.element)];
  const Eigen::VectorXd own = fe::in_plane_frequencies(*structure.model, element, cable);
  std::vector<MeasuredShape> measured;
  int lowest = static_cast<int>(own.size()) + 1;
  for (const Row& row : stay_rows)
    if (row.stay == stay.name) lowest = std::min(lowest, std::max(1, std::atoi(row.mode.c_str())));
  for (const Row& row : stay_rows) {
    const int number = std::max(1, std::atoi(row.mode.c_str()));
    if (row.stay == stay.name && number > lowest && number <= own.size())
      measured.push_back({row.mode, row.condition, row.value, {0}, Eigen::VectorXcd::Ones(1)});
  }
  const VisibleModes none{Eigen::VectorXd::Zero(1), MatrixXd::Ones(1, 1)}, swinging{own, MatrixXd::Ones(1, own.size())};
  return explain(measured, swinging, rule).log_likelihood - explain(measured, none, rule).log_likelihood;
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

  // 1. Modes that the model with bars does not explain.
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

  // 2. Stays that explain them by swinging.
  const std::vector<SwingingCable> cables = reduced(structure, candidates, modes.shapes, cable_reach * highest);
  std::vector<int> known;
  for (std::size_t i = 0; i < candidates.stays.size(); ++i)
    if (candidates.stays[i].source != ForceSource::model) known.push_back(static_cast<int>(i));
  const StayChoice choice = choose_swinging(bars, cables, candidates.own_Hz, known, measured, out.rule, least_log_odds);
  out.deck_log_odds = out.log_odds = choice.log_odds;
  for (const int i : choice.swinging) {
    const auto k = static_cast<std::size_t>(i);
    if (candidates.stays[k].source == ForceSource::measured)
      out.log_odds += own_log_odds(candidates.stays[k], candidates.cables[k], structure, stay_rows, out.rule);
  }
  if (!(out.log_odds >= least_log_odds) || !(out.deck_log_odds > 0.0) || choice.after.count <= choice.before.count)
    return std::nullopt;

  // 3. The model with these stays as cables.
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
