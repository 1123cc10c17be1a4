#include "diagnosis/prediction/predictor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace twindeck::diagnosis {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kLeastDampingPart = 1e-3;      ///< [-] least part of the structural damping that causes leave
constexpr double kLeastFrequencyFactor = 0.05;  ///< [-] of an amplitude; keeps ln f finite
constexpr double kNearlyVertical = 0.9;  ///< [-] vertical part of a channel's direction; above it, "beside" is found from x
constexpr double kNoDirection = 1e-6;    ///< [-] length below which a direction counts as zero

}  // namespace

double Predictor::structural_damping(const std::string& label) const {
  const auto& labels = map_.damping_modes_;
  const auto at = std::ranges::find(labels, label);
  if (at == labels.end()) return kUsualDamping_pct;
  for (std::size_t j = 0; j < map_.nuisances().size(); ++j) {
    const Nuisance& v = map_.nuisances()[j];
    if (v.kind == Nuisance::Kind::mode_damping && v.index == static_cast<int>(at - labels.begin()))
      return std::exp(v.mean + v.deviation * base_.x[static_cast<Index>(j)]);
  }
  return kUsualDamping_pct;
}

void Predictor::read_channels() {
  std::map<std::vector<bool>, std::shared_ptr<const Reading>> known;  // by the causes that act
  for (const Condition& condition : map_.features().conditions) {
    std::vector<bool> acting;
    for (const Cause& cause : causes_)
      acting.push_back(is_of_a_channel(*cause.candidate) && cause.candidate->acts_in(condition));
    std::shared_ptr<const Reading>& here = known[acting];
    if (!here) here = std::make_shared<const Reading>(reading_in(condition));
    reading_of_.push_back(here);
  }
}

Predictor::Reading Predictor::reading_in(const Condition& condition) const {
  const auto n = static_cast<Index>(map_.features().channels.size());
  Reading out{{}, VectorXd::Ones(n), VectorXd::Zero(n)};
  for (Index c = 0; c < n; ++c) out.views.push_back({{4 * c, 1.0}});
  const auto view = [&](int channel) -> auto& { return out.views[static_cast<std::size_t>(channel)]; };
  each_action(Primitive::channel_swap, condition,
              [&](const Candidate& c, const VectorXd&, const ActionSpec&) { view(c.channels[0]).swap(view(c.channels[1])); });
  each_action(Primitive::channel_rotate, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
    const int channel = c.channels[0];
    const double angle = c.value(action.number.at("angle"), a) * std::numbers::pi / 180.0;
    const Eigen::Vector3d d = map_.features().direction[static_cast<std::size_t>(channel)];
    Eigen::Vector3d beside =
        std::abs(d.z()) < kNearlyVertical ? Eigen::Vector3d(-d.y(), d.x(), 0.0) : Eigen::Vector3d(1.0, 0.0, 0.0);
    beside -= beside.dot(d) * d;
    if (beside.norm() < kNoDirection) return;
    beside.normalize();
    for (auto& [row, weight] : view(channel)) weight *= std::cos(angle);
    for (int k = 0; k < 3; ++k) view(channel).emplace_back(4 * channel + 1 + k, std::sin(angle) * beside[k]);
  });
  each_action(Primitive::channel_gain, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
    out.factor[c.channels[0]] *= c.value(action.number.at("factor"), a);
  });
  each_action(Primitive::channel_sign, condition,
              [&](const Candidate& c, const VectorXd&, const ActionSpec&) { out.factor[c.channels[0]] *= -1.0; });
  each_action(Primitive::channel_delay, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
    out.delay_s[c.channels[0]] += c.value(action.number.at("delay"), a);
  });
  for (std::size_t j = 0; j < map_.nuisances().size(); ++j) {
    const Nuisance& v = map_.nuisances()[j];
    if (v.kind == Nuisance::Kind::gain) out.factor[v.index] *= 1.0 + v.deviation * base_.x[static_cast<Index>(j)];
  }
  return out;
}

