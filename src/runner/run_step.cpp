#include "runner/run_step.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <limits>
#include <new>
#include <string_view>
#include <system_error>

#include "core/build_info.hpp"
#include "core/printable.hpp"
#include "io/atomic.hpp"
#include "io/manifest.hpp"
#include "model_io/model_toml.hpp"
#include "runner/clean_interrupt.hpp"
#include "runner/command_line.hpp"
#include "runner/heartbeat.hpp"
#include "runner/shipped_files.hpp"
#include "runner/study.hpp"
#include "runner/threads.hpp"

namespace twindeck::runner {

namespace fs = std::filesystem;
namespace {

/// A line a folder; a file that is the only one of its folder is named.
std::string reads(const StepContext& context) {
  struct Files {
    std::string only;
    std::size_t count = 0;
    std::uintmax_t bytes = 0;
  };
  std::map<std::string, Files> folders;
  for (const auto& [file, hash] : context.input_hashes_) {
    Files& files = folders[fs::path(file).parent_path().generic_string()];
    files.only = file;
    files.bytes += fs::file_size(file);
    ++files.count;
  }
  constexpr double kilobyte = 1000.0;
  std::string text;
  for (const auto& [folder, files] : folders)
    text +=
        fmt::format("  reads {}: {:.1f} kB\n",
                    files.count == 1 ? printable(files.only) : fmt::format("{} files of {}", files.count, printable(folder)),
                    static_cast<double>(files.bytes) / kilobyte);
  return text;
}

/// What --check prints of a step whose inputs are valid: what would run, how many files of which folder it reads, where it
/// would write, and how long the earlier run took whose results lie there. Several lines, each ended.
/// @param out  folder to write
std::string plan_of(const Step& step, const StepContext& context, const fs::path& out) {
  std::string writes = "would write: " + printable(out.generic_string()), takes = "not known: there is no earlier run";
  if (io::is_step_folder(out)) {
    const io::Manifest earlier = io::read_manifest(out);
    writes += ", in place of the results there";
    takes = fmt::format("about {:.1f} s, as the earlier run{} did", earlier.seconds,
                        earlier.config_toml == step.fields.print() ? "" : " of another configuration");
  }
  return fmt::format("{}: inputs are valid; nothing was computed or written\n  would run: {}\n{}  {}\n  takes: {}\n",
                     step.token, step.summary, reads(context), writes, takes);
}

/// One line whatever was thrown.
int failure(const std::string& token, const std::string& kind, const std::string& message, int code) {
  std::fputs(fmt::format("{}: {}{}\n", token, kind, printable(message)).c_str(), stderr);
  return code;
}

/// Prints what was asked for. @throws InputError  where it cannot be written (a full disk, a reader that has gone)
void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return;
  throw InputError({"standard output", 0, ""}, "cannot be written: " + std::generic_category().message(errno),
                   "make room, or print to another place");
}

/// Writing beyond a limit of the system (ulimit -f), or to a reader that has gone, fails as any writing does.
void let_writing_fail() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

/// Makes the C library keep freed memory for the next allocation. By default it returns large blocks to the system at once. A
/// step with many time histories of some megabytes then spends a third of its time on new pages. Does nothing if the C library
/// is not glibc.
void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int gigabyte = 1 << 30, megabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, gigabyte);  // below it no block is mapped by itself, which freeing would undo
  mallopt(M_TRIM_THRESHOLD, gigabyte);  // so much may lie free
  mallopt(M_TOP_PAD, 64 * megabyte);    // a thread's heap grows, and stays, by so much
#endif
}

/// What a size in a file or the configuration asks for that no machine has.
InputError too_large() {
  return {{}, "asks for more memory than there is", "look for a size, a duration or a number of modes that is too large"};
}

/// The step's configuration: its own file in the study, then --set in order.
void read_configuration(const CommandLine& line, Step& step, StepContext& context) {
  if (!line.study.empty()) {
    if (const fs::path study_file = line.study / "study.toml"; fs::exists(study_file)) {
      context.seed = read_study(line.study).seed;
      context.input(study_file);
    }
    if (const fs::path own = line.study / (step.token + ".toml"); fs::exists(own)) step.fields.load(context.input(own));
  }
  for (const std::string& assignment : line.sets) step.fields.set(assignment);
  if (line.seed) context.seed = *line.seed;
}

/// Only a folder of this very step, or an empty one, may be replaced: --out set to something else must not cost anybody's
/// files.
void refuse_to_replace_foreign(const fs::path& folder, const std::string& token) {
  if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder))) return;
  if (!fs::is_directory(folder) || !io::is_step_folder(folder))
    throw InputError({"command line", 0, "--out"}, "'" + folder.string() + "' exists and holds no results of a step",
                     "name another folder, or remove this one yourself");
  if (const std::string owner = io::read_manifest(folder).step; owner != token)
    throw InputError({"command line", 0, "--out"}, "'" + folder.string() + "' holds results of " + owner,
                     "name another folder");
}

