#include "diagnosis/form_frame.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "diagnosis/form_magnitudes.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::string kStateContrast = "state ";                             // and its name: that state alone
const std::string kFromState = "from state ", kBeforeState = "before ";  // as Candidate::when says
constexpr double kManySmall = 0.5;       // of the form error's variance in frequencies: many small causes
constexpr double kLeastSingular = 1e-5;  // of the largest singular value: principal columns below carry nothing
constexpr double kNoEffect = 1e-6;       // RMS change of ln f: a hypothesis below moves nothing here
/// Of the screen's first magnitude, for the many small causes. At the whole of it a soft joint puts modes into another order,
/// and the jump explains data by accident. Far below they are too weak beside a model that is far off (decision 0013).
constexpr double kOfMany = 0.7;
/// Places of a hypothesis that stand for all of them among the many small causes: places beside each other do nearly the same.
constexpr std::size_t kPlacesOfMany = 200;
constexpr double kFreeScale = 10.0;  // of a shape, relative: wide enough to cost nothing

const std::vector<std::string>& contrast_keys() {
  static const std::vector<std::string> keys = {"dampers", "amplitude_m", "temperature_C", "wind_m_s", "people"};
  return keys;
}

/// Keys that an action goes by; none for what acts everywhere.
std::vector<std::string> keys_of(const ActionSpec& action) {
  const std::string& kind = action.kind;
  if (kind == "damper.friction") return {"amplitude_m", "dampers"};
  if (kind.starts_with("damper.")) return {"dampers"};
  if (kind == "frequency.amplitude") return {"amplitude_m"};
  if (kind == "mass.per_count" || kind == "person.oscillator") return {"people"};
  if (kind.starts_with("wind.")) return {"wind_m_s"};
  if (kind == "field.stiffness" || kind == "step.stiffness" || kind == "slip.stiffness" || kind == "soften.stiffness") {
    const auto named = action.text.find("variable");
    return {named == action.text.end() ? "temperature_C" : named->second};
  }
  return {};
}

bool is_scatter(Nuisance::Kind kind) {
  return kind == Nuisance::Kind::element_stiffness || kind == Nuisance::Kind::element_mass ||
         kind == Nuisance::Kind::node_mass || kind == Nuisance::Kind::stay;
}

std::vector<double> measured_frequencies(const FeatureMap& map) {
  std::vector<double> out;
  for (const MeasuredMode& mode : map.measured_modes()) out.push_back(mode.frequency_Hz);
  return out;
}

/// Fewer columns of the same covariance C C': many candidates have nearly the same effect.
MatrixXd principal_columns(const MatrixXd& columns) {
  if (columns.cols() < 2 || columns.rows() == 0) return columns;
  const linalg::ThinSvd svd = linalg::thin_svd(columns);
  Index kept = 0;
  while (kept < svd.values.size() && svd.values[kept] > kLeastSingular * svd.values[0]) ++kept;
  return svd.u.leftCols(kept) * svd.values.head(kept).asDiagonal();
}

}  // namespace

std::vector<Contrast> contrasts_of(const FeatureSet& features) {
  std::vector<bool> used(features.conditions.size(), false);
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency || row.type == RowType::shape) used[static_cast<std::size_t>(row.condition)] = true;
  std::vector<Contrast> out;
  for (const std::string& key : contrast_keys()) {
    std::vector<std::optional<double>> values;
    for (std::size_t c = 0; c < used.size(); ++c)
      values.push_back(used[c] ? number_of(features.conditions[c], key) : std::nullopt);
    if (auto contrast = contrast_of(key, values)) out.push_back(std::move(*contrast));
  }
  const std::vector<std::string> states = states_of(features);
  const auto add = [&](const std::string& key, std::size_t from, std::size_t end) {
    Contrast contrast{key, VectorXd::Zero(std::ssize(used))};
    for (std::size_t c = 0; c < used.size(); ++c) {
      const auto state = std::find(states.begin(), states.end(), features.conditions[c].state) - states.begin();
      if (used[c] && state >= static_cast<Index>(from) && state < static_cast<Index>(end))
        contrast.weight[static_cast<Index>(c)] = 1.0;
    }
    if (contrast.weight.sum() > 0.0) out.push_back(std::move(contrast));
  };
  for (std::size_t s = 1; s < states.size(); ++s) add(kStateContrast + states[s], s, s + 1);
  for (std::size_t s = 1; s + 1 < states.size(); ++s) add(kFromState + states[s] + " on", s, states.size());
  return out;
}

