#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace twindeck::broken {

/// How a run of a step ended.
struct Outcome {
  int exit = -1;      ///< exit code; -1 where the run has none
  std::string crash;  ///< signal that ended it, or that it did not end in time; empty: it ended by itself
  std::string stdout_text, stderr_text;
};

/// What is run.
struct Job {
  std::string step;                    ///< "s1_model"
  std::vector<std::string> arguments;  ///< of the command line, without the program's name
  std::filesystem::path folder;        ///< working folder of the run
};

/// Runs steps one after another inside one process, which is a child of the test: it is started once and stays for all jobs,
/// unless a job ends it (a crash, no end within `seconds`), which the outcome tells; then the next job starts another. It may
/// take at most some gigabytes of memory, so that a size of a broken header ends as an error instead of filling the machine.
class Worker {
 public:
  explicit Worker(double seconds);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  [[nodiscard]] Outcome run(const Job& job);
  /// Seconds of processor that all its processes took so far.
  [[nodiscard]] static double processor_seconds();

 private:
  void start();
  void stop();
  double seconds_;
  std::filesystem::path scratch_;  ///< stdout and stderr of the job
  int pid_ = -1, jobs_ = -1, results_ = -1;
};

/// The same as a program of its own: `bin`/step.
[[nodiscard]] Outcome run_program(const std::filesystem::path& bin, const Job& job, double seconds);

}  // namespace twindeck::broken