/// The nearest folder above the results that exists must take them: said before a long computation, and by --check.
void refuse_unmakeable(const fs::path& folder) {
  std::error_code unreadable;
  fs::path above = fs::absolute(folder).parent_path();
  while (!fs::exists(above, unreadable) && above.has_relative_path()) above = above.parent_path();
  if (fs::is_directory(above, unreadable) && ::access(above.c_str(), W_OK | X_OK) == 0) return;
  throw InputError({"command line", 0, "--out"}, fmt::format("'{}' cannot be made in '{}'", folder.string(), above.string()),
                   "name a place in a folder that you may write to");
}

fs::path unconverged_place(fs::path out) { return out += ".unconverged"; }

std::map<std::string, std::string> hashes_below(const fs::path& folder) {
  std::map<std::string, std::string> hashes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) hashes[fs::relative(entry.path(), folder).generic_string()] = io::sha256(entry.path());
  return hashes;
}

io::Manifest manifest_of(const Status& status, const Step& step, const StepContext& context) {
  io::Manifest manifest;
  manifest.step = step.token;
  manifest.status = status.converged ? "converged" : "unconverged";
  manifest.message = status.message;
  manifest.config_toml = step.fields.print();
  manifest.seed = context.seed;
  manifest.threads = context.threads;
  for (const auto& [path, hash] : context.input_hashes_) manifest.inputs[path] = hash;
  manifest.outputs = hashes_below(context.out);
  manifest.warnings = context.warnings_;
  manifest.notes = context.notes_;
  manifest.corrections = context.corrections_;
  return manifest;
}

/// A key of the step's configuration, or all of them ("" or "all"); or all of one of the files that are no step's own.
std::string describe(const Step& step, const std::string& key) {
  if (key == "study.toml") return describe_study();
  if (key == "model.toml") return model_io::describe_model_toml();
  return step.fields.describe(key == "all" ? "" : key);
}

/// What the file system does not allow, with what helps.
InputError in_words(const fs::filesystem_error& error) {
  struct Refusal {
    std::errc code;
    const char *problem, *mend;
  };
  constexpr Refusal known[] = {
      {std::errc::too_many_symbolic_link_levels, "is a link that leads back to itself",
       "let it point to the file or folder that is meant"},
      {std::errc::filename_too_long, "is a name that is too long for the file system", "choose a shorter one"},
      {std::errc::too_many_files_open, "cannot be opened: this shell allows too few open files",
       "raise the limit: ulimit -n 256"},
      {std::errc::permission_denied, "may not be read or written", "check your permissions"},
  };
  constexpr std::size_t longest_name = 200;  // letters: of a name that is too long messages say no more
  const std::string name = error.path1().string().substr(0, longest_name);
  for (const Refusal& refusal : known)
    if (error.code() == refusal.code) return InputError({name, 0, ""}, refusal.problem, refusal.mend);
  return InputError({name, 0, ""}, error.code().message(), "check the path, and what the machine allows");
}

/// The line of an InputError that names no file: a key of the configuration stands where it was given, anything else concerns
/// the study or the model that the step was run on.
std::string located(const InputError& error, const Step& step, const StepContext& context) {
  if (!error.place().file.empty()) return error.what();
  const std::optional<Place> given = error.place().key.empty() ? std::nullopt : step.fields.place_of(error.place().key);
  if (given && !given->file.empty())
    return given->file + (given->line > 0 ? ":" + std::to_string(given->line) : "") + ": " + error.what();
  // A default is no word of the command line: what was read is named.
  for (const std::optional<fs::path>& read : {context.model, context.campaign, context.features, context.modes})
    if (read && context.study.empty()) return read->string() + ": " + error.what();
  const std::string source = context.model ? context.model->string() : context.study.string();
  return (source.empty() ? "command line" : source) + ": " + error.what();
}

/// The file itself, or all files of a folder in order.
std::vector<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    // A manifest tells seconds and dates of another step; what counts is the files that it vouches for.
    if (entry.is_regular_file() && entry.path().filename() != "manifest.json") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Tables and configurations are read whole, and decks, which are no part of a folder; matrices are read entry by entry.
bool is_read_whole(const fs::path& file, const fs::path& asked) {
  const std::string ending = file.extension().string();
  if (file == asked) return ending != ".mtx" && ending != ".op4" && ending != ".npy";
  return ending == ".csv" || ending == ".toml" || ending == ".xlsx";
}

