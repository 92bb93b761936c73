// Notation (README (R18), (R20)): tau* = P + m(k, r) S,  m = sum_j l_j(r) m_j(k),  m_j at r_j by StopTimePanels
#include "contensou/reduction/stop_times_of_mu.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "contensou/reduction/flow.hpp"
#include "motion/stop_time_loop.hpp"
#include "motion/stop_time_panels.hpp"

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;

constexpr std::size_t points_of_r = 16;
constexpr double allowed_error = 4 * std::numeric_limits<double>::epsilon();

using Weights = std::array<double, points_of_r>;

/// Chebyshev's points of (0, max_r) and their barycentric weights.
struct PointsOfR {
  Weights r, weight;

  PointsOfR() {
    for (std::size_t j = 0; j < points_of_r; ++j) {
      const double angle = std::numbers::pi * static_cast<double>(2 * j + 1) / (2 * points_of_r);
      r[j] = StopTimesOfMu::max_r * (1 - std::cos(angle)) / 2;
      weight[j] = (j % 2 == 0 ? 1 : -1) * std::sin(angle);
    }
  }

  /// Returns the weights l_j at r = x.
  Weights at(double x) const {
    Weights share;
    double sum = 0;
    for (std::size_t j = 0; j < points_of_r; ++j) {
      if (x == r[j]) {
        share.fill(0);
        share[j] = 1;
        return share;
      }
      sum += share[j] = weight[j] / (x - r[j]);
    }
    for (double& each : share) each /= sum;
    return share;
  }
};

/// The polynomials of a panel for all r; coefficients of one power are adjacent.
struct PanelOfEveryR {
  std::array<Weights, Panels::terms> c;
  bool refused = false;
};

double interpolated(const PanelOfEveryR& panel, double t, const Weights& share) {
  double m = 0;
  for (std::size_t n = Panels::terms; n-- > 0;) {
    double coefficient = 0;
    for (std::size_t j = 0; j < points_of_r; ++j) coefficient += share[j] * panel.c[n][j];
    m = m * t + coefficient;
  }
  return m;
}

bool ordinary_size(double x) { return x > 0x1p-300 && x < 0x1p300; }

}  // namespace

struct StopTimesOfMu::Stored {
  Stored(const Law& given, Inertia body) : unit(given, 1, body), panels(Panels::branches * Panels::per_branch) {
    for (std::size_t j = 0; j < points_of_r; ++j) {
      const Flow flow = at_r(at.r[j]);
      for_each_panel([&](std::size_t i) {
        const Panels::Panel fitted = fitted_panel(i, [&](double k) { return sliding_coefficient(flow, k); });
        for (std::size_t n = 0; n < Panels::terms; ++n) panels[i].c[n][j] = fitted.c[n];
      });
    }
    // Test at an r next to 0, and between points in the middle and at the end, where the interpolation is worst.
    for (double r : {1e-3 * at.r[0], (at.r[points_of_r / 2 - 1] + at.r[points_of_r / 2]) / 2,
                     (at.r[points_of_r - 2] + at.r[points_of_r - 1]) / 2})
      prove(r);
  }

  template <class Visit>
  static void for_each_panel(Visit visit) {
    for (std::size_t i = 0; i < Panels::branches * Panels::per_branch; ++i) {
      if (i % Panels::per_branch < Panels::used) visit(i);
    }
  }

  /// Returns the flow of this law with the given r. mu = 1 and chi = 1, because the result depends on r only.
  Flow at_r(double r) const { return ReducedSystem(unit.law(), 1, {.chi = 1, .gamma = r}); }

  void prove(double r) {
    const Flow flow = at_r(r);
    const Weights share = at.at(r);
    for_each_panel([&](std::size_t i) {
      for (double x : {0.01, 0.37, 0.85}) {
        const double k = ratio_in_panel(i, x);
        const auto [panel, t] = k < 1 ? place_in_panels(1, k) : place_in_panels(1 / k, 1);
        const double wanted = sliding_coefficient(flow, k);
        // An error of m enters the stop time with the factor S/(stop time).
        const double felt = 1 / (1 / (r * unit.law().pivoting_moment() * k) + wanted);
        if (!(std::abs(interpolated(panels[panel], t, share) - wanted) * felt <= allowed_error))
          panels[panel].refused = true;
      }
    });
  }

  double one(double mu, State start) const {
    return Flow(ReducedSystem(unit.law(), mu, unit.inertia())).stop_time(start).tau;
  }

  ReducedSystem unit;  ///< law and body, with mu = 1
  PointsOfR at;
  std::vector<PanelOfEveryR> panels;
};

StopTimesOfMu::StopTimesOfMu(const Law& law, Inertia body) : stored_(std::make_shared<const Stored>(law, body)) {}

double StopTimesOfMu::refused() const {
  double refused = 0;
  for (const PanelOfEveryR& panel : stored_->panels) refused += panel.refused ? 1 : 0;
  return refused / (Panels::branches * Panels::used);
}

double StopTimesOfMu::operator()(double mu, State start) const {
  const Stored& stored = *stored_;
  const double u = std::abs(start.u);
  const double w = mu * u;
  const auto [chi, gamma] = stored.unit.inertia();
  const double r = gamma * mu * mu / chi;
  const bool ordinary = r <= max_r && r > std::numeric_limits<double>::min() && ordinary_size(u) && ordinary_size(w) &&
                        ordinary_size(start.v);
  if (!ordinary) return stored.one(mu, start);
  const auto [index, t] = place_in_panels(w, start.v);
  const PanelOfEveryR& panel = stored.panels[index];
  if (panel.refused) return stored.one(mu, start);
  const double tau =
      stored.unit.pivoting_limit(u) / mu + stored.unit.sliding_limit(start.v) * interpolated(panel, t, stored.at.at(r));
  return std::isfinite(tau) ? tau : stored.one(mu, start);
}

}  // namespace contensou::reduction
