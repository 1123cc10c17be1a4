#include "broken_inputs/worker.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <thread>

// The steps' entry functions: each main, renamed where it is compiled for this test (tests/CMakeLists.txt).
int s0_campaign_main(int argc, char** argv);
int s1_model_main(int argc, char** argv);
int s2_sensors_main(int argc, char** argv);
int s3_identification_main(int argc, char** argv);
int s4_refinement_main(int argc, char** argv);
int s5_sensitivity_main(int argc, char** argv);
int s6_updating_main(int argc, char** argv);
int s7_aerodynamics_main(int argc, char** argv);
int s8_validation_main(int argc, char** argv);
int s9_diagnosis_main(int argc, char** argv);
int s10_reliability_main(int argc, char** argv);

namespace twindeck::broken {
namespace {

namespace fs = std::filesystem;

/// [bytes] address space of the worker: enough for every sound case many times over, too little for a size out of a broken
/// header. Sanitizers reserve terabytes of addresses, so that they run without it.
constexpr rlim_t kMostMemory = rlim_t{6} << 30U;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

using Entry = int (*)(int, char**);

Entry entry_of(const std::string& step) {
  static const std::map<std::string, Entry> entries = {
      {"s0_campaign", s0_campaign_main},        {"s1_model", s1_model_main},
      {"s2_sensors", s2_sensors_main},          {"s3_identification", s3_identification_main},
      {"s4_refinement", s4_refinement_main},    {"s5_sensitivity", s5_sensitivity_main},
      {"s6_updating", s6_updating_main},        {"s7_aerodynamics", s7_aerodynamics_main},
      {"s8_validation", s8_validation_main},    {"s9_diagnosis", s9_diagnosis_main},
      {"s10_reliability", s10_reliability_main}};
  const auto found = entries.find(step);
  if (found == entries.end()) throw std::runtime_error("there is no step " + step);
  return found->second;
}

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Lets this process write into files instead of the test's output.
void redirect(const fs::path& scratch) {
  for (const auto& [name, number] : {std::pair<const char*, int>{"stdout", STDOUT_FILENO}, {"stderr", STDERR_FILENO}}) {
    const int file = ::open((scratch / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || ::dup2(file, number) < 0) ::_exit(120);
    ::close(file);
  }
}

void limit_memory() {
  if (kSanitized) return;
  const rlimit limit{kMostMemory, kMostMemory};
  ::setrlimit(RLIMIT_AS, &limit);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

int run_here(const Job& job, const fs::path& scratch) {
  redirect(scratch);
  if (::chdir(job.folder.c_str()) != 0) return 121;
  std::vector<std::string> words = job.arguments;
  words.insert(words.begin(), job.step);
  std::vector<char*> argv = pointers(words);
  const int code = entry_of(job.step)(static_cast<int>(words.size()), argv.data());
  std::fflush(stdout);
  std::fflush(stderr);
  return code;
}

// A job as bytes: words of the command line after step and folder, each ended by NUL, after the number of bytes.
std::string packed(const Job& job) {
  std::string text = job.step + '\0' + job.folder.string() + '\0';
  for (const std::string& word : job.arguments) text += word + '\0';
  return text;
}

Job unpacked(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size(); at += words.back().size() + 1) words.emplace_back(text.c_str() + at);
  return {words.at(0), {words.begin() + 2, words.end()}, words.at(1)};
}

bool read_all(int file, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = ::read(file, at, size);
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

[[noreturn]] void serve(int jobs, int results, const fs::path& scratch) {
  limit_memory();
  while (true) {
    std::size_t size = 0;
    if (!read_all(jobs, &size, sizeof size)) ::_exit(0);
    std::string text(size, '\0');
    if (!read_all(jobs, text.data(), size)) ::_exit(0);
    const int code = run_here(unpacked(text), scratch);
    if (::write(results, &code, sizeof code) != sizeof code) ::_exit(122);
  }
}

/// Why a process ended; waits for it.
std::string end_of(int pid, int& exit) {
  int status = 0;
  ::waitpid(pid, &status, 0);
  if (WIFEXITED(status)) {
    exit = WEXITSTATUS(status);
    return "";
  }
  return std::string("ended by signal ") + ::strsignal(WTERMSIG(status));
}

}  // namespace

Worker::Worker(double seconds) : seconds_(seconds) {
  std::string name = (fs::temp_directory_path() / "twindeck_worker_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
  scratch_ = name;
}

Worker::~Worker() {
  stop();
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
}

void Worker::start() {
  int jobs[2], results[2];
  if (::pipe2(jobs, O_CLOEXEC) != 0 || ::pipe2(results, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
  std::fflush(nullptr);
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("no process can be started");
  if (pid_ == 0) {
    ::close(jobs[1]);
    ::close(results[0]);
    serve(jobs[0], results[1], scratch_);
  }
  ::close(jobs[0]);
  ::close(results[1]);
  jobs_ = jobs[1];
  results_ = results[0];
}

void Worker::stop() {
  if (pid_ < 0) return;
  ::close(jobs_);
  ::close(results_);
  int ignored = 0;
  static_cast<void>(end_of(pid_, ignored));
  pid_ = -1;
}

Outcome Worker::run(const Job& job) {
  static_cast<void>(entry_of(job.step));
  if (pid_ < 0) start();
  ::signal(SIGPIPE, SIG_IGN);
  const std::string text = packed(job);
  const std::size_t size = text.size();
  Outcome outcome;
  if (::write(jobs_, &size, sizeof size) != sizeof size || ::write(jobs_, text.data(), size) != static_cast<ssize_t>(size))
    throw std::runtime_error("the worker takes no job");
  pollfd waiting{results_, POLLIN, 0};
  const int ready = ::poll(&waiting, 1, static_cast<int>(1000.0 * seconds_));
  if (ready == 0) ::kill(pid_, SIGKILL);
  if (!read_all(results_, &outcome.exit, sizeof outcome.exit)) {
    const int pid = pid_;
    ::close(jobs_);
    ::close(results_);
    pid_ = -1;
    int exit = -1;
    outcome.crash = end_of(pid, exit);
    if (ready == 0) outcome.crash = "did not end within " + std::to_string(seconds_) + " s";
    if (outcome.crash.empty()) outcome.crash = "ended the process with exit code " + std::to_string(exit);
    outcome.exit = -1;
  }
  outcome.stdout_text = text_in(scratch_ / "stdout");
  outcome.stderr_text = text_in(scratch_ / "stderr");
  return outcome;
}

double Worker::processor_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Outcome run_program(const fs::path& bin, const Job& job, double seconds) {
  std::string name = (fs::temp_directory_path() / "twindeck_program_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
  const fs::path scratch = name;
  std::vector<std::string> words = job.arguments;
  words.insert(words.begin(), (bin / job.step).string());
  std::vector<char*> argv = pointers(words);
  std::fflush(nullptr);
  const int pid = ::fork();
  if (pid == 0) {
    limit_memory();
    redirect(scratch);
    if (::chdir(job.folder.c_str()) != 0) ::_exit(121);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  Outcome outcome;
  const auto begin = std::chrono::steady_clock::now();
  while (true) {
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT);
    if (info.si_pid == pid) break;
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > seconds) {
      ::kill(pid, SIGKILL);
      outcome.crash = "did not end within " + std::to_string(seconds) + " s";
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const std::string end = end_of(pid, outcome.exit);
  if (outcome.crash.empty()) outcome.crash = end;
  outcome.stdout_text = text_in(scratch / "stdout");
  outcome.stderr_text = text_in(scratch / "stderr");
  fs::remove_all(scratch);
  return outcome;
}

}  // namespace twindeck::broken
