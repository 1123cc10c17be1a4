#include "steps/identification/imported_modes.hpp"

#include "core/error.hpp"
#include "model_io/modes_io.hpp"
#include "records/universal_modes.hpp"

namespace twindeck::steps {

std::optional<runner::Computation> imported_modes(double std_pct, runner::StepContext& context) {
  if (!context.modes) return std::nullopt;
  if (std::filesystem::is_directory(*context.modes)) {
    throw InputError({context.modes->string(), 0, ""}, "is a folder, expected a universal file with modes",
                     "give the folder to the step that compares with it: s4_refinement --modes DIR");
  }
  records::UniversalModes read = records::read_universal_modes(context.record(*context.modes), std_pct);
  for (const std::string& note : read.notes) context.say(context.modes->string() + ": " + note);
  if (std_pct == 0.0) {
    context.warn(context.modes->string() +
                 ": has no standard deviations, and steps 4, 6 and 9 refuse modes without them; state what you assume, for "
                 "example --set imported_std_pct=0.5");
  }
  return [read = std::move(read), &context]() -> Status {
    model_io::write_modes(read.modes, context.out);
    records::write_channels(read.channels, context.out / "channels.csv");
    return {};
  };
}

}  // namespace twindeck::steps
