// If writing a file fails at any place, either the old or the new file must exist, complete, and no other file.
#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace fs = std::filesystem;

namespace {

/// A command line that writes files.
struct Writer {
  std::string words;
  std::vector<std::string> files;
  std::string option = "-o";
};

/// One command line for each way in which a verb writes files.
const std::vector<Writer> writers{
    {"stop --mu 0.1 --u0 1 --v0 1", {"stop.csv"}},
    {"stop --batch table", {"batch.csv"}},
    {"orbit --mu 0.1 --u0 1 --v0 1", {"orbit.csv"}},
    {"law --k 0,1,2", {"law.json"}},
    {"law", {"law.svg"}},
    {"roll --ball pool", {"roll.csv"}},
    {"roll --ball pool", {"roll.pdf"}},
    {"terminal --mu 0.1", {"terminal.json"}},
    {"portrait --mu 0.3", {"portrait.svg"}},
    {"portrait --mu 0.3", {"portrait.pdf"}},
    {"portrait --mu 0.3", {"portrait.png"}},
    {"portrait --mu 0.3", {"portrait.eps"}},
    {"portrait --mu 0.3", {"portrait.gp"}},
    {"portrait --mu 0.3", {"portrait.tex"}},
    {"portrait --mu 0.3", {"portrait.json"}},
    {"portrait --mu 0.3", {"portrait.csv"}},
    {"sweep --mu 0.1 --u0 0:1:300 --v0 0:1:300", {"sweep.npy"}},
    {"sweep --mu 0.1 --u0 0:1:300 --v0 0:1:300", {"sweep.csv"}},
    {"sweep --mu 0.1 --u0 0:1:30 --v0 0:1:30", {"sweep.svg"}},
    {"roll --ball pool --until 0.001", {"roll.gif"}},
    {"balls pool", {"pool.toml"}},
    {"fit table --ball pool --noise slip=0.01,spin=1 --free slip,spin", {"ball.toml"}},
    {"fit table --ball pool --noise slip=0.01,spin=1 --free slip,spin", {"fit.svg"}},
#ifdef CONTENSOU_HAS_PAGE
    {"explore", {"page.html"}},
#endif
    {"paper",
     {"D/fig1.pdf", "D/fig1.svg", "D/fig2.pdf", "D/fig2.svg", "D/fig3.pdf", "D/fig3.svg", "D/fig4.pdf", "D/fig4.svg"},
     "--out"},
};

/// Runs the program in a folder.
/// @param prepare  function that is called in the program's process
Run run_in(const fs::path& folder, const Writer& writer, const std::function<void()>& prepare) {
  std::istringstream given(writer.words);
  std::vector<std::string> words(std::istream_iterator<std::string>(given), {});
  if (!writer.files.empty()) {
    const fs::path file = writer.files.front();
    words.insert(words.end(), {writer.option, writer.option == "-o" ? file.string() : file.parent_path().string()});
  }
  return run_program(words, {}, [&] {
    const rlimit none{0, 0};
    if (::chdir(folder.c_str()) != 0 || ::setrlimit(RLIMIT_CORE, &none) != 0) ::_exit(99);
    for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
    prepare();
  });
}

/// Returns the paths of everything in a folder.
std::vector<std::string> all_in(const fs::path& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    paths.push_back(fs::relative(entry.path(), folder).string());
  }
  std::ranges::sort(paths);
  return paths;
}

/// A folder in which one command line is run repeatedly. gnuplot draws the picture once; later runs copy the result.
class Bench {
 public:
  explicit Bench(Writer writer) : writer_(std::move(writer)) {
    fs::create_directories(tools_.path() / "bin");
    write_gnuplot(
        "cat >\"$0.$$\"; for drawn in \"$0\".*.drawn; do cmp -s \"$0.$$\" \"${drawn%.drawn}\" && exec cat "
        "\"$drawn\"; done; PATH=$OLD_PATH gnuplot \"$@\" <\"$0.$$\" | tee \"$0.$$.drawn\"");
    write_file(tools_.file("table"), "mu,u0,v0,t,slip,spin\n0.1,1,1,0,1,100\n0.2,1,1,0.3,0,97\n");
    path_ = tools_.file("bin") + ":" + std::getenv("PATH");
    refresh(false);
    const Run ended = run([] {});
    INFO(writer_.words << "\n" << ended.err);
    REQUIRE(ended.status == 0);
    out_ = ended.out;
    for (const std::string& file : writer_.files) whole_.push_back(read_file(folder_ / file));
  }

  const Writer& writer() const { return writer_; }
  std::size_t size() const { return std::ranges::max(whole_, {}, &std::string::size).size(); }
  std::string tool(const std::string& name) const { return tools_.file(name); }

  /// Changes to another folder, which is empty.
  void move_to(const fs::path& folder) { folder_ = folder; }