Eigen::MatrixXd Predictor::channel_rows(const Reading& reading, const std::vector<int>& columns) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(reading.views), std::ssize(columns));
  const Eigen::MatrixXd& sensors = map_.model().sensors;
  for (Index c = 0; c < out.rows(); ++c)
    for (const auto& [row, weight] : reading.views[static_cast<std::size_t>(c)])
      for (Index k = 0; k < out.cols(); ++k) out(c, k) += weight * sensors(row, columns[static_cast<std::size_t>(k)]);
  return out;
}

const Eigen::MatrixXcd& Predictor::motion(const SolvedState& state, const Reading& reading) {
  const auto [at, is_new] = motion_.try_emplace({&state, &reading});
  if (!is_new) return at->second;
  const auto n = static_cast<Index>(state.columns.size());
  const Eigen::MatrixXd rows = reading.factor.asDiagonal() * channel_rows(reading, state.columns);
  Eigen::MatrixXcd& h = at->second;
  h.resize(rows.rows(), state.modes.s.size());
  h.real() = rows * state.modes.shapes.topRows(n).real();
  h.imag() = rows * state.modes.shapes.topRows(n).imag();
  for (Index c = 0; c < h.rows(); ++c) {
    if (reading.delay_s[c] == 0.0) continue;
    for (Index m = 0; m < h.cols(); ++m)
      h(c, m) *= std::exp(Complex(0.0, -2.0 * std::numbers::pi * state.modes.frequency_Hz(m) * reading.delay_s[c]));
  }
  return h;
}

/// Shape of the model at the channels, scaled to the measured one by weighted least squares on all rows of the shape.
struct Predictor::ScaledShape {
  bool complex_rows;                    ///< measured with imaginary parts
  VectorXcd real_part, imaginary_part;  ///< at the channels of the real and of the imaginary rows, without the scale
  Complex turn = 1.0;                   ///< rotation of a shape measured as real, which makes it as real as possible
  Complex scale = 1.0;
};

Predictor::ScaledShape Predictor::scaled_shape(const MeasuredMode& measured, const SolvedState& state, Index mode) {
  ScaledShape out;
  out.complex_rows = !measured.imag_rows.empty();
  VectorXcd& h = out.real_part;
  const MatrixXcd& moved = motion(state, reading(measured.condition));
  h = moved.col(mode)(measured.real_channels);
  if (!out.complex_rows) {
    const Complex square = (h.transpose() * h)(0);
    out.turn = std::exp(Complex(0.0, -0.5 * std::arg(square)));
    h *= out.turn;
  }
  VectorXcd& hi = out.imaginary_part;
  if (out.complex_rows) hi = moved.col(mode)(measured.imag_channels);
  Complex numerator = 0.0;
  double denominator = 0.0;
  for (Index k = 0; k < std::ssize(measured.real_rows); ++k) {
    const int row = measured.real_rows[static_cast<std::size_t>(k)];
    const double weight = 1.0 / map_.covariance_(row, row);
    numerator += weight * map_.values_[row] * (out.complex_rows ? std::conj(h[k]) : Complex(h[k].real()));
    denominator += weight * (out.complex_rows ? std::norm(h[k]) : h[k].real() * h[k].real());
  }
  for (Index k = 0; k < hi.size(); ++k) {
    const int row = measured.imag_rows[static_cast<std::size_t>(k)];
    const double weight = 1.0 / map_.covariance_(row, row);
    numerator += weight * Complex(0.0, map_.values_[row]) * std::conj(hi[k]);
  }
  out.scale = denominator > 0.0 ? numerator / denominator : Complex(1.0);
  if (!out.complex_rows) out.scale = out.scale.real();
  return out;
}

