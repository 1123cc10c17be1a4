#include "steps/diagnosis/config.hpp"

namespace twindeck::steps {

io::FieldTable DiagnosisConfig::fields() {
  io::FieldTable t;
  t.text("catalogue", catalogue, "folder of hypotheses (default: workflows/common/hypotheses)")
      .text("damper_places", damper_places,
            "CSV of places where dampers might stand instead: alternative, damper, x_m, y_m, z_m")
      .text("further_causes", further_causes,
            "folder of causes beside the catalogue: a study's own, or a family at other places")
      .texts("pairs", pairs, "measured and computed modes that belong together where no shape tells, \"7X-8N\"")
      .texts("left_out", rows.left_out, "types of rows that are not used, such as shape_imag, or modes, \"mode:8\"")
      .number("least_mac", least_mac, "", {0.0, 1.0},
              "modes of which the model has none this alike are left out, and reported; 0: none is")
      .boolean("names_alike", rows.names_alike,
               "give a mode one name in all conditions, by likeness of shapes (identifications number each condition from 1)")
      .number("highest_frequency", rows.highest_Hz, "Hz", io::non_negative(), "modes above it are left out; 0: none is")
      .texts("hold_out", hold_out,
             "rows kept from the fit: \"condition\", \"condition/mode\", \"condition/mode/type\" or "
             "\"condition/every_second\", \"none\"; empty: marks, else the rule")
      .number("alpha", alpha, "", {1e-6, 0.5}, "false alarms that the threshold allows")
      .number("residual_alpha", residual_alpha, "", {1e-9, 0.5},
              "level at which the residual test says that something is left, where nothing is named")
      .number("residual_alpha_named", residual_alpha_named, "", {1e-9, 0.5},
              "the same with the named causes in the model; a smaller p makes the name unknown (form off only)")
      .number("either_within", either_within, "", io::positive(), "nats within which two causes are not told apart")
      .number("least_log_odds", least_log_odds, "", io::non_negative(), "log odds below which nothing is named")
      .integer("nulls", nulls, {0, 100000}, "null data sets run for the threshold where none is cached; 0: the analytic tail")
      .integer("most_refined", most_refined, {1, 50}, "entries of a search that are fitted together with all other unknowns")
      .number("refine_within", search.refine_within, "", io::positive(),
              "nats of the best, as weighed before, within which they are")
      .integer("most_causes", most_causes, {0, 8}, "causes put into the model one after another")
      .integer("modes", modes, {4, 200},
               "least number of modes in the reduced basis; it has more where the highest measured frequency asks for them")
      .integer("zones", zones, {2, 10000}, "zones that the elements are gathered in")
      .integer("nodes", nodes, {2, 10000}, "nodes at which masses, oscillators and ties are looked for")
      .number("sensor_tolerance", sensor_tolerance_m, "m", io::positive(),
              "farthest that a sensor may lie from the node that stands for it")
      .choice(
          "form", form, {"on", "off", "one"},
          "on: the model's form may be wrong, its error is estimated and competes with every cause; one: the same by one law "
          "of the residual and one table of verdicts; off: the model is exact but for scatter")
      .boolean(
          "refine_locations", refine_locations,
          "look at the nodes, ties and halves of zones round the leading cause before it is named; takes about three times "
          "as long")
      .choice("stays", stays, {"auto", "as_modelled"},
              "auto: stays that the model has as bars become cables in several elements where that explains measured modes "
              "which the model "
              "resembles nowhere; their forces come from stay_frequency_Hz rows (left_out keeps these from the fit, not from "
              "here), else "
              "from the model; as_modelled: they stay bars")
      .text("threshold_cache", threshold_cache, "folder of thresholds by hash (default: <results>/thresholds, or beside --out)")
      .number("scatter.element_stiffness", scatter.element_stiffness, "", io::non_negative(),
              "relative deviation of an element's stiffness")
      .number("scatter.element_mass", scatter.element_mass, "", io::non_negative(), "of an element's mass")
      .number("scatter.node_mass", scatter.node_mass, "", io::non_negative(), "of the mass at a node of a matrix model")
      .number("scatter.stay_stiffness", scatter.stay_stiffness, "", io::non_negative(), "of a stay's stiffness")
      .number("scatter.stay_pull", scatter.stay_pull, "", io::non_negative(), "of a stay's pull")
      .number("scatter.gain", scatter.gain, "", io::non_negative(), "of a channel's gain")
      .number("scatter.frequency_floor", scatter.frequency_floor, "", io::non_negative(),
              "least relative deviation of a frequency")
      .number("scatter.damping_floor", scatter.damping_floor, "", io::non_negative(),
              "least relative deviation of a damping ratio")
      .number("scatter.shape_floor", scatter.shape_floor, "", io::non_negative(),
              "least deviation of a shape, of its largest value")
      .number("scatter.load_model", scatter.load_model, "", io::non_negative(),
              "of RMS values, for what a simple load model leaves open")
      .boolean("scatter.damping_by_dampers", scatter.damping_by_dampers,
               "structural damping is another unknown where dampers are on (stuck ones rub)")
      .number("scatter.model_form", scatter.model_form, "", io::non_negative(),
              "of a frequency, alike in all conditions of a mode: what a model that is known to be off leaves open");
  return t;
}

bool DiagnosisConfig::with_form(const diagnosis::FeatureSet& features) const {
  return form != "off" && diagnosis::has_rows_of_modes(features);
}

}  // namespace twindeck::steps
