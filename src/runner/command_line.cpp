#include "runner/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>
#include <map>

#include "core/build_info.hpp"
#include "core/letters.hpp"
#include "io/atomic.hpp"
#include "model_io/ansys.hpp"
#include "model_io/nastran.hpp"
#include "model_io/sap2000.hpp"

namespace twindeck::runner {

namespace {

namespace fs = std::filesystem;

std::string bare(const std::string& flag) { return flag.substr(std::min(flag.find_first_not_of('-'), flag.size())); }

std::string help_footer(const Step& step) {
  std::string footer = "Examples:\n";
  for (const std::string& example : step.examples) footer += "  " + example + "\n";
  footer += "  " + step.examples.front() + " --check\n";
  footer += "\nExit codes: 0 done; 1 not converged (see <out>.unconverged/); 2 bad input; 3 a mistake of the program.";
  return footer;
}

/// An option that is not known: names it and the nearest one.
[[noreturn]] void refuse(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  const std::string option = word.substr(0, word.find('='));
  if (option.starts_with("-")) {
    const std::string nearest = nearest_name(option, known);
    throw InputError({"command line", 0, ""}, "unknown option '" + option + "'",
                     nearest.empty() ? "--help lists the options" : "did you mean '" + nearest + "'?");
  }
  throw InputError({"command line", 0, ""}, "has '" + word + "', which belongs to no option", "--help shows two examples");
}

/// What is wrong with the text of a seed; "" if nothing is. CLI11 takes a number that 64 bits do not hold for the largest that
/// they do.
std::string problem_of_seed(const std::string& text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= 0) return "";
  return fmt::format("is '{}', expected a whole number from 0 to {}", text, std::numeric_limits<std::int64_t>::max());
}

void check_folder(const char* option, const std::optional<fs::path>& folder) {
  if (!folder || fs::is_directory(*folder)) return;
  const std::string wanted = std::string(option) == "--model" ? "a model folder or a deck" : "a folder";
  throw InputError({"command line", 0, option},
                   "'" + folder->string() + (fs::exists(*folder) ? "' is not " + wanted : "' does not exist"),
                   "name " + wanted + " that exists");
}

/// Step 3 takes a universal file with modes and makes the folder of it that the others take.
void check_modes(const Step& step, const std::optional<fs::path>& modes) {
  const bool is_file = modes && fs::is_regular_file(*modes);
  if (is_file && step.token == "s3_identification") return;
  if (is_file)
    throw InputError({"command line", 0, "--modes"}, "'" + modes->string() + "' is a file, expected a folder with modes.csv",
                     "make one of a universal file: s3_identification --modes FILE --out DIR --set imported_std_pct=0.5");
  check_folder("--modes", modes);
}

/// What the options are written into while the command line is parsed.
struct Words {
  std::string study, out, results, model, campaign, modes, features, key;
  std::int64_t seed = 0;
  bool version_asked = false, print_config = false;
  std::map<std::string, std::string> values;  ///< of the step's own options that take one
  std::map<std::string, bool> switches;
  CLI::Option *seed_option = nullptr, *describe = nullptr;
};

/// Binds every step's options.
void add_common_options(CLI::App& app, CommandLine& line, Words& words) {
  app.set_help_flag("-h,--help", "print this and end");
  app.add_option("--study", words.study, "folder of the study: study.toml and the step's own configuration")->type_name("DIR");
  app.add_option("--out", words.out,
                 "folder to write; earlier results of this step in it are replaced when the step has finished")
      ->type_name("DIR");
  app.add_option("--results", words.results,
                 "root that results of earlier steps are read from (default: the folder above --out)")
      ->type_name("DIR");
  app.add_option("--model", words.model, "model folder, or .inp, Nastran, ANSYS or SAP2000 file, to use instead of the study's")
      ->type_name("DIR");
  app.add_option("--campaign", words.campaign, "campaign folder (raw records) to use instead of the study's")->type_name("DIR");
  app.add_option("--modes", words.modes,
                 "folder with measured modes.csv to use instead of the study's; step 3: a universal file of modes")
      ->type_name("PATH");
  app.add_option("--features", words.features, "features folder to use instead of the study's")->type_name("DIR");
  app.add_option("--set", line.sets, "change a key of the configuration; --describe tells which there are")
      ->type_name("KEY=VALUE");
  words.seed_option = app.add_option("--seed", words.seed, "seed of everything random, 0 or more (default: the study's)")
                          ->type_name("N")
                          ->check(CLI::Validator(problem_of_seed, ""));
  app.add_option("--threads", line.threads, "threads to use (default: all); results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  app.add_flag("--accept-unconverged", line.accept_unconverged, "publish results that did not converge, marked as such");
  app.add_flag("--quiet", line.quiet, "print errors only");
  app.add_flag("--check", line.check,
               "read and validate all inputs, tell what would run and how long it took last time, and end: nothing is computed "
               "or written");
  app.add_flag("--print-config", words.print_config, "print the resolved configuration as TOML and end");
  words.describe = app.add_option("--describe", words.key,
                                  "print meaning, unit, range and default of one key, of all (without KEY, or all), or of "
                                  "study.toml or model.toml, and end")
                       ->type_name("KEY")
                       ->expected(0, 1);
  app.add_flag("--version", words.version_asked, "print the version and end");
}

/// Binds the step's own options.
void add_step_options(CLI::App& app, const Step& step, Words& words) {
  for (const Flag& flag : step.flags) {
    const std::string name = bare(flag.name);
    if (flag.takes_value)
      app.add_option("--" + name, words.values[name], flag.meaning)->type_name("VALUE");
    else
      app.add_flag("--" + name, words.switches[name], flag.meaning);
  }
}

std::optional<fs::path> optional_path(const std::string& text) {
  return text.empty() ? std::optional<fs::path>() : fs::path(text);
}

/// Takes over what was given.
void take(const CLI::App& app, const Words& words, CommandLine& line) {
  line.study = io::without_trailing_slash(words.study);
  line.out = words.out;
  line.results = words.results;
  line.model = optional_path(words.model);
  line.campaign = optional_path(words.campaign);
  line.modes = optional_path(words.modes);
  line.features = optional_path(words.features);
  if (words.seed_option->count() > 0) line.seed = static_cast<std::uint64_t>(words.seed);
  for (const auto& [name, value] : words.values)
    if (app.count("--" + name) > 0) line.flags.emplace_back(name, value);
  for (const auto& [name, on] : words.switches)
    if (on) line.flags.emplace_back(name, "");
}

/// Whether the line asks for something that is printed instead of running the step: sets action and text.
bool asks_for_print(const CLI::App& app, const Step& step, const Words& words, CommandLine& line) {
  if (words.version_asked) {
    line.action = CommandLine::Action::version;
    line.text = step.token + " (twindeck) " + version();
    return true;
  }
  for (const Flag& flag : step.flags) {
    const std::string name = bare(flag.name);
    if (!flag.instead || app.count("--" + name) == 0) continue;
    line.action = CommandLine::Action::print;
    for (const std::string& printed : flag.instead(flag.takes_value ? words.values.at(name) : "")) line.text += printed + "\n";
    return true;
  }
  check_folder("--study", optional_path(words.study));
  if (words.describe->count() > 0) {
    line.action = CommandLine::Action::describe;
    line.text = words.key;
    return true;
  }
  if (words.print_config) line.action = CommandLine::Action::print_config;
  return words.print_config;
}

}  // namespace

CommandLine parse_command_line(int argc, char** argv, const Step& step) {
  CommandLine line;
  Words words;
  CLI::App app{step.token + ": " + step.summary, step.token};
  app.footer(help_footer(step));
  app.allow_extras();
  add_common_options(app, line, words);
  add_step_options(app, step, words);

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    line.action = CommandLine::Action::help;
    line.text = app.help();
    return line;
  } catch (const CLI::ParseError& error) {
    throw InputError({"command line", 0, ""}, error.what(), "--help lists the options");
  }
  if (const auto extras = app.remaining(); !extras.empty()) refuse(app, extras.front());

