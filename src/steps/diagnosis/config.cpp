#include "steps/diagnosis/config.hpp"

namespace twindeck::steps {

namespace {

/// Keys of earlier versions, and what has taken their place.
struct Retired {
  const char *name, *problem, *mend;
};

constexpr const char* kOneLaw = "is a key of an earlier method of diagnosis: scales and odds are now estimated from the rows";
constexpr const char* kTable = "leave it out: a verdict needs a probability of 95 % (docs/diagnosis.md)";
constexpr Retired retired[] = {
    {"form", "is a key of an earlier choice between methods of diagnosis: there is one method now",
     "leave it out; for a model that is exact, scales of its errors come out near zero"},
    {"alpha", kOneLaw, kTable},
    {"least_log_odds", kOneLaw, kTable},
    {"either_within", kOneLaw, kTable},
    {"residual_alpha", kOneLaw, kTable},
    {"residual_alpha_named", kOneLaw, kTable},
    {"nulls", "ran null data sets for a threshold that is no longer used", kTable},
    {"threshold_cache", "kept thresholds that are no longer used", kTable},
    {"most_refined", "set how an earlier search went on", "leave it out: the leading entries of every family are fitted"},
    {"refine_within", "set how an earlier search went on", "leave it out: the leading entries of every family are fitted"},
    {"refine_locations", "looked for places between those of the catalogue, which is no longer done",
     "raise nodes and zones instead, for more places"},
};

}  // namespace

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
      .integer("most_causes", most_causes, {0, 3},
               "causes that may act together in one explanation; 0: what is found is told and not put into the model")
      .integer("modes", modes, {4, 200},
               "least number of modes in the reduced basis; it has more where the highest measured frequency asks for them")
      .integer("zones", zones, {2, 10000}, "zones that the elements are gathered in")
      .integer("nodes", nodes, {2, 10000}, "nodes at which masses, oscillators and ties are looked for")
      .number("sensor_tolerance", sensor_tolerance_m, "m", io::positive(),
              "farthest that a sensor may lie from the node that stands for it")
      .choice("stays", stays, {"auto", "as_modelled"},
              "auto: stays that the model has as bars become cables in several elements where that explains measured modes "
              "which the model "
              "resembles nowhere; their forces come from stay_frequency_Hz rows (left_out keeps these from the fit, not from "
              "here), else "
              "from the model; as_modelled: they stay bars")
      .number("scatter.element_stiffness", scatter.element_stiffness, "", io::non_negative(),
              "relative deviation of an element's stiffness")
      .number("scatter.element_mass", scatter.element_mass, "", io::non_negative(), "of an element's mass")
      .number("scatter.node_mass", scatter.node_mass, "", io::non_negative(), "of the mass at a node of a matrix model")
      .number("scatter.stay_stiffness", scatter.stay_stiffness, "", io::non_negative(), "of a stay's stiffness")
      .number("scatter.stay_pull", scatter.stay_pull, "", io::non_negative(), "of a stay's pull")
      .number("scatter.support_stiffness", scatter.support_stiffness, "", io::non_negative(),
              "of the stiffness of each bearing and foundation")
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
  for (const Retired& key : retired) t.retired(key.name, key.problem, key.mend);
  return t;
}

}  // namespace twindeck::steps
