// A library that is preloaded into the program. It makes one of its system calls fail. Variables of the environment:
//   CONTENSOU_FAULT        "CALL KIND VALUE", calls counted from 1; KIND is
//                            e  the call fails, VALUE is its errno
//                            s  a write writes half of what it should
//                            b  the signal VALUE comes before the call; a: after it
//                            x  the call throws what no code of ours throws; VALUE is unused
//                            t  the signals VALUE and SIGINT come before the call, both at once; u: after it
//   CONTENSOU_FAULT_COUNT  a file that receives the number of calls when the program ends normally
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include <dlfcn.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace {

struct Fault {
  Fault() {
    const char* const wanted = std::getenv("CONTENSOU_FAULT");
    if (wanted != nullptr) std::sscanf(wanted, "%d %c %d", &call, &kind, &value);
  }
  ~Fault() {
    const char* const path = std::getenv("CONTENSOU_FAULT_COUNT");
    if (path == nullptr || !active) return;
    active = false;
    if (std::FILE* const file = std::fopen(path, "w")) {
      std::fprintf(file, "%d\n", calls.load());
      std::fclose(file);
    }
  }

  int call = 0;
  char kind = ' ';
  int value = 0;
  std::atomic<int> calls = 0;
  bool active = std::string_view(program_invocation_short_name) == "contensou";  // false in gnuplot
};

Fault fault;

void send_signals() {
  if (fault.kind == 'a' || fault.kind == 'b') {
    std::raise(fault.value);
    return;
  }
  sigset_t both, before;
  ::sigemptyset(&both);
  ::sigaddset(&both, fault.value);
  ::sigaddset(&both, SIGINT);
  ::pthread_sigmask(SIG_BLOCK, &both, &before);
  std::raise(fault.value);
  std::raise(SIGINT);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

bool is(std::string_view kinds) { return kinds.find(fault.kind) != std::string_view::npos; }

template <class Call>
auto faulty(Call call) {
  const bool now = fault.active && ++fault.calls == fault.call;
  if (now && is("e")) {
    errno = fault.value;
    return static_cast<decltype(call(false))>(-1);
  }
  if (now && is("x")) throw std::out_of_range("vector::_M_range_check");
  if (now && is("bt")) send_signals();
  const auto result = call(now && is("s"));
  const int error = errno;
  if (now && is("au")) send_signals();
  errno = error;
  return result;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// NOLINTBEGIN: the names and types are the system's
#define REAL(name) static const auto name##_ = real<decltype(name)>(#name)
extern "C" {
ssize_t write(int file, const void* data, size_t size) {
  REAL(write);
  return faulty([&](bool half) { return write_(file, data, half ? size / 2 : size); });
}
ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  REAL(pwrite);
  return faulty([&](bool half) { return pwrite_(file, data, half ? size / 2 : size, at); });
}
int mkostemp(char* name, int flags) {
  REAL(mkostemp);
  return faulty([&](bool) { return mkostemp_(name, flags); });
}
int memfd_create(const char* name, unsigned flags) {
  REAL(memfd_create);
  return faulty([&](bool) { return memfd_create_(name, flags); });
}
int fchmod(int file, mode_t mode) {
  REAL(fchmod);
  return faulty([&](bool) { return fchmod_(file, mode); });
}
int fallocate(int file, int mode, off_t at, off_t size) {
  REAL(fallocate);
  return faulty([&](bool) { return fallocate_(file, mode, at, size); });
}
int close(int file) {
  REAL(close);
  return faulty([&](bool) { return close_(file); });
}
int rename(const char* from, const char* to) {
  REAL(rename);
  return faulty([&](bool) { return rename_(from, to); });
}
pid_t fork() {
  REAL(fork);
  return faulty([&](bool) { return fork_(); });
}
pid_t waitpid(pid_t child, int* status, int options) {
  REAL(waitpid);
  return faulty([&](bool) { return waitpid_(child, status, options); });
}
}
// NOLINTEND