void Predictor::predict_shape(const MeasuredMode& measured, SolvedState& state, Index mode) {
  const ScaledShape shape = scaled_shape(measured, state, mode);
  const VectorXcd& h = shape.real_part;
  const VectorXcd& hi = shape.imaginary_part;
  const auto count = std::ssize(measured.real_rows);
  VectorXcd y(count), model(count);
  for (Index k = 0; k < count; ++k) {
    const int row = measured.real_rows[static_cast<std::size_t>(k)];
    out_.g[row] = (shape.scale * h[k]).real();
    y[k] = map_.values_[row];
    model[k] = shape.complex_rows ? (shape.scale * h[k]).real() : h[k].real();
  }
  for (Index k = 0; k < hi.size(); ++k) out_.g[measured.imag_rows[static_cast<std::size_t>(k)]] = (shape.scale * hi[k]).imag();
  out_.mac[static_cast<std::size_t>(&measured - map_.modes_.data())] = likeness(model, y)[0];
  if (!with_jacobian_) return;
  for (Index k = 0; k < count; ++k) {
    const int row = measured.real_rows[static_cast<std::size_t>(k)];
    out_.scales(row, scale_) = out_.g[row];
    if (shape.complex_rows) out_.scales(row, scale_ + 1) = (Complex(0, 1) * shape.scale * h[k]).real();
  }
  for (Index k = 0; k < hi.size(); ++k) {
    const int row = measured.imag_rows[static_cast<std::size_t>(k)];
    out_.scales(row, scale_) = out_.g[row];
    out_.scales(row, scale_ + 1) = (Complex(0, 1) * shape.scale * hi[k]).imag();
  }
  scale_ += shape.complex_rows ? 2 : 1;
  differentiate_shape(measured, state, mode, shape);
}

void Predictor::differentiate_shape(const MeasuredMode& measured, SolvedState& state, Index mode, const ScaledShape& shape) {
  const double f = state.modes.frequency_Hz(mode);
  const ModeDerivative& d = derivative(state, mode);
  const auto& position = changes(state).position;
  const auto n = static_cast<Index>(state.columns.size());
  const Reading& read = reading(measured.condition);
  const Eigen::MatrixXd rows_here = read.factor.asDiagonal() * channel_rows(read, state.columns);
  for (const bool imaginary : {false, true}) {
    const auto& rows = imaginary ? measured.imag_rows : measured.real_rows;
    const auto& channels = imaginary ? measured.imag_channels : measured.real_channels;
    if (rows.empty()) continue;
    const Eigen::MatrixXd picked = rows_here(channels, Eigen::all);
    Eigen::MatrixXcd change(picked.rows(), d.shapes.cols());
    change.real() = picked * d.shapes.topRows(n).real();
    change.imag() = picked * d.shapes.topRows(n).imag();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Complex late = std::exp(Complex(0.0, -2.0 * std::numbers::pi * f * read.delay_s[channels[k]]));
      for (std::size_t j = 0; j < position.size(); ++j) {
        const Complex value = shape.scale * shape.turn * late * change(static_cast<Index>(k), static_cast<Index>(j));
        out_.jacobian(rows[k], position[j]) = imaginary ? value.imag() : value.real();
      }
    }
    for (std::size_t j = 0; j < map_.nuisances_.size(); ++j) {
      const Nuisance& v = map_.nuisances_[j];
      if (v.kind != Nuisance::Kind::gain) continue;
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (v.index == channels[k])
          out_.jacobian(rows[k], static_cast<Index>(j)) =
              v.deviation * out_.g[rows[k]] / (1.0 + v.deviation * base_.x[static_cast<Index>(j)]);
    }
  }
}