namespace {

/// Of what acts in some states alone.
int contrast_of_states(const Candidate& candidate, const std::vector<Contrast>& contrasts) {
  const auto at = [&](const auto& is_it) {
    const auto found = std::find_if(contrasts.begin(), contrasts.end(), is_it);
    return found == contrasts.end() ? -1 : static_cast<int>(found - contrasts.begin());
  };
  const auto named = [&](const std::string& key) { return at([&](const Contrast& c) { return c.key == key; }); };
  const std::string when = candidate.when.empty() ? kStateContrast + candidate.state : candidate.when;
  if (const int own = named(when); own >= 0) return own;
  // What acts before a state tells this one and all after it from the others.
  if (when.starts_with(kBeforeState)) {
    const std::string state = when.substr(kBeforeState.size());
    if (const int own = named("from " + state + " on"); own >= 0) return own;
    return named(state);
  }
  // What acts in the first state alone tells it from every other.
  const int others = at([](const Contrast& c) { return c.key.starts_with(kFromState); });
  return others >= 0 ? others : at([](const Contrast& c) { return c.key.starts_with(kStateContrast); });
}

}  // namespace

std::vector<int> contrasts_of(const Candidate& candidate, const std::vector<Contrast>& contrasts) {
  std::vector<int> out;
  const auto add = [&](int contrast) {
    if (contrast >= 0 && std::find(out.begin(), out.end(), contrast) == out.end()) out.push_back(contrast);
  };
  if (!candidate.state.empty()) add(contrast_of_states(candidate, contrasts));
  if (candidate.state.empty())
    for (const ActionSpec& action : candidate.hypothesis->actions)
      for (const std::string& key : keys_of(action))
        for (std::size_t c = 0; c < contrasts.size(); ++c)
          if (contrasts[c].key == key) add(static_cast<int>(c));
  return out;
}

int contrast_of(const Candidate& candidate, const std::vector<Contrast>& contrasts) {
  const std::vector<int> all = contrasts_of(candidate, contrasts);
  return all.empty() ? -1 : all.front();
}

FormSystem form_system(const Inference& plain, const Fit& fit, const std::vector<Contrast>& contrasts, Index tested) {
  TWINDECK_ASSERT(fit.made());
  const FeatureMap& map = plain.map();
  const std::vector<int>& rows = plain.training();
  const auto n = static_cast<Index>(map.nuisances().size());
  const MatrixXd& j = fit.map.jacobian;
  const Index accepted = j.cols() - n - tested;
  std::vector<int> fixed, scatter;
  for (Index k = 0; k < n; ++k)
    (is_scatter(map.nuisances()[static_cast<std::size_t>(k)].kind) ? scatter : fixed).push_back(static_cast<int>(k));
  for (Index k = 0; k < accepted; ++k) fixed.push_back(static_cast<int>(n + k));
  const FormModes modes = map.form_modes(fit.base, fit.causes);
  const FormColumns form = form_columns(modes.modes, modes.paired, fit.all.g);
  const MatrixXd rotations = close_rotations(modes.paired, measured_frequencies(map), map.values());
  FormSystem out;
  out.sigma_factor = linalg::cholesky_factor(plain.covariance());
  out.fixed.resize(std::ssize(rows), std::ssize(fixed) + fit.map.scales.cols() + rotations.cols());
  out.fixed << j(Eigen::all, fixed), kFreeScale * fit.map.scales, rotations(rows, Eigen::all);
  out.scatter = j(Eigen::all, scatter);
  if (out.scatter.cols() > out.scatter.rows()) {  // a column a row has the same covariance
    const linalg::ThinSvd svd = linalg::thin_svd(out.scatter);
    out.scatter = svd.u * svd.values.asDiagonal();
  }
  const MatrixXd own = form.frequency(rows, Eigen::all), many = many_small_causes(plain, fit, contrasts);
  const double share = many.cols() > 0 ? kManySmall : 0.0;
  out.frequency.resize(std::ssize(rows), own.cols() + many.cols());
  out.frequency.leftCols(own.cols()) = std::sqrt(1.0 - share) * own;
  if (many.cols() > 0) out.frequency.rightCols(many.cols()) = std::sqrt(share) * many;
  out.shape = form.shape(rows, Eigen::all);
  out.kinks = form.kinks(rows, Eigen::all);
  std::vector<int> condition;
  for (const Row& row : map.features().rows) condition.push_back(row.condition);
  for (const Contrast& contrast : contrasts) {
    out.change.push_back({change_columns(form, contrast, condition)(rows, Eigen::all), {}});
    for (Index k = 0; k < tested; ++k) out.change.back().signatures.push_back(static_cast<int>(k));
  }
  VectorXd x = fit.map.x;
  x.tail(tested).setZero();
  out.residual = map.values()(rows) - fit.map.g + j * x;
  out.signatures = j.rightCols(tested);
  if (tested > 0) {
    const Candidate& candidate = *fit.causes.back().candidate;  // the fit has magnitudes in units of twice their range
    for (Index k = 0; k < tested; ++k) out.signatures.col(k) /= 2.0 * (candidate.high[k] - candidate.low[k]);
    out.all_products = true;
  }
  return out;
}

