#include "steps/measured/measured_choice.hpp"

#include "core/error.hpp"

namespace twindeck::steps {

std::vector<Flag> measured_flags() {
  return {{"condition", true, "condition of the measurement to look at: a table of conditions.toml"},
          {"state", true, "state of the structure to look at: the key `state` in conditions.toml (missing there: reference)"},
          {"correct", true,
           "file of corrections of single channels, as s9_diagnosis writes it (corrections.toml), made before anything else"}};
}

MeasuredChoice asked_choice(StepContext& context, const std::string& condition) {
  MeasuredChoice choice;
  const auto name = [&](const char* flag) {
    const std::optional<std::string> given = context.flag(flag);
    if (given && given->empty())
      throw InputError({"command line", 0, std::string("--") + flag}, "is empty", "give a name, or leave the option out");
    return given.value_or("");
  };
  choice.conditions = {name("condition"), name("state")};
  if (choice.conditions.condition.empty() && choice.conditions.state.empty()) choice.conditions.condition = condition;
  choice.corrections = asked_corrections(context);
  return choice;
}

}  // namespace twindeck::steps