Predictor::AddedToMode Predictor::added_to(const MeasuredMode& measured, const SolvedState& state, Index mode) const {
  const Condition& condition = map_.features().condition_of(measured);
  const Complex s = state.modes.s[mode];
  const VectorXcd phi = state.modes.shapes.col(mode);
  AddedToMode added;
  each_action(Primitive::frequency_amplitude, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
    if (!c.mode.empty() && c.mode != measured.label) return;
    const double amplitude = condition.amplitude_m.value_or(0.0);
    added.frequency +=
        std::log(std::max(1.0 + c.value(action.number.at("curvature"), a) * amplitude * amplitude, kLeastFrequencyFactor));
  });
  each_action(Primitive::damping_add, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
    if (c.mode.empty() || c.mode == measured.label) added.damping_pct += 100.0 * c.value(action.number.at("ratio"), a);
  });
  each_action(Primitive::wind_damping, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
    added.damping_pct += 100.0 * c.value(action.number.at("rate"), a) * condition.wind_m_s.value_or(0.0);
  });
  each_action(Primitive::person_oscillator, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
    const double people = condition.people.value_or(0.0);
    if (!(people > 0.0)) return;
    const ReducedPlace& place = *c.places[0];
    const double deck = place.attributes.contains("deck_mass") ? place.attributes.at("deck_mass") : map_.model().total_mass_kg;
    const Eigen::MatrixXd m = sliced(place.mass, state.columns, phi.size());
    const double ratio = people * c.value(action.number.at("mass"), a) / deck *
                         (phi.real().dot(m * phi.real()) + phi.imag().dot(m * phi.imag()));
    const double wp = 2.0 * std::numbers::pi * c.value(action.number.at("frequency"), a),
                 zp = c.value(action.number.at("damping"), a);
    const Complex transfer = (2.0 * zp * wp * s + wp * wp) / (s * s + 2.0 * zp * wp * s + wp * wp);
    const Complex change = -0.5 * ratio * (transfer - 1.0);  // ds/s for a mass that follows with `transfer` instead of rigidly
    added.frequency += change.real();
    added.damping_pct += 100.0 * change.imag();  // ds = s change and s is nearly i |s|, so -Re ds / |s| is Im change
  });
  return added;
}

double Predictor::damping_slope_pct(Complex s, Complex ds) {
  return 100.0 * (-ds.real() / std::abs(s) + s.real() / std::abs(s) * (ds / s).real());
}

bool Predictor::is_damping_of(const Nuisance& v, const std::string& damping_name) const {
  return v.kind == Nuisance::Kind::mode_damping && map_.damping_modes_[static_cast<std::size_t>(v.index)] == damping_name;
}

void Predictor::differentiate_mode(const MeasuredMode& measured, SolvedState& state, Index mode,
                                   const std::string& damping_name, double own_pct, double total_pct) {
  const Complex s = state.modes.s[mode];
  const ModeDerivative& d = derivative(state, mode);
  const auto& position_of = changes(state).position;
  for (std::size_t j = 0; j < position_of.size(); ++j) {
    const Complex ds = d.s[static_cast<Index>(j)];
    const double relative = (ds / s).real();
    if (measured.frequency >= 0) out_.jacobian(measured.frequency, position_of[j]) = relative;
    if (measured.damping >= 0) out_.jacobian(measured.damping, position_of[j]) = damping_slope_pct(s, ds) / total_pct;
  }
  if (measured.damping >= 0) {
    for (std::size_t j = 0; j < map_.nuisances_.size(); ++j) {
      const Nuisance& v = map_.nuisances_[j];
      if (is_damping_of(v, damping_name))
        out_.jacobian(measured.damping, static_cast<Index>(j)) = v.deviation * own_pct / total_pct;
    }
  }
}

int Predictor::mode_of_shape(const MeasuredMode& measured, std::size_t position) const {
  int shape_of = out_.paired[position];
  each_action(Primitive::modes_exchange, map_.features().conditions[static_cast<std::size_t>(measured.condition)],
              [&](const Candidate& c, const VectorXd&, const ActionSpec&) {
                std::vector<std::size_t> same;
                for (std::size_t m = 0; m < map_.modes_.size(); ++m)
                  if (map_.modes_[m].condition == measured.condition && map_.modes_[m].real_rows.size() >= 2) same.push_back(m);
                for (std::size_t k = 0; k + 1 < same.size(); ++k) {
                  if (map_.modes_[same[k]].label != c.mode) continue;
                  if (position == same[k])
                    shape_of = out_.paired[same[k + 1]];
                  else if (position == same[k + 1])
                    shape_of = out_.paired[same[k]];
                  break;
                }
              });
  return shape_of;
}

