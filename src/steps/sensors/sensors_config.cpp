#include "steps/sensors/sensors_config.hpp"

#include "io/limits.hpp"
#include "steps/shared/order_range.hpp"

namespace twindeck::steps {

io::FieldTable SensorsConfig::fields() {
  io::FieldTable table;
  table.text("points", points, "points that sensors may stand on: point,line,s_m,x_m,y_m,z_m,rx,ry,rz", true)
      .text("setups", setups, "setups: setup,family,channel,point,direction", true)
      .integer("n_modes", n_modes, {2.0, 200.0}, "modes that are to be told apart")
      .integer("channels", channels, {2.0, 1000.0}, "sensors of the setups that are drawn and searched for")
      .integer("draws", draws, {1.0, 1e6}, "candidates drawn of each family")
      .integer("free_setups", free_setups, {0.0, 100.0}, "how many of the freely drawn setups are kept as DC1, DC2, …")
      .number("sensor_tolerance", tolerance_m, "m", io::positive(),
              "largest distance of a point from the model's node that stands for it")
      .texts("blind.setups", blind_setups, "setups that the blind test is made with; none: no blind test")
      .number("blind.duration", duration_s, "s", {0.0, io::longest_record_s, true}, "length of the signals")
      .number("blind.rate", rate_Hz, "Hz", {0.0, io::highest_rate_Hz, true}, "steps of the trapezoidal rule a second")
      .number("blind.damping", damping_ratio, "", {0.0, 0.2, true}, "of every mode")
      .number("blind.warm_up", warm_up_s, "s", {0.0, io::longest_record_s}, "left out before the signals")
      .integer("blind.downsample", downsample, {1.0, 1000.0}, "every so many-th sample is kept, after a low-pass")
      .integer("blind.frames", frames, {1.0, 900.0}, "frames that are identified one by one")
      .integer("blind.minimum_order", minimum_order, {2.0, 500.0}, "smallest model order")
      .integer("blind.maximum_order", maximum_order, {2.0, 500.0}, "largest model order")
      .integer("blind.order_step", order_step, {1.0, 100.0}, "step of the order")
      .integer("blind.block_rows", block_rows, {2.0, 500.0}, "block rows of the Toeplitz matrix")
      .integer("blind.welch_segment", welch_segment, {8.0, 1e7}, "samples of a Welch segment, after downsampling")
      .number("stable.frequency", criteria.frequency, "", io::positive(), "relative change of a stable frequency")
      .number("stable.damping", criteria.damping, "", io::positive(), "change of a stable damping ratio")
      .number("stable.mac", criteria.mac, "", {0.0, 1.0}, "MAC of a stable shape")
      .number("cleaning.mac", cleaning.mac, "", {0.0, 1.0}, "Eq. (3)")
      .number("cleaning.frequency", cleaning.frequency, "", io::positive(),
              "relative distance of frequencies that may count as the same")
      .number("cleaning.recursion", cleaning.recursion, "", io::non_negative(),
              "Eq. (4): index of recursion that a mode exceeds")
      .rule([this] { return orders_exchanged("blind.", minimum_order, maximum_order); });
  return table;
}

}  // namespace twindeck::steps
