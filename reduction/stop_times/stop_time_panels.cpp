// Notation (README (R18) to (R20)): n = m - 1, so that tau* = P + S (1 + n) = D G, D = |u0| + lever v0,
//     G = (P/|u0|) [|u0|/D + l (1 + n) lever v0/D],  l = S/P where v0 = |u0|/lever
//   Pade, r < 2:  y = A/(A + B k) = |u0|/D, x = 1 - y, a = r/(2 - r), e = r/(5 - r), 1/(mu lever) = A/B
//     x y dn/dx + [(1 + a) y + (1 + e) x] n = (3/2)(1 + a) y
//   any law:  drag dn/d ln k + Phi n = delta - Phi,  drag = Phi - r k Psi,  delta = 1 - Psi/Psi(0), 1/(mu lever) = 1
// On a panel y = left + width (1 + t)/2, -1 <= t <= 1; the y of a start is less by `lowest`.
#include "stop_times/stop_time_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <Eigen/Core>
#include <Eigen/LU>

#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;
using Panel = Panels::Panel;
using Values = Eigen::Matrix<double, Panels::terms, 1>;
using Matrix = Eigen::Matrix<double, Panels::terms, Panels::terms>;
using WideValues = Eigen::Matrix<long double, Panels::terms, 1>;
using WideMatrix = Eigen::Matrix<long double, Panels::terms, Panels::terms>;

constexpr long double pi = std::numbers::pi_v<long double>;

/// Polynomials in t through their values at Chebyshev's points.
struct Interpolation {
  WideValues points;
  WideMatrix coefficients;         ///< of powers of t, from values
  Matrix derivative;               ///< values of the derivative, from values
  std::array<Matrix, 2> integral;  ///< values of the integral from t = -1 and from t = 1, from values
  std::array<Values, 2> end;       ///< the value at t = -1 and at t = 1
  Values whole;                    ///< the integral from -1 to 1

  Interpolation() {
    constexpr int terms = Panels::terms;
    WideMatrix powers, slopes;
    std::array<WideMatrix, 2> integrals;
    std::array<WideValues, 2> ends;
    WideValues total;
    for (int i = 0; i < terms; ++i) points[i] = -std::cos(pi * (2 * i + 1) / (2 * terms));
    for (int n = 0; n < terms; ++n) {
      const auto power = [&](int exponent) { return points.array().pow(static_cast<long double>(exponent)).matrix(); };
      const long double at_end = 1.0L / (n + 1);
      const long double sign = n % 2 == 0 ? 1 : -1;
      powers.col(n) = power(n);
      slopes.col(n) = n == 0 ? WideValues(WideValues::Zero()) : WideValues(n * power(n - 1));
      integrals[0].col(n) = (power(n + 1) * at_end).array() + sign * at_end;
      integrals[1].col(n) = (power(n + 1) * at_end).array() - at_end;
      total[n] = (1 + sign) * at_end;
      ends[0][n] = sign;
      ends[1][n] = 1;
    }
    coefficients = powers.partialPivLu().inverse();
    derivative = (slopes * coefficients).cast<double>();
    for (std::size_t side : {0U, 1U}) {
      integral[side] = (integrals[side] * coefficients).cast<double>();
      end[side] = (coefficients.transpose() * ends[side]).cast<double>();
    }
    whole = (coefficients.transpose() * total).cast<double>();
  }

  static const Interpolation& chebyshev() {
    static const Interpolation instance;
    return instance;
  }
};

/// In long double: the coefficients of a smooth function are small sums of large terms.
Panel panel_through(const WideValues& values, double width) {
  const auto& polynomials = Interpolation::chebyshev();
  // A constant apart, then powers of t, then of 1 + t.
  const long double constant = values[0];
  WideValues c = polynomials.coefficients * (values.array() - constant).matrix();
  for (int n = 0; n + 1 < Panels::terms; ++n) {
    for (int j = Panels::terms - 2; j >= n; --j) c[j] -= c[j + 1];
  }
  c[0] += constant;
  Panel panel{};
  long double unit = 1;
  for (int n = 0; n < Panels::terms; ++n, unit *= width / 2.0L) panel.of_power(n) = static_cast<double>(c[n] / unit);
  return panel;
}