void Predictor::predict_mode(const MeasuredMode& measured, std::size_t position) {
  const int chosen = out_.paired[position];
  if (chosen < 0) {
    for (const int row : {measured.frequency, measured.damping})
      if (row >= 0) out_.open.push_back(row);
    leave_shape_open(measured);
    return;
  }
  SolvedState& state = solved(measured.condition);
  const AddedToMode added = added_to(measured, state, chosen);
  out_.frequency_Hz[position] = state.modes.frequency_Hz(chosen) * std::exp(added.frequency);
  if (measured.frequency >= 0) out_.g[measured.frequency] = std::log(out_.frequency_Hz[position]);
  const std::string damping_name = map_.damping_name(measured.label, measured.condition);
  const double own = structural_damping(damping_name);
  const double total = std::max(own + 100.0 * state.modes.damping(chosen) + added.damping_pct, kLeastDampingPart * own);
  if (measured.damping >= 0) out_.g[measured.damping] = std::log(total);
  if (with_jacobian_ && (measured.frequency >= 0 || measured.damping >= 0))
    differentiate_mode(measured, state, chosen, damping_name, own, total);
  if (measured.real_rows.empty()) return;
  const int shape_of = mode_of_shape(measured, position);
  if (shape_of >= 0)
    predict_shape(measured, state, shape_of);
  else
    leave_shape_open(measured);
}

void Predictor::leave_shape_open(const MeasuredMode& measured) {
  out_.open.insert(out_.open.end(), measured.real_rows.begin(), measured.real_rows.end());
  out_.open.insert(out_.open.end(), measured.imag_rows.begin(), measured.imag_rows.end());
}

void Predictor::predict_stays() {
  const auto stays = map_.model().sets.find("stays");
  for (std::size_t r = 0; r < map_.features().rows.size(); ++r) {
    const Row& row = map_.features().rows[r];
    if (row.type != RowType::stay_frequency) continue;
    const auto at = static_cast<Index>(r);
    double g = std::log(std::max(1.0, std::atof(row.mode.c_str())));
    if (stays != map_.model().sets.end()) {
      for (std::size_t i = 0; i < stays->second.size(); ++i) {
        const ReducedPlace& stay = stays->second[i];
        if (stay.id.substr(5) != row.stay) continue;
        g += std::log(stay.attributes.at("f_cable"));
        for (std::size_t j = 0; j < map_.nuisances_.size(); ++j) {
          const Nuisance& v = map_.nuisances_[j];
          if (v.kind != Nuisance::Kind::stay_pull || v.index != static_cast<int>(i)) continue;
          g += 0.5 * v.deviation * base_.x[static_cast<Index>(j)];  // f ~ sqrt(force)
          if (with_jacobian_) out_.jacobian(at, static_cast<Index>(j)) = 0.5 * v.deviation;
        }
        const Condition& condition = map_.features().condition_of(row);
        each_action(Primitive::stay_frequency, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
          if (c.places[0] == &stay) g += std::log(c.value(action.number.at("factor"), a));
        });
        each_action(Primitive::stay_pull, condition, [&](const Candidate& c, const VectorXd& a, const ActionSpec& action) {
          if (c.places[0] == &stay) g += 0.5 * std::log(c.value(action.number.at("factor"), a));  // f ~ sqrt(force)
        });
      }
    }
    out_.g[at] = g;
  }
}

void Predictor::differentiate_paired() {
  std::map<SolvedState*, std::set<Index>> paired;
  for (std::size_t m = 0; m < map_.modes_.size(); ++m)
    if (out_.paired[m] >= 0) paired[&solved(map_.modes_[m].condition)].insert(out_.paired[m]);
  for (const auto& [state, modes] : paired) differentiate_modes(*state, {modes.begin(), modes.end()});
}