  /// Restores the folder to its state before a run, with or without an old file.
  void refresh(bool old) {
    for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry);
    write_file(folder_ / "table", read_file(tools_.file("table")));
    for (const std::string& file : writer_.files) {
      if (!old) continue;
      fs::create_directories((folder_ / file).parent_path());
      write_file(folder_ / file, "old");
    }
    before_ = all_in(folder_);
  }

  Run run(const std::function<void()>& prepare) const {
    return run_in(folder_, writer_, [&] {
      ::setenv("OLD_PATH", std::getenv("PATH"), 1);
      ::setenv("PATH", path_.c_str(), 1);
      ::setenv("TMPDIR", "/no/such/folder", 1);
      prepare();
    });
  }

  /// Requires that each file is the old or the new one, and no other file exists. After success all files must be new.
  void require_old_or_new(const Run& ended) const {
    INFO(writer_.words << ", status " << ended.status << ", signal " << ended.signal << "\n" << ended.err);
    std::vector<std::string> before = before_;
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      const std::string& file = writer_.files[i];
      const bool is_new = fs::exists(folder_ / file) && read_file(folder_ / file) == whole_[i];
      const bool was_there = std::ranges::find(before_, file) != before_.end();
      CAPTURE(file);
      if (ended.status == 0) REQUIRE(is_new);
      if (!is_new && was_there) REQUIRE(read_file(folder_ / file) == "old");
      if (!is_new || was_there) continue;
      before.push_back(file);
      const std::string folder = fs::path(file).parent_path();
      if (!folder.empty() && std::ranges::find(before, folder) == before.end()) before.push_back(folder);
    }
    std::ranges::sort(before);
    REQUIRE(all_in(folder_) == before);
    if (ended.status >= 0) REQUIRE((ended.status == 0 || ended.status == 4));
    if (ended.status > 0) REQUIRE(("\n" + ended.err).find("\ncontensou: ") != std::string::npos);
    REQUIRE(ended.err.find("exception") == std::string::npos);
    if (ended.status != 0) REQUIRE(ended.out.empty());
    if (ended.status == 0) REQUIRE(ended.out == out_);
  }

 private:
  void write_gnuplot(const std::string& commands) const {
    write_file(tools_.file("bin/gnuplot"), "#!/bin/sh\n" + commands + "\n");
    fs::permissions(tools_.file("bin/gnuplot"), fs::perms::owner_all);
  }

  Writer writer_;
  TemporaryDirectory tools_, scratch_;
  fs::path folder_ = scratch_.path();
  std::string path_, out_;
  std::vector<std::string> whole_;
  std::vector<std::string> before_;
};

void limit_file_size(std::size_t bytes) {
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

/// A fault at one of the program's calls; see preload/fault.cpp.
struct Fault {
  char kind;
  int value;
};

/// Preloads the library of faults in the program's process, and sets the fault.
void preload(const char* variable, const std::string& value) {
  ::setenv("LD_PRELOAD", CONTENSOU_FAULT_LIBRARY, 1);
  ::setenv(variable, value.c_str(), 1);
}

void preload_fault(int call, Fault fault) {
  preload("CONTENSOU_FAULT", std::to_string(call) + " " + fault.kind + " " + std::to_string(fault.value));
}

/// Runs the program with a fault at each of its calls in turn. If `one_of` is n, only one of n calls has a fault.
void try_faults(const Writer& writer, const std::vector<Fault>& faults, int one_of = 1) {
  Bench bench(writer);
  bench.refresh(true);
  bench.require_old_or_new(bench.run([&] { preload("CONTENSOU_FAULT_COUNT", bench.tool("count")); }));
  const int calls = std::stoi(read_file(bench.tool("count")));
  REQUIRE(calls >= 4);
  for (int call = 1; call <= calls; call += one_of) {
    for (const Fault& fault : faults) {
      CAPTURE(call, fault.kind, fault.value);
      bench.refresh(call % 2 == 0);
      bench.require_old_or_new(bench.run([&] { preload_fault(call, fault); }));
    }
  }
}

const std::vector<Fault> errors{{'e', ENOSPC}, {'e', EINTR}, {'s', 0}};
const std::vector<Fault> signals{{'b', SIGTERM}, {'a', SIGHUP}, {'b', SIGPIPE}, {'t', SIGTERM}, {'u', SIGTERM}};

/// Returns every signal that ends a program, except SIGKILL.
std::vector<Fault> all_signals() {
  std::vector<Fault> faults;
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    const auto others = {SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN, SIGTTOU, SIGCONT, SIGCHLD, SIGURG, SIGWINCH, SIGXFSZ};
    const bool reserved = signal > SIGSYS && signal < SIGRTMIN;
    if (!reserved && std::ranges::find(others, signal) == others.end()) faults.push_back({'b', signal});
  }
  return faults;
}

