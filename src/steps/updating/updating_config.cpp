#include "steps/updating/updating_config.hpp"

#include <algorithm>
#include <optional>

namespace twindeck::steps {

namespace {

std::optional<io::FieldTable::Broken> broken_weights(const UpdatingConfig& config) {
  if (std::find(config.residuals.begin(), config.residuals.end(), "frequency") == config.residuals.end())
    return io::FieldTable::Broken{"residuals", "lacks \"frequency\"",
                                  "write residuals = [\"frequency\"] or [\"frequency\", \"shape\"]"};
  if (config.weighs_shapes() && config.weights == "relative")
    return io::FieldTable::Broken{"weights", "is \"relative\", which says nothing of shapes",
                                  "write weights = \"covariance\", or residuals = [\"frequency\"]"};
  if (config.frequency_model_error > 0.0 && !config.weighs())
    return io::FieldTable::Broken{"frequency_model_error", "is set, but the weights are relative and know no deviations",
                                  "write weights = \"covariance\", or leave the key out"};
  if (config.shape_model_error > 0.0 && !config.weighs_shapes())
    return io::FieldTable::Broken{"shape_model_error", "is set, but shapes are not fitted",
                                  "write residuals = [\"frequency\", \"shape\"], or leave the key out"};
  return std::nullopt;
}

}  // namespace

io::FieldTable UpdatingConfig::fields() {
  io::FieldTable table;
  table
      .choice("parameters_from", parameters_from, {"list", "s5_sensitivity"},
              "which parameters are updated: those of `parameters`, or those that s5_sensitivity selected")
      .texts("parameters", parameters, "names of the parameters to update; empty: all that have a range")
      .boolean("beside_selection", beside_selection,
               "beside the parameters listed, the same update of those that s5_sensitivity selected (selected.csv, "
               "leave_one_out_selected.csv)")
      .texts("pairs", pairs, "published assignment such as \"7X-8N\", used where no shape was measured; empty: by order")
      .texts("common_pairs", common_pairs,
             "measured modes (\"7X\") of a second mean error, over pairs that an earlier table has too")
      .text("condition", condition,
            "condition of the measured features, unless --condition or --state says another; empty: the only one, or where "
            "dampers were switched the only one without")
      .number("trust_radius", trust_radius, "", io::positive(), "initial trust radius of the dogleg, in normalised parameters")
      .integer("starts", starts, {1.0, 1000.0}, "searches: from the initial values, and from seeded points inside the bounds")
      .integer("n_modes", n_modes, {1.0, 200.0}, "modes solved for, among which the paired ones are followed")
      .integer("max_iterations", max_iterations, {1.0, 1e5}, "most steps of one solve at fixed prestress")
      .integer("outer_iterations", outer_iterations, {1.0, 1000.0}, "most prestress states of one search")
      .number("optimality_tolerance", optimality_tolerance, "", {1e-12, 1e-2, true},
              "projected gradient at which a solve has converged, relative to the gradient at its start")
      .number("minimum_mac", minimum_mac, "", {0.0, 1.0}, "pairing by MAC: pairs below it are none; the modes stay unpaired")
      .number("least_paired", least_paired, "", {0.0, 1.0},
              "pairing by MAC: share of the measured modes that must have a partner, else the step refuses")
      .number("maximum_frequency_error", maximum_frequency_error, "", io::positive(),
              "relative, of a frequency: a pair by MAC further apart is not admitted, and pairs by order are warned of")
      .number("cluster_gap", cluster_gap, "", io::non_negative(),
              "pairing by MAC: relative gap below which modes count as close")
      .number("sensor_tolerance", sensor_tolerance_m, "m", io::non_negative(), "largest distance of a sensor from its node")
      .boolean("leave_one_out", leave_one_out,
               "afterwards each pair is left out in turn and predicted by an update to the others (leave_one_out.csv)")
      .choices("residuals", residuals, {"frequency", "shape"},
               "what is fitted: frequencies, and shapes too (any scale of each is free; docs/updating_on_shapes.md)")
      .choice(
          "weights", weights, {"automatic", "relative", "covariance"},
          "relative: errors of frequencies relative to the measured ones, the paper's Eq. (5); covariance: standard deviations "
          "or covariance.npy of the features; automatic: covariance with shapes, else relative")
      .number("frequency_model_error", frequency_model_error, "", io::non_negative(),
              "standard deviation of the model's own error relative to the frequency, added to the measurement's (weights by "
              "covariance)")
      .number("shape_model_error", shape_model_error, "", io::non_negative(),
              "the same for components of shapes, relative to the largest of the shape")
      .rule([this] { return broken_weights(*this); })
      .text("published_values", published_values,
            "file with another updating's result (parameter,unit,final_value), whose cost in this model is told (costs.csv)");
  return table;
}

}  // namespace twindeck::steps
