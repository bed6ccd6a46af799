#include "cage/program_run.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

namespace softbody {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Closes a file descriptor at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  void reset() {
    if (number_ != -1) close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// An unnamed file in memory that holds the bytes, at its begin.
int fileOf(const std::string& bytes) {
  const int file = memfd_create("softbody_input", MFD_CLOEXEC);
  for (std::size_t written = 0; file != -1 && written < bytes.size();) {
    const ssize_t count = write(file, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno != EINTR) fail(errno, "the input of a program cannot be stored");
    if (count > 0) written += static_cast<std::size_t>(count);
  }
  if (file == -1 || lseek(file, 0, SEEK_SET) == -1) fail(errno, "the input of a program cannot be stored");
  return file;
}

/// Starts the program with default signals and no other files than stdin, stdout and stderr.
pid_t start(const std::string& program, const std::string& argument, int input, int output) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, 3);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::string name = program, word = argument;
  char* const arguments[] = {name.data(), word.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &files, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) fail(error, "the program " + program + " cannot be started");
  return child;
}

/// Reads to the end. @return false if the deadline passes first.
bool readAll(int file, Clock::time_point deadline, std::string* bytes) {
  std::array<char, 65536> buffer{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd waiting{file, POLLIN, 0};
    const int ready = left > 0 ? poll(&waiting, 1, static_cast<int>(left)) : 0;
    if (ready == 0) return false;
    const ssize_t count = ready > 0 ? read(file, buffer.data(), buffer.size()) : -1;
    if (count == 0 || (count < 0 && errno != EINTR)) return true;
    if (count > 0) bytes->append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// Waits for the child's end. @return whether it ended well; nothing if the deadline passes first.
std::optional<bool> waitFor(pid_t child, Clock::time_point deadline) {
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (ended < 0 && errno != EINTR) return true;  // somebody else took the status
    if (Clock::now() >= deadline) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void killAndWait(pid_t child) {
  kill(child, SIGKILL);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

std::optional<std::string> outputOfProgram(const std::filesystem::path& program, const std::string& argument,
                                           const std::string& input, std::chrono::seconds time_limit) {
  const Descriptor in(fileOf(input));
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail(errno, "a pipe to a program cannot be made");
  const Descriptor from_child(ends[0]);
  Descriptor to_parent(ends[1]);
  const pid_t child = start(program.string(), argument, in.number(), to_parent.number());
  to_parent.reset();
  const Clock::time_point deadline = Clock::now() + time_limit;
  std::string bytes;
  std::optional<bool> ended_well;
  if (readAll(from_child.number(), deadline, &bytes)) ended_well = waitFor(child, deadline);
  if (!ended_well) {
    killAndWait(child);
    fail(ETIMEDOUT, program.string() + " does not end");
  }
  return *ended_well ? std::optional<std::string>(std::move(bytes)) : std::nullopt;
}

}  // namespace softbody