const Writer& batch = writers[1];
const Writer& picture = writers[8];
const Writer& map = writers[16];

/// The writers that meet limits and full disks: all, or one of each kind.
const std::vector<Writer> limited =
    CONTENSOU_FULL_TESTS ? writers : std::vector<Writer>{writers[0], batch, picture, map, writers.back()};

/// A small file system of its own in a folder, if root may mount one.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t bytes) {
    there_ = ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
             ::mount("none", folder_.path().c_str(), "tmpfs", 0, ("size=" + std::to_string(bytes)).c_str()) == 0;
  }
  ~SmallDisk() {
    if (there_) ::umount(folder_.path().c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool there() const { return there_; }
  const fs::path& path() const { return folder_.path(); }

 private:
  TemporaryDirectory folder_;
  bool there_ = false;
};

/// Runs the program with a limit of so many bytes for each file that it writes.
void try_room(Bench& bench, std::size_t bytes) {
  CAPTURE(bytes);
  bench.refresh(bytes % 2 == 0);
  bench.require_old_or_new(bench.run([bytes] { limit_file_size(bytes); }));
}

}  // namespace

TEST_CASE("a call to the system that fails leaves the old file or the new one", "[cli]") {
  for (const Writer& writer : {writers[0], batch, picture, map}) try_faults(writer, errors);
}

TEST_CASE("a signal at any call leaves the old file or the new one", "[cli]") {
  for (const Writer& writer : {batch, map}) try_faults(writer, signals);
}

TEST_CASE("any call that fails, any signal at any call, any verb", "[.full]") {
  for (const Writer& writer : writers) {
    // One run of `paper` draws eight pictures, so only every seventh call fails.
    const int one_of = writer.words == "paper" ? 7 : 1;
    try_faults(writer, errors, one_of);
    try_faults(writer, signals, one_of);
  }
  for (const Writer& writer : {batch, picture, map}) try_faults(writer, all_signals());
}

TEST_CASE("a limit on the size of files leaves the old file or the new one", "[cli]") {
  for (const Writer& writer : limited) {
    Bench bench(writer);
    for (const std::size_t bytes : {std::size_t{0}, bench.size() / 2, bench.size() - 1}) try_room(bench, bytes);
  }
}

TEST_CASE("limits on the size of files, step by step", "[.full]") {
  for (const Writer& writer : writers) {
    Bench bench(writer);
    for (std::size_t step = 0; step < 40; ++step) try_room(bench, bench.size() * step / 40 + step % 2);
  }
}

TEST_CASE("a full disk leaves the old file or the new one", "[cli]") {
  for (const Writer& writer : limited) {
    Bench bench(writer);
    const std::size_t page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    for (const std::size_t pages : {std::size_t{4}, bench.size() / page / 2 + 3, 12 * (bench.size() / page + 3)}) {
      const SmallDisk disk(pages * page);
      if (!disk.there()) {
        WARN("no file system can be mounted here: not tested");
        return;
      }
      CAPTURE(pages);
      bench.move_to(disk.path());
      bench.refresh(pages > 4);
      bench.require_old_or_new(bench.run([] {}));
    }
  }
}

TEST_CASE("a closed standard stream changes no file", "[cli]") {
  for (const Writer& writer : {batch, picture, map, writers.back()}) {
    Bench bench(writer);
    for (const int stream : {0, 2}) {
      CAPTURE(stream);
      bench.refresh(true);
      const Run ended = bench.run([stream] { ::close(stream); });
      CHECK(ended.status == 0);
      bench.require_old_or_new(ended);
    }
  }
  const TemporaryDirectory folder;
  write_file(folder.file("table"), "mu,u0,v0\nbad,1,1\n0.2,1,1\n");
  const Run ended =
      run_in(folder.path(), {"stop --batch table --keep-going", {"t.csv"}}, [] { ::close(STDERR_FILENO); });
  CHECK(ended.status == 2);
  CHECK(read_file(folder.file("t.csv")).starts_with("mu,u0,v0,tau_stop\nbad,1,1,\n0.2,1,1,"));
}

TEST_CASE("a closed standard output is a failure, a closed pipe the usual end", "[cli]") {
  const TemporaryDirectory folder;
  const Run closed = run_in(folder.path(), {"orbit --ball pool", {}}, [] { ::close(STDOUT_FILENO); });
  CHECK(closed.status == 4);
  CHECK_THAT(closed.err, Catch::Contains("cannot write standard output: "));
  const Run unread = run_in(folder.path(), {"orbit --ball pool", {}}, [] {
    int pipe[2];
    if (::pipe(pipe) == 0) ::dup2(pipe[1], STDOUT_FILENO), ::close(pipe[0]), ::close(pipe[1]);
  });
  CHECK(unread.signal == SIGPIPE);
  CHECK(unread.err.empty());
}