/// n of the Pade curve for r < 2, by Taylor series from y = 1 down.
class PadeMarch {
 public:
  explicit PadeMarch(long double r) : a_(r / (2 - r)), e_(r / (5 - r)) {
    near_[0] = 1.5L;
    for (int j = 1; j < near_terms; ++j) {
      const long double source = j == 1 ? -1.5L * (1 + a_) : 0;
      near_[j] = ((j - 1 + a_ - e_) * near_[j - 1] + source) / (j + 1 + a_);
    }
  }

  /// The next panel's centre; the first time, one at which the series at y = 1 converges.
  void move_to(double centre) {
    const long double value = centre_ == 0 ? near(centre) : series(centre - centre_);
    centre_ = centre;
    // y (1 - y) and (1 + e) + (a - e) y in powers of y - centre.
    const long double c = centre_;
    const long double q1 = a_ - e_;
    const long double q0 = 1 + e_ + q1 * c;
    const long double source = 1.5L * (1 + a_);
    far_[0] = value;
    far_[1] = (q0 * far_[0] - source * c) / (c * (1 - c));
    for (int j = 1; j + 1 < far_terms; ++j) {
      const long double sum = (q0 - (1 - 2 * c) * j) * far_[j] + (q1 + (j - 1)) * far_[j - 1] - (j == 1 ? source : 0);
      far_[j + 1] = sum / (c * (1 - c) * (j + 1));
    }
  }

  long double near(long double y) const { return polynomial(near_, 1 - y); }
  long double series(long double t) const { return polynomial(far_, t); }

 private:
  static constexpr int near_terms = 72;  // x <= 1/2
  static constexpr int far_terms = 16;   // |t| <= y/16

  template <std::size_t terms>
  static long double polynomial(const std::array<long double, terms>& coefficients, long double t) {
    long double sum = 0;
    for (std::size_t n = terms; n-- > 0;) sum = sum * t + coefficients[n];
    return sum;
  }

  long double a_, e_;
  long double centre_ = 0;
  std::array<long double, near_terms> near_{};
  std::array<long double, far_terms> far_{};
};

}  // namespace

long double pade_fold(long double r) { return 8 * (2 - r) / (3 * pi * (5 - r)); }

std::vector<Panel> pade_panels(long double r, long double fold, const PanelScales& scales) {
  PadeMarch march(r);
  const auto [l, unit] = scales;
  const long double unfold = pade_fold(r) / fold - 1;
  std::vector<Panel> panels(Panels::per_sheet);
  for (std::size_t i = Panels::at_one + 1; i-- > 0;) {
    const auto [left, width] = Panels::span(i);
    const bool near = left >= 0.5;
    if (!near) march.move_to(left + width / 2);
    WideValues values;
    for (int j = 0; j < Panels::terms; ++j) {
      const long double pivoting = left - Panels::lowest + width / 2 * (1 + Interpolation::chebyshev().points[j]);
      const long double y = pivoting + unfold * pivoting * (1 - pivoting);
      const long double n = near ? march.near(y) : march.series(y - (left + width / 2));
      values[j] = (pivoting + l * (1 + n) * (1 - pivoting)) / unit;
    }
    panels[i] = panel_through(values, width);
  }
  return panels;
}