int compute(int argc, char** argv, const CommandLine& line, Step& step, const ConfiguredInputs& configured,
            StepContext& context) {
  const auto start = std::chrono::steady_clock::now();
  const fs::path out = io::without_trailing_slash(line.out);
  const fs::path unconverged = unconverged_place(out);

  // 1. Everything that can be refused is refused before anything is written.
  read_configuration(line, step, context);
  step.fields.require();
  refuse_to_replace_foreign(out, step.token);
  refuse_to_replace_foreign(unconverged, step.token);
  refuse_unmakeable(out);
  context.study = line.study;
  context.results = line.results.empty() ? (out.has_parent_path() ? out.parent_path() : fs::path(".")) : line.results;
  context.model = line.model;
  context.campaign = line.campaign;
  context.modes = line.modes;
  context.features = line.features;
  context.flags_ = line.flags;
  configured.apply(step, context);
  context.threads = set_threads(line.threads);
  keep_freed_memory();
  const CleanInterrupt interrupt(io::FolderReplacement::partial_place(out));  // first, so that no moment is uncovered
  const Computation computation = step.read(context);
  if (line.check) {
    if (!line.quiet) print(plan_of(step, context, out));
    return 0;
  }

  // 2. The step computes and writes beside its place.
  io::FolderReplacement replacement(out);
  context.out = replacement.partial();
  const Status status = [&] {
    const Heartbeat heartbeat(context);
    return computation();
  }();

  // 3. The manifest comes last.
  io::Manifest manifest = manifest_of(status, step, context);
  manifest.command_line.assign(argv, argv + argc);
  manifest.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  io::write_manifest(manifest, context.out);

  // 4. What is finished replaces what was there; what did not converge goes beside it.
  if (!status.converged && !line.accept_unconverged) {
    replacement.publish(unconverged);
    return failure(step.token, "not converged: ",
                   status.message + "; see " + unconverged.string() + ", or publish it with --accept-unconverged", 1);
  }
  replacement.publish();
  std::error_code ignored;
  fs::remove_all(unconverged, ignored);  // of an earlier attempt, now overtaken
  if (!context.corrections_.empty())
    context.say(fmt::format("the measurement was corrected first: {}", fmt::join(context.corrections_, ", ")));
  context.say(fmt::format("{} in {:.1f} s, written to {}", status.converged ? "done" : "accepted though not converged",
                          manifest.seconds, out.string()));
  return 0;
}

}  // namespace

std::optional<std::string> StepContext::flag(const std::string& name) const {
  const std::string wanted = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  for (const auto& [given, value] : flags_)
    if (given == wanted) return value;
  return std::nullopt;
}

fs::path StepContext::resolved(const std::string& path) const {
  constexpr std::string_view below_results = "{results}/";
  return path.starts_with(below_results) ? results / path.substr(below_results.size()) : fs::path(path);
}

bool StepContext::has_flag(const std::string& name) const { return flag(name).has_value(); }

fs::path StepContext::input(const fs::path& asked, std::uintmax_t most_bytes) {
  const fs::path path = shipped(asked);
  if (!fs::exists(path))
    throw InputError({path.string(), 0, ""}, "does not exist",
                     "run the step that writes it, or point to your own data (--help)");
  const std::vector<fs::path> files = files_of(path);
  for (const fs::path& file : files)
    if (is_read_whole(file, path)) io::refuse_longer(file, most_bytes);
  io::check_against_manifest(path);
  for (const fs::path& file : files) input_hashes_.emplace(file.generic_string(), io::sha256(file));
  return path;
}

fs::path StepContext::record(const fs::path& path) { return input(path, std::numeric_limits<std::uintmax_t>::max()); }

int run_step(int argc, char** argv, Step step) {
  let_writing_fail();
  StepContext context;
  context.token_ = step.token;
  try {
    const ConfiguredInputs configured(step);
    const CommandLine line = parse_command_line(argc, argv, step);
    context.quiet = line.quiet;
    switch (line.action) {
      case CommandLine::Action::help:
      case CommandLine::Action::print:
        print(line.text);
        return 0;
      case CommandLine::Action::version:
        print(line.text + "\n");
        return 0;
      case CommandLine::Action::describe:
        print(describe(step, line.text));
        return 0;
      case CommandLine::Action::print_config:
        read_configuration(line, step, context);
        print(step.fields.print());
        return 0;
      case CommandLine::Action::run:
        return compute(argc, argv, line, step, configured, context);
    }
    throw InternalError("the command line asks for nothing known");
  } catch (const InputError& error) {
    return failure(step.token, "", located(error, step, context), 2);
  } catch (const fs::filesystem_error& error) {
    return failure(step.token, "", located(in_words(error), step, context), 2);
  } catch (const std::system_error& error) {  // of the file system too: what the machine or its limits do not allow
    return failure(step.token, "", error.what(), 2);
  } catch (const std::bad_alloc&) {
    return failure(step.token, "", located(too_large(), step, context), 2);
  } catch (const std::length_error&) {
    return failure(step.token, "", located(too_large(), step, context), 2);
  } catch (const std::exception& error) {
    return failure(step.token, "internal error: ", error.what(), 3);
  } catch (...) {
    return failure(step.token, "internal error: ", "something unknown was thrown", 3);
  }
}

}  // namespace twindeck::runner