namespace {

/// Candidates for many small causes: those of one size that act in all conditions alike, of many places every so many-th.
std::vector<const Candidate*> places_of_many(const Inference& inference, const std::vector<Contrast>& contrasts) {
  std::map<std::string, std::vector<const Candidate*>> by_hypothesis;
  for (const auto& candidate : inference.candidates()) {
    if (!candidate->state.empty() || contrast_of(*candidate, contrasts) >= 0) continue;
    if (candidate->hypothesis->measurement || candidate->tuned >= 0 || candidate->low.size() != 1) continue;
    by_hypothesis[candidate->hypothesis->id].push_back(candidate.get());
  }
  std::vector<const Candidate*> out;
  for (const auto& [id, all] : by_hypothesis) {
    const std::size_t count = std::min(all.size(), kPlacesOfMany);
    for (std::size_t k = 0; k < count; ++k) out.push_back(all[k * all.size() / count]);
  }
  return out;
}

}  // namespace

MatrixXd many_small_causes(const Inference& inference, const Fit& fit, const std::vector<Contrast>& contrasts) {
  const std::vector<const Candidate*> everywhere = places_of_many(inference, contrasts);
  std::vector<VectorXd> effects(everywhere.size());
  parallel_for(everywhere.size(), [&](std::size_t i) {
    VectorXd small = everywhere[i]->starts.front();
    if (is_a_size(*everywhere[i])) small[0] = scaled_magnitude(*everywhere[i], small[0], kOfMany);
    effects[i] = inference.change(fit, *everywhere[i], small);
  });
  std::map<std::string, std::vector<VectorXd>> by_hypothesis;
  for (std::size_t i = 0; i < everywhere.size(); ++i)
    if (effects[i].size() > 0) by_hypothesis[everywhere[i]->hypothesis->id].push_back(std::move(effects[i]));
  const std::vector<int>& rows = inference.training();
  std::vector<int> frequencies;
  for (const int r : rows)
    if (inference.map().features().rows[static_cast<std::size_t>(r)].type == RowType::frequency) frequencies.push_back(r);
  std::vector<VectorXd> columns;
  int hypotheses = 0;
  for (const auto& [id, changes] : by_hypothesis) {
    double sum = 0.0;
    for (const VectorXd& change : changes) sum += change(frequencies).squaredNorm();
    const double rms = frequencies.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(frequencies.size()));
    if (!(rms > kNoEffect)) continue;
    ++hypotheses;
    for (const VectorXd& change : changes) columns.emplace_back(change(rows) / rms);
  }
  MatrixXd out(std::ssize(rows), std::ssize(columns));
  for (std::size_t k = 0; k < columns.size(); ++k) out.col(static_cast<Index>(k)) = columns[k] / std::sqrt(hypotheses);
  return principal_columns(out);
}

MatrixXd form_covariance(const FeatureMap& map, const FeatureMap::Base& base, const std::vector<Cause>& causes,
                         const VectorXd& predicted, double frequency, double shape) {
  const FormModes modes = map.form_modes(base, causes);
  const FormColumns form = form_columns(modes.modes, modes.paired, predicted);
  MatrixXd all(predicted.size(), form.frequency.cols() + form.shape.cols() + form.kinks.cols());
  all << frequency * form.frequency, shape * form.shape, shape * form.kinks;
  return linalg::product(all, all.transpose());
}

MatrixXd scaled_columns(const FormSystem& system, const ScaleGrid& grid, const ScalePoint& point, int contrast, double kappa) {
  const MatrixXd none(system.residual.size(), 0);
  const MatrixXd& change = contrast >= 0 ? system.change[static_cast<std::size_t>(contrast)].columns : none;
  const double f = grid.frequency[point.frequency], s = grid.shape[point.shape];
  MatrixXd out(system.residual.size(), system.fixed.cols() + system.scatter.cols() + system.frequency.cols() +
                                           system.shape.cols() + system.kinks.cols() + change.cols());
  out << system.fixed, point.scatter * system.scatter, f * system.frequency, s * system.shape, s * system.kinks, kappa * change;
  return out;
}

}  // namespace twindeck::diagnosis