namespace {

/// A fraction y on a sheet as a ratio of slips.
struct Place {
  Slip slip;  ///< the larger speed is 1
  double k;
  double log_slope;  ///< d ln k/dy
};
Place place(Panels::Sheet sheet, double y) {
  switch (sheet) {
    case Panels::slow:
      return {{y / (1 - y), 1}, y / (1 - y), 1 / (y * (1 - y))};
    case Panels::below_one:
      return {{(1 - y) / (1 + y), 1}, (1 - y) / (1 + y), -2 / ((1 - y) * (1 + y))};
    case Panels::above_one:
      return {{1, (1 - y) / (1 + y)}, (1 + y) / (1 - y), 2 / ((1 - y) * (1 + y))};
    case Panels::fast:
      break;
  }
  return {{1, y / (1 - y)}, (1 - y) / y, -1 / (y * (1 - y))};
}

/// |u0|/D and lever v0/D of a fraction y.
struct Shares {
  long double pivoting, sliding;
};
Shares shares(Panels::Sheet sheet, long double y) {
  switch (sheet) {
    case Panels::slow:
      return {1 - y, y};
    case Panels::below_one:
      return {(1 + y) / 2, (1 - y) / 2};
    case Panels::above_one:
      return {(1 - y) / 2, (1 + y) / 2};
    case Panels::fast:
      break;
  }
  return {y, 1 - y};
}

/// The solution of (R19) on every panel of four sheets.
class LawMarch {
 public:
  LawMarch(const Law& law, double r, const PanelScales& scales)
      : law_(law), r_(r), scales_(scales), panels_(4 * Panels::per_sheet), ends_(panels_.size()) {
    const auto [regime, k, low, high] = terminal_ratio(law, r);
    terminal_ = k;
    if (regime == TerminalRegime::ray) {
      for (Panels::Sheet sheet : {Panels::slow, Panels::below_one, Panels::above_one, Panels::fast}) {
        for (std::size_t i = 0; i <= last; ++i) {
          if (side_of_terminal({sheet, i}) == 0) solve_across({sheet, i});
        }
      }
    }
    if (regime != TerminalRegime::infinity) march(1);
    if (regime != TerminalRegime::zero) march(-1);
  }

  std::vector<Panel> panels() && { return std::move(panels_); }

 private:
  struct Position {
    Panels::Sheet sheet;
    std::size_t index;
  };

  /// The panel from y = 21/64 to 22/64: y is at most 1/3.
  static constexpr std::size_t last = Panels::at_one - 2 * (std::size_t{1} << Panels::cut_bits) + 5;

  static std::size_t number(Position at) { return at.sheet * Panels::per_sheet + at.index; }

  /// The law at the points of a panel, with what turns d/d ln k into d/dt.
  struct Sampled {
    Values drag;
    Values force;   ///< Phi times d ln k/dt
    Values source;  ///< (delta - Phi) times d ln k/dt
    bool lost;      ///< it is lost in rounding: (R19) without its derivative
  };
  Sampled sampled(Position at) const {
    Sampled values;
    const auto [left, width] = Panels::span(at.index);
    values.lost = true;
    const Values points = Interpolation::chebyshev().points.cast<double>();
    for (int j = 0; j < Panels::terms; ++j) {
      const auto [slip, k, log_slope] = place(at.sheet, left + width / 2 * (1 + points[j]));
      const auto [force, moment] = law_(slip);
      const double least = law_.pivoting_moment() / 2;
      const double deficit = moment < least ? 1 - moment / law_.pivoting_moment() : law_.moment_deficit(slip);
      const double rate = width / 2 * log_slope;
      values.drag[j] = force - r_ * (k * moment);
      values.lost = values.lost && std::abs(values.drag[j]) < 0x1p-44 * force;
      values.force[j] = rate * force;
      values.source[j] = rate * (deficit - force);
    }
    return values;
  }

  /// -1, 0 or 1: the panel lies below the terminal ratio, across it, or above.
  int side_of_terminal(Position at) const {
    const auto [left, width] = Panels::span(at.index);
    const double k = place(at.sheet, left).k;
    const double other_k = place(at.sheet, left + width).k;
    if (std::max(k, other_k) < terminal_) return -1;
    return std::min(k, other_k) > terminal_ ? 1 : 0;
  }

