// Integrates a reference motion with contensou/wrench_kernel.h alone, and prints t, vx, vy, wx, wy, wz.
//   stepper CASE.toml SECONDS             explicit steps of 0.1 ms; each 50th state
//   stepper CASE.toml SECONDS elliptic    the elliptic cone in place of the law
//   stepper CASE.toml SECONDS 240         implicit steps, 240 a second; then the mean and the largest number of calls
//   of
//                                         the law in a step before rest, on stderr
#include <contensou/wrench_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace kernel = contensou::kernel;

/// A ring whose whole load is on its rim. The law is the mean over points of the rim.
struct Rim {
  template <class T>
  kernel::Friction<T> operator()(const kernel::Slip<T>& at) const {
    kernel::Friction<T> mean{};
    constexpr int points = 64;  // number of points on a quarter of the rim; each also counts for its opposite point
    for (int i = 0; i < points; ++i) {
      const T s = std::sin((i + T(0.5)) * T(1.5707963267948966) / points), p = at.p, r = at.r;
      const T one = std::sqrt(p * p + r * r + 2 * p * r * s), other = std::sqrt(p * p + r * r - 2 * p * r * s);
      const T sum = one + other, rest = 2 * s * s / sum, per = 1 / (points * one * other);
      mean.force += (sum / 2 - r * r * rest) * per;
      mean.moment += (sum / 2 - p * p * rest) * per;
      const T cubes = (1 - s * s) / (2 * points) * (1 / (one * one * one) + 1 / (other * other * other));
      mean.force_slope += r * cubes, mean.moment_slope += p * cubes;
    }
    return mean;
  }
};

/// Counts the calls of a law.
template <class Law>
struct Counted {
  long* calls;

  template <class T>
  kernel::Friction<T> operator()(const kernel::Slip<T>& at) const {
    ++*calls;
    return Law{}(at);
  }
};

int main(int count, char** words) {
  if (count < 3) return 2;
  std::map<std::string, std::vector<double>> numbers;  // values of lines "key = 1" and "key = [1, 2]"
  std::string line, key, body;
  for (std::ifstream file(words[1]); std::getline(file, line);) {
    line = line.substr(0, line.find('#'));
    for (char& c : line) c = std::strchr("=[],'", c) ? ' ' : c;
    std::istringstream in(line);
    in >> key;
    if (key == "body") in >> body;
    for (double x; in >> x;) numbers[key].push_back(x);
  }
  const auto number = [&](const char* name) { return numbers.count(name) ? numbers[name].at(0) : 0; };
  const bool ball = body == "ball", ring = body == "ring",
             elliptic = count > 3 && std::strcmp(words[3], "elliptic") == 0;
  const double rate = count > 3 && !elliptic ? std::atof(words[3]) : 0;
  const double m = number("mass"), R = number("radius"), a = ball ? number("patch_radius") : R;
  const double alpha = number("slope") * std::acos(-1.0) / 180, load = m * number("gravity") * std::cos(alpha);
  const double pull = -number("gravity") * std::sin(alpha), limit = number("friction") * load;
  const double inertia = (ball   ? 0.4
                          : ring ? 1
                                 : 0.5) *
                         m * R * R,
               resist = 1.4 * number("rolling_friction") * load * R;
  std::vector<double> v = numbers["velocity"], w = numbers["angular_velocity"];
  if (v.empty()) v = {number("slip"), 0}, w = {0, 0, number("spin")};
  const double dt = rate > 0 ? 1 / rate : 1e-4;
  const double by_force = (ball ? 3.5 : 1) / m, by_moment = 1 / inertia;
  long steps = 0, calls = 0, most = 0;
  bool rests = false;
  // Implicit steps apply resistance before friction, as an engine does with the other forces of a step.
  const auto resisted = [&] {
    const double turning = std::hypot(w[0], w[1]), loss = std::min(turning, resist / inertia * dt);
    for (int i = 0; ball && i < 2 && turning > 0; ++i) w[i] -= w[i] / turning * loss;
  };
  std::printf("t,vx,vy,wx,wy,wz\n");
  for (long step = 0; step * dt <= std::atof(words[2]); ++step) {
    if (step % (rate > 0 ? 1 : 50) == 0)
      std::printf("%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", step * dt, v[0], v[1], w[0], w[1], w[2]);
    if (rate > 0) v[0] += pull * dt, resisted();
    const double vx = v[0] - (ball ? R * w[1] : 0), vy = v[1] + (ball ? R * w[0] : 0);  // velocity of the contact
    double fx, fy, moment;
    if (rate > 0) {
      long of_step = 0;
      const auto stepped = [&](auto law) { return kernel::step(vx, vy, w[2], by_force, by_moment, limit, a, dt, law); };
      const auto after = ball   ? stepped(Counted<kernel::Exact>{&of_step})
                         : ring ? stepped(Counted<Rim>{&of_step})
                                : stepped(Counted<kernel::Uniform>{&of_step});
      fx = after.fx, fy = after.fy, moment = after.m;
      if (!rests) ++steps, calls += of_step, most = std::max(most, of_step);
      rests = rests || (after.vx == 0 && after.vy == 0 && after.w == 0);
    } else {
      const auto now = elliptic ? kernel::wrench<kernel::Elliptic>(vx, vy, w[2], limit, a)
                       : ball   ? kernel::wrench<kernel::Exact>(vx, vy, w[2], limit, a)
                       : ring   ? kernel::wrench<Rim>(vx, vy, w[2], limit, a)
                                : kernel::wrench<kernel::Uniform>(vx, vy, w[2], limit, a);
      fx = now.fx, fy = now.fy, moment = now.m;
    }
    v[0] += (fx / m + (rate > 0 ? 0 : pull)) * dt, v[1] += fy / m * dt, w[2] += moment / inertia * dt;
    if (!ball) continue;  // only a ball turns about x and y
    w[0] += R * fy / inertia * dt, w[1] -= R * fx / inertia * dt;
    if (rate == 0) resisted();
  }
  if (rate > 0) std::fprintf(stderr, "%.1f %ld\n", static_cast<double>(calls) / static_cast<double>(steps), most);
}