  take(app, words, line);
  if (asks_for_print(app, step, words, line)) return line;
  if (line.out.empty())
    throw InputError({"command line", 0, "--out"}, "is missing",
                     "name the folder to write, for example --out results/x/" + step.token);
  if (!line.model || !fs::is_regular_file(*line.model) ||
      (lower_case(line.model->extension().string()) != ".inp" && !model_io::is_sap2000_file(*line.model) &&
       !model_io::is_nastran_file(*line.model) && !model_io::is_ansys_deck(*line.model)))
    check_folder("--model", line.model);
  check_folder("--campaign", line.campaign);
  check_modes(step, line.modes);
  check_folder("--features", line.features);
  return line;
}

ConfiguredInputs::ConfiguredInputs(Step& step) {
  for (const std::string& name : step.configured_inputs) {
    const bool is_model = name == "model";
    TWINDECK_ASSERT(is_model || name == "campaign");
    step.fields.text(name, is_model ? model_ : campaign_,
                     std::string(is_model ? "model folder (or .inp file)" : "campaign folder (raw records)") +
                         " to work on, unless --" + name + " names another; {results} stands for the folder of --results");
  }
}

void ConfiguredInputs::apply(const Step& step, StepContext& context) const {
  const auto set = [&](const char* name, const std::string& configured, std::optional<fs::path>& folder) {
    if (folder || configured.empty()) return;
    const fs::path path = context.resolved(configured);
    if (!fs::exists(path))
      throw InputError(step.fields.place_of(name).value_or(Place{"", 0, name}),
                       "is '" + path.string() + "', which is not there",
                       std::string("run the step or the script that writes it, or give --") + name + " DIR");
    folder = path;
  };
  set("model", model_, context.model);
  set("campaign", campaign_, context.campaign);
}

}  // namespace twindeck::runner
