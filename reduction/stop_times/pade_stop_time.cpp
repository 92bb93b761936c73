#include "contensou/reduction/pade_stop_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/pade_sliding_share.hpp"
#include "similarity/pade_slow_rim.hpp"

namespace contensou::reduction {

namespace {

/// P + m S. In long double, so that of the two terms only the error of m is left.
long double sum_of_limits(double mu, double u, double v, Inertia inertia) {
  const double r = std::clamp(inertia.gamma * (mu * mu) / inertia.chi, std::numeric_limits<double>::min(), 1e100);
  const double m = v > 0 ? pade_sliding_share(r, v / (mu * u)) : 0;
  constexpr long double pi = std::numbers::pi_v<long double>;
  const long double pivoting = 8 * static_cast<long double>(u) / (static_cast<long double>(inertia.gamma) * mu);
  const long double sliding = 3 * pi * v / (2 * static_cast<long double>(inertia.chi));
  return pivoting + sliding * m;
}

bool positive(double value) { return value > 0 && std::isfinite(value); }

void require_positive(const char* name, double value) {
  if (!positive(value)) {
    throw std::domain_error(fmt::format("pade_stop_time: {} must be positive and finite, got {}", name, value));
  }
}

/// Speeds, mu, chi and gamma between 1/large and large need no scaling.
constexpr double large = 0x1p300;

/// Numbers that are computed together: what every 64-bit processor has.
using Lanes = double __attribute__((vector_size(16)));
constexpr std::size_t width = sizeof(Lanes) / sizeof(double);

/// A block of starts, sorted into groups by the number of terms they need, so that several can be computed as one.
class Block {
 public:
  static constexpr std::size_t size = 256;

  explicit Block(Inertia inertia)
      : inertia_(inertia), unit_(static_cast<double>(3 * std::numbers::pi_v<long double> / (2 * inertia.chi))) {}

  /// @param count  size or less
  void evaluate(std::size_t count, const double* mu, const double* u0, const double* v0, double* tau) {
    for (std::size_t i = 0; i < count; ++i) {
      const double u = std::abs(u0[i]);
      r_[i] = inertia_.gamma * (mu[i] * mu[i]) / inertia_.chi;
      T_[i] = (5 - r_[i]) * (3 * std::numbers::pi / 16) * (v0[i] / (mu[i] * u));
      t_[i] = T_[i] / (1 - 0.5 * r_[i]);
      pivoting_[i] = 8 * u / (inertia_.gamma * mu[i]);
      sliding_[i] = unit_ * v0[i];
    }
    for (Group& group : groups_) group.count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_simple(mu[i], u0[i], v0[i], r_[i])) {
        tau[i] = any(mu[i], {u0[i], v0[i]});
      } else {
        std::size_t group = 0;
        while (group + 1 < groups_.size() && t_[i] >= groups_[group].most_t) ++group;
        groups_[group].add(i);
      }
    }
    for (const Group& group : groups_) {
      for (std::size_t first = 0; first < group.count; first += width) some(group, first, tau);
    }
  }

 private:
  struct Group {
    double most_t;  ///< t is less
    int terms;      ///< pairs of the fraction or terms of the series
    std::size_t count = 0;
    std::array<unsigned char, size> index{};

    void add(std::size_t i) { index[count++] = static_cast<unsigned char>(i); }
  };

  /// Whether a start needs neither scaling nor another formula.
  static bool is_simple(double mu, double u0, double v0, double r) {
    const double largest = std::max(std::abs(u0), v0);
    return mu > 1 / large && v0 >= 0 && largest > 1 / large && largest < large && r <= slow_rim::largest_r;
  }

  double any(double mu, State start) const {
    const bool valid = positive(mu) && std::isfinite(start.u) && std::isfinite(start.v) && start.v >= 0;
    return valid ? pade_stop_time(mu, start, inertia_) : std::numeric_limits<double>::quiet_NaN();
  }

  /// The starts of a group from the first on, as many as there are lanes.
  void some(const Group& group, std::size_t first, double* tau) const {
    std::array<std::size_t, width> index;
    Lanes r, T;
    for (std::size_t lane = 0; lane < width; ++lane) {
      index[lane] = group.index[std::min(first + lane, group.count - 1)];
      r[lane] = r_[index[lane]];
      T[lane] = T_[index[lane]];
    }
    Lanes m;
    if (group.most_t <= slow_rim::fraction_t) {
      m = slow_rim::by_fraction<Lanes>(r, T, group.terms);
    } else if (group.terms > 0) {
      const Lanes eta = 1 / (1 - 0.5 * r + T);
      const Lanes y = (1 - 0.5 * r) * eta;
      const Lanes constant = slow_rim::connection<Lanes>(r);
      const Lanes d = r / (5 - r);
      Lanes W;
      for (std::size_t lane = 0; lane < width; ++lane) {
        W[lane] = slow_rim::weight(d[lane], std::log(y[lane]) + constant[lane]);
      }
      m = slow_rim::by_series<Lanes>(r, eta, y, W, group.terms);
    } else {
      m = Lanes{} + 1;
    }
    for (std::size_t lane = 0; lane < width; ++lane)
      tau[index[lane]] = pivoting_[index[lane]] + sliding_[index[lane]] * m[lane];
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Inertia inertia_;
  double unit_;  ///< S/v0
  std::array<double, size> r_, T_, t_, pivoting_, sliding_;
  std::array<Group, 7> groups_{{{0.125, slow_rim::fraction_pairs(0.124)},
                                {1, slow_rim::fraction_pairs(0.9)},
                                {slow_rim::fraction_t, slow_rim::fraction_pairs(2.9)},
                                {31, slow_rim::series_terms(3)},
                                {1023, slow_rim::series_terms(6)},
                                {0x1p60, slow_rim::series_terms(11)},
                                {infinity, 0}}};
};

}  // namespace

double pade_stop_time(double mu, State start, Inertia inertia) {
  const double u = std::abs(start.u);
  const double v = start.v;
  const double largest = std::max(u, v);
  const bool ordinary = mu > 1 / large && mu < large && largest > 1 / large && largest < large && v >= 0 &&
                        inertia.chi > 0 && inertia.chi < large && inertia.gamma > 0 && inertia.gamma < large;
  if (ordinary) return static_cast<double>(sum_of_limits(mu, u, v, inertia));

  require_positive("mu", mu);
  require_positive("chi", inertia.chi);
  require_positive("gamma", inertia.gamma);
  require_state("pade_stop_time", start);
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest);
  const long double tau = sum_of_limits(mu, std::ldexp(u, -exponent), std::ldexp(v, -exponent), inertia);
  return static_cast<double>(std::ldexp(tau, exponent));
}

void pade_stop_times(std::span<const double> mu, std::span<const double> u0, std::span<const double> v0,
                     std::span<double> tau, Inertia inertia) {
  if (mu.size() != tau.size() || u0.size() != tau.size() || v0.size() != tau.size()) {
    throw std::domain_error(
        fmt::format("pade_stop_times: the arrays must have one size, got {} mu, {} u0, {} v0, {} tau", mu.size(),
                    u0.size(), v0.size(), tau.size()));
  }
  require_positive("chi", inertia.chi);
  require_positive("gamma", inertia.gamma);
  Block block(inertia);
  for (std::size_t i = 0; i < tau.size(); i += Block::size) {
    block.evaluate(std::min(Block::size, tau.size() - i), &mu[i], &u0[i], &v0[i], &tau[i]);
  }
}

}  // namespace contensou::reduction
