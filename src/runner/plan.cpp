#include "runner/plan.hpp"

#include <fmt/format.h>

#include <map>

#include "core/printable.hpp"
#include "io/manifest.hpp"

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

}  // namespace

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

}  // namespace twindeck::runner