Prediction Predictor::run() {
  const auto n = static_cast<Index>(map_.features().rows.size());
  const std::size_t modes = map_.modes_.size();
  out_.valid = true;
  out_.g = map_.values_;
  out_.paired.assign(modes, -1);
  out_.frequency_Hz.assign(modes, 0.0);
  out_.mac.assign(modes, std::numeric_limits<double>::quiet_NaN());
  if (with_jacobian_) {
    out_.jacobian = Eigen::MatrixXd::Zero(n, static_cast<Index>(map_.nuisances_.size()));
    out_.scales = Eigen::MatrixXd::Zero(n, map_.n_scales_);
  }
  std::vector<bool> modal(map_.features().conditions.size(), false), loaded(modal), tested(modal);
  for (const MeasuredMode& mode : map_.modes_) modal[static_cast<std::size_t>(mode.condition)] = true;
  for (const Row& row : map_.features().rows)
    if (row.type == RowType::rms || row.type == RowType::psd_floor) loaded[static_cast<std::size_t>(row.condition)] = true;
  for (const Row& row : map_.features().rows)
    if (is_static(row.type)) tested[static_cast<std::size_t>(row.condition)] = true;
  std::vector<std::vector<int>> alike;  // conditions in the same state of the structure
  for (std::size_t c = 0; c < modal.size(); ++c) {
    if (!modal[c]) continue;
    const auto condition = static_cast<int>(c);
    // A label holds within one state. Two states are paired separately, even if nothing has changed between them yet.
    const auto known = std::ranges::find_if(alike, [&](const auto& group) {
      return &solved(group[0]) == &solved(condition) && map_.same_state(group[0], condition);
    });
    if (known == alike.end())
      alike.push_back({condition});
    else
      known->push_back(condition);
  }
  for (const auto& group : alike) pair(group);
  if (with_jacobian_) differentiate_paired();
  for (std::size_t m = 0; m < modes; ++m) predict_mode(map_.modes_[m], m);
  out_.valid = modes == 0 || std::ranges::any_of(out_.paired, [](int mode) { return mode >= 0; });
  if (!out_.valid) return out_;
  for (std::size_t c = 0; c < loaded.size(); ++c)
    if (loaded[c]) predict_load(static_cast<int>(c));
  predict_stays();
  for (std::size_t c = 0; c < tested.size() && out_.valid; ++c)
    if (tested[c]) predict_load_tests(static_cast<int>(c));
  if (!out_.valid) return out_;
  out_.valid = out_.g.allFinite() && (!with_jacobian_ || out_.jacobian.allFinite());
  return out_;
}

std::map<std::string, VectorXd> Predictor::node_motion() {
  std::map<std::string, VectorXd> motion;
  const auto nodes = map_.model().sets.find("nodes");
  const Prediction prediction = run();
  if (nodes == map_.model().sets.end() || !prediction.valid) return motion;
  const auto modes = static_cast<Index>(map_.modes_.size());
  VectorXd largest = VectorXd::Zero(modes);
  for (const ReducedPlace& node : nodes->second) {
    for (Index d = 0; d < node.directions.cols(); ++d) {
      const std::string name = node.id + (node.directions.cols() == 3 ? std::string(" ") + "xyz"[d] : "");
      VectorXd values(modes);
      for (Index m = 0; m < modes; ++m) {
        values[m] = 0.0;
        if (prediction.paired[static_cast<std::size_t>(m)] < 0) continue;
        SolvedState& state = solved(map_.modes_[static_cast<std::size_t>(m)].condition);
        const VectorXcd phi = state.modes.shapes.col(prediction.paired[static_cast<std::size_t>(m)]);
        values[m] = std::abs(sliced(node.directions, d, state.columns, phi.size()).cast<Complex>().dot(phi));
      }
      largest = largest.cwiseMax(values);
      motion[name] = values;
    }
  }
  for (auto& [name, values] : motion) values = values.cwiseQuotient(largest.cwiseMax(1e-300));
  return motion;
}

std::map<std::string, VectorXd> FeatureMap::node_motion(const Base& base, const std::vector<Cause>& causes) const {
  return Predictor(*this, base, causes, false).node_motion();
}

Prediction FeatureMap::predict(const Base& base, const std::vector<Cause>& causes, bool with_jacobian) const {
  return Predictor(*this, base, causes, with_jacobian).run();
}

}  // namespace twindeck::diagnosis