  /// The one solution that is regular where the drag is 0.
  void solve_across(Position at) {
    const Sampled law = sampled(at);
    const auto& polynomials = Interpolation::chebyshev();
    Matrix system = law.drag.asDiagonal() * polynomials.derivative;
    system.diagonal() += law.force;
    const Values n = system.partialPivLu().solve(law.source);
    keep(at, n);
    ends_[number(at)] = {polynomials.end[0].dot(n), polynomials.end[1].dot(n)};
  }

  /// The solution with a given value at one end: side 0 is t = -1, side 1 is t = 1.
  void solve_from(Position at, int side, long double value) {
    const Sampled law = sampled(at);
    if (law.lost) {
      solve_across(at);
      return;
    }
    const auto& polynomials = Interpolation::chebyshev();
    const auto start = static_cast<double>(value);
    // drag dn/dt + force n = source, for the values of dn/dt.
    Matrix system = law.force.asDiagonal() * polynomials.integral[static_cast<std::size_t>(side)];
    system.diagonal() += law.drag;
    const Values slope = system.partialPivLu().solve(law.source - start * law.force);
    const Values n = (polynomials.integral[static_cast<std::size_t>(side)] * slope).array() + start;
    keep(at, n);
    const double rise = polynomials.whole.dot(slope);
    ends_[number(at)] = side == 0 ? Ends{value, value + rise} : Ends{value - rise, value};
  }

  void keep(Position at, const Values& n) {
    const auto [left, width] = Panels::span(at.index);
    const auto [l, unit] = scales_;
    WideValues values;
    for (int j = 0; j < Panels::terms; ++j) {
      const long double y = left + width / 2 * (1 + Interpolation::chebyshev().points[j]) - Panels::lowest;
      const auto [pivoting, sliding] = shares(at.sheet, y);
      values[j] = (pivoting + l * (1 + static_cast<long double>(n[j])) * sliding) / unit;
    }
    panels_[number(at)] = panel_through(values, width);
  }

  /// Towards larger k for direction 1, the panels above the terminal ratio; the mirror image for -1.
  void march(int direction) {
    const auto mirrored = [&](int sheet) { return static_cast<Panels::Sheet>(direction > 0 ? sheet : 3 - sheet); };
    const auto step = [&](int sheet, std::size_t index, int side, int from_sheet, std::size_t from, int from_side) {
      const Position at{mirrored(sheet), index};
      if (side_of_terminal(at) != direction) return;
      const auto& ends = ends_[number({mirrored(from_sheet), from})];
      solve_from(at, side, from_side == 0 ? ends.left : ends.right);
    };
    if (side_of_terminal({mirrored(0), 0}) == direction) {
      const auto [slip, k, log_slope] = place(mirrored(0), Panels::lowest);
      const auto [force, moment] = law_(slip);
      solve_from({mirrored(0), 0}, 0, law_.moment_deficit(slip) / force - 1);
    }
    // y = 21/64 on the first sheet is 22/64 on the second; 20/64 on the third is 22/64 on the fourth.
    for (std::size_t i = 1; i <= last; ++i) step(0, i, 0, 0, i - 1, 1);
    step(1, last, 1, 0, last - 1, 1);
    for (std::size_t i = last; i-- > 0;) step(1, i, 1, 1, i + 1, 0);
    step(2, 0, 0, 1, 0, 0);
    for (std::size_t i = 1; i <= last; ++i) step(2, i, 0, 2, i - 1, 1);
    step(3, last, 1, 2, last - 2, 1);
    for (std::size_t i = last; i-- > 0;) step(3, i, 1, 3, i + 1, 0);
  }

  /// n at the ends of a panel; in long double, for near k = 1 it grows by less than the last bit from one to the next.
  struct Ends {
    long double left;
    long double right;
  };

  const Law& law_;
  double r_;
  PanelScales scales_;
  double terminal_ = 0;
  std::vector<Panel> panels_;
  std::vector<Ends> ends_;
};

}  // namespace

std::vector<Panel> law_panels(const Law& law, double r, const PanelScales& scales) {
  return LawMarch(law, r, scales).panels();
}

}  // namespace contensou::reduction