TEST_CASE("Ctrl-C amid a sweep leaves the old file and says so", "[cli]") {
  for (const std::string file : {"map.npy", "map.csv"}) {
    const TemporaryDirectory folder;
    write_file(folder.file(file), "old");
    const Run ended = run_in(folder.path(), {"sweep --mu 0.1 --u0 0:1:1000 --v0 0:1:100 --threads 2", {file}}, [] {
      preload_fault(3, {'b', SIGINT});  // at this call the new file exists and is partly written
    });
    CHECK(ended.signal == SIGINT);
    CHECK(ended.err == "contensou: interrupted: " + file + " was not written, nothing is left of it\n");
    CHECK(folder.names() == std::vector<std::string>{file});
    CHECK(read_file(folder.file(file)) == "old");
  }
}

TEST_CASE(
    "what no code of ours throws is said to be our fault, with what was asked, in no words of the standard library",
    "[cli]") {
  const TemporaryDirectory folder;
  const Run ended = run_in(folder.path(), {"portrait --mu 0.3 --law phi=k/(1+k);psi=0.4/(1+k)", {"plane.csv"}}, [] {
    preload_fault(2, {'x', 0});
  });
  CHECK(ended.status == 3);
  CHECK(ended.err ==
        "contensou: a fault of contensou, not of the input; please report it with what was asked: "
        "contensou portrait --mu 0.3 --law 'phi=k/(1+k);psi=0.4/(1+k)' -o plane.csv\n");
  CHECK(folder.names().empty());
}

TEST_CASE("an ignored signal stays ignored", "[cli]") {
  const TemporaryDirectory folder;
  write_file(folder.file("table"), "mu,u0,v0\n0.1,1,1\n");
  const Run ended = run_in(folder.path(), batch, [] {
    preload_fault(2, {'b', SIGHUP});
    std::signal(SIGHUP, SIG_IGN);
  });
  CHECK(ended.status == 0);
  CHECK(folder.names() == std::vector<std::string>{"batch.csv", "table"});
}

TEST_CASE("gnuplot ends with the program, however that ends", "[cli]") {
  const TemporaryDirectory folder;
  fs::create_directory(folder.file("bin"));
  const std::string gnuplot = folder.file("bin/gnuplot");
  write_file(gnuplot, "#!/bin/sh\necho $$ >'" + folder.file("running") + "'\nkill -KILL $PPID\nexec sleep 1000000\n");
  fs::permissions(gnuplot, fs::perms::owner_all);
  const Run ended = run_in(folder.path(), picture, [&folder] {
    ::setenv("PATH", (folder.file("bin") + ":" + std::getenv("PATH")).c_str(), 1);
  });
  CHECK(ended.signal == SIGKILL);
  CHECK(folder.names() == std::vector<std::string>{"bin", "running"});
  const pid_t drawing = std::stoi(read_file(folder.file("running")));
  constexpr int many = 60000;  // steps of 10 ms; only a gnuplot that never ends takes ten minutes
  for (int i = 0; i < many && ::kill(drawing, 0) == 0; ++i) ::usleep(10000);
  CHECK(::kill(drawing, 0) != 0);
}

TEST_CASE("process 1 of a container ends by a signal, too", "[cli]") {
  const TemporaryDirectory folder;
  write_file(folder.file("table"), "mu,u0,v0\n0.1,1,1\n");
  const Run ended = run_in(folder.path(), batch, [] {
    preload_fault(2, {'b', SIGTERM});
    if (::unshare(CLONE_NEWPID) != 0) ::_exit(98);
    const pid_t first = ::fork();
    if (first == 0) return;
    int status = 0;
    ::waitpid(first, &status, 0);
    ::_exit(WIFEXITED(status) ? WEXITSTATUS(status) : 97);
  });
  if (ended.status == 98) {
    WARN("no name space for processes can be made here: not tested");
    return;
  }
  CHECK(ended.status == 128 + SIGTERM);
  CHECK(ended.err == "contensou: interrupted: batch.csv was not written, nothing is left of it\n");
  CHECK(folder.names() == std::vector<std::string>{"table"});
}

TEST_CASE("out of memory is status 4, with a way out", "[limit]") {
  const std::vector<std::string> orbit{"orbit", "--mu", "0.1", "--u0", "1", "--v0", "1", "--samples", "9000000"};
  const Run run = run_program(orbit, {}, [] {
    constexpr rlimit limit{.rlim_cur = 300'000 << 10, .rlim_max = 300'000 << 10};
    if (::setrlimit(RLIMIT_AS, &limit) != 0) ::_exit(98);
  });
  CHECK(run.status == 4);
  CHECK_THAT(run.err, Catch::Contains("contensou: out of memory") && Catch::Contains("ulimit -v"));
}
