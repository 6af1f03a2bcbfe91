#include "plugins/host/trial.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <exception>

namespace pomona {
namespace {

constexpr char kLived = 'l', kThrew = 't', kLeft = 'e';  // what the child reports begins with
int report = -1;                                         // the child's end of the pipe

[[noreturn]] void leave(char how, const char* what) {
  const std::size_t length = ::strlen(what);
  const bool written = ::write(report, &how, 1) == 1 && ::write(report, what, length) >= 0;
  ::_exit(written ? 0 : 1);
}

// What std::terminate() calls: an exception left where none may, as the constructor of a static object.
[[noreturn]] void reportTermination() {
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::exception& e) {
    leave(kThrew, e.what());
  } catch (...) {
  }
  leave(kThrew, "of a type that is no std::exception");
}

// What exit() calls first: what it would call next waits for threads that a child has not.
void reportExit(int status, void*) {
  leave(kLeft, std::to_string(status).c_str());
}

[[noreturn]] void runChild(int pipe_end, const std::function<void()>& work) {
  constexpr unsigned kLongest_s = 10;
  report = pipe_end;
  std::set_terminate(reportTermination);
  ::on_exit(reportExit, nullptr);
  ::signal(SIGALRM, SIG_DFL);
  ::alarm(kLongest_s);
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  try {
    work();
  } catch (...) {  // the parent will see for itself
  }
  leave(kLived, "");
}

std::string readAll(int pipe_end) {
  std::string all;
  std::array<char, 512> part;
  for (ssize_t got; (got = ::read(pipe_end, part.data(), part.size())) > 0 || (got < 0 && errno == EINTR);)
    if (got > 0) all.append(part.data(), static_cast<std::size_t>(got));
  return all;
}

}  // namespace

std::string deathBy(const std::function<void()>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return "";
  const pid_t child = ::fork();
  if (child == 0) runChild(ends[1], work);
  ::close(ends[1]);
  const std::string said = child > 0 ? readAll(ends[0]) : "";
  ::close(ends[0]);
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) return "";
  if (said.starts_with(kThrew)) return "by an exception: " + said.substr(1);
  if (said.starts_with(kLived)) return "";
  if (said.starts_with(kLeft)) return "by leaving it with status " + said.substr(1);
  if (WIFEXITED(status)) return "by leaving it with status " + std::to_string(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGALRM) return "";
  return "by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
}

}  // namespace pomona
