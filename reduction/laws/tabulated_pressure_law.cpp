// Notation (numerics.md (R48), (R49), (R56)): s = rho^2. A ring has the radius a and the load dL = pressure ds. q <= 1
// is the smaller of k and a divided by the larger; y = 1 - q^2. The ring has the force Phi dL and the moment a Psi dL,
// with
//   Phi = q A/2,  Psi = 1 - q^2 D  for k <= a;   Phi = 1 - q^2 D,  Psi = q A/2  for k >= a;   A, D: functions of y
#include "contensou/reduction/tabulated_pressure_law.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <boost/math/quadrature/gauss.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/laws.hpp"
#include "numerics/gauss_function.hpp"

namespace contensou::reduction {

namespace {

/// The functions A and D of a thin ring (Notation), of y = 1 - q^2. They are smooth except at y = 0. A table stores
/// polynomials of both.
///
/// A panel is a sixteenth of an octave of y, so its half width is at most 1/33 of its distance from y = 0. One more
/// panel, the first, begins at y = 0. Terms like y ln y are below the last bit there.
class RingFunctions {
 public:
  using Values = std::array<double, 2>;

  static const RingFunctions& table() {
    static const RingFunctions instance;
    return instance;
  }

  Values operator()(double y) const {
    // The exponent and first bits of the mantissa give the panel's number. The other bits give the place in the panel.
    constexpr int fraction_bits = 52;
    constexpr std::uint64_t fraction = (std::uint64_t{1} << fraction_bits) - 1;
    constexpr auto first = std::bit_cast<std::uint64_t>(lowest) >> (fraction_bits - cut_bits);
    const auto bits = std::bit_cast<std::uint64_t>(y);
    if (y < lowest) return polynomial(0, 2 / lowest * y - 1);
    if (y >= 1) return polynomial(panels - 1, 1);
    const double rest = std::bit_cast<double>((bits << cut_bits & fraction) | std::bit_cast<std::uint64_t>(1.0));
    return polynomial((bits >> (fraction_bits - cut_bits)) - first + 1, 2 * rest - 3);
  }

 private:
  static constexpr int terms = 9;
  static constexpr double lowest = 0x1p-60;
  static constexpr int cut_bits = 4;
  static constexpr int cuts = 1 << cut_bits;
  static constexpr int panels = 60 * cuts + 1;

  RingFunctions() : panels_(panels) {
    const GaussFunction weaker(0.5L, 0.5L, 2), stronger(-0.5L, 0.5L, 1);
    using Matrix = Eigen::Matrix<double, terms, terms>;
    using Rows = Eigen::Matrix<double, terms, 2, Eigen::RowMajor>;
    Eigen::Array<double, terms, 1> nodes;  // Chebyshev points
    for (int j = 0; j < terms; ++j) nodes[j] = std::cos(std::numbers::pi * (2 * j + 1) / (2 * terms));
    Matrix powers;
    for (int n = 0; n < terms; ++n) powers.col(n) = nodes.pow(terms - 1 - n);
    const Eigen::PartialPivLU<Matrix> solver(powers);
    for (int i = 0; i < panels; ++i) {
      const auto [left, right] = edges(i);
      Rows values;
      for (int j = 0; j < terms; ++j) {
        const double y = left + (right - left) / 2 * (1 + nodes[j]);
        values.row(j) << weaker(1 - y, y), stronger.deficit(1 - y, y);
      }
      const Rows coefficients = solver.solve(values);
      Eigen::Map<Rows>(panels_[static_cast<std::size_t>(i)].front().data()) = coefficients;
    }
  }

  /// Returns the edges of panel i; panel 0 is (0, lowest).
  static std::pair<double, double> edges(int i) {
    if (i == 0) return {0, lowest};
    const double octave = std::ldexp(lowest, (i - 1) / cuts);
    const double left = 1 + (i - 1) % cuts / double{cuts};
    return {octave * left, octave * (left + 1.0 / cuts)};
  }

  Values polynomial(std::size_t panel, double t) const {
    Values sum{};
    for (const auto& [a, d] : panels_[panel]) sum = {sum[0] * t + a, sum[1] * t + d};
    return sum;
  }

  std::vector<std::array<Values, terms>> panels_;  ///< powers of (distance from the centre)/(half width), highest first
};

/// The integrals of (R56) over rings whose radii are close to k; u = s/k^2 - 1.
class NearRings {
 public:
  /// Integrals over u, from 0, of Phi and of (a/k) Psi of a ring; and (again) the integrals of these integrals over u.
  struct Integrals {
    double force, force_again, moment, moment_again;
  };

  static Integrals at(double u) {
    static const NearRings instance;
    if (u == 0) return {0, 0, 0, 0};
    std::array<double, columns> sum{};
    // Powers u^n below 2^-56 are left out. 2^(-n distance) is a bound of u^n.
    const int distance = -std::ilogb(u);
    const std::size_t count = distance > 1 ? std::min<std::size_t>(terms, 56 / (distance - 1) + 2) : terms;
    for (const auto& coefficients : std::span(instance.powers_).last(count)) {
      for (std::size_t j = 0; j < columns; ++j) sum[j] = coefficients[j] - sum[j] * u;
    }
    const double log = std::log(std::abs(u));
    const auto [force, force_log, force_again, force_again_log, moment, moment_log, moment_again, moment_again_log] =
        sum;
    return {u * (force + force_log * log), u * u * (force_again + force_again_log * log),
            u * (moment + moment_log * log), u * u * (moment_again + moment_again_log * log)};
  }

 private:
  static constexpr std::size_t columns = 8;
  static constexpr int terms = 36;

  /// Coefficient of (-u)^n (plain + log ln|u|). The result of `integrated` leaves out a factor u.
  struct Term {
    double plain;
    double log;
    Term integrated(int n) const { return {plain / (n + 1) - log / ((n + 1) * (n + 1)), log / (n + 1)}; }
  };

  NearRings() {
    // Elliptic integrals of the parameter 1 - y: E = sum of y^n E_n, K = sum of y^n K_n.
    double square = 1;                   // ((1/2)_n/n!)^2
    double digamma = std::numbers::ln2;  // (psi(1 + n) - psi(1/2 + n))/2
    Term elliptic_e{1, 0};
    Term elliptic_k_before{0, 0};
    for (int n = 0; n < terms; ++n) {
      const Term force{elliptic_e.plain, elliptic_e.log};
      const Term moment{elliptic_e.plain - elliptic_k_before.plain, elliptic_e.log - elliptic_k_before.log};
      auto& column = powers_[static_cast<std::size_t>(terms - 1 - n)];
      std::size_t j = 0;
      for (const Term& term : {force, moment}) {
        const Term once = term.integrated(n);
        const Term twice = once.integrated(n + 1);
        for (double coefficient : {once.plain, once.log, twice.plain, twice.log}) {
          column[j++] = 2 / std::numbers::pi * coefficient;
        }
      }
      elliptic_k_before = {2 * square * digamma, -square / 2};
      const double between = 1.0 / ((2 * n + 1) * (2 * n + 2));
      const double product = square * (2 * n + 1) / (n + 1);  // (1/2)_n (3/2)_n/((2)_n n!)
      elliptic_e = {product * (digamma - between / 2), -product / 4};
      digamma -= between;
      square *= (n + 0.5) / (n + 1) * ((n + 0.5) / (n + 1));
    }
  }

  std::array<std::array<double, columns>, terms> powers_{};  ///< coefficients of powers of -u, highest first
};

struct Ring {
  double radius;
  double load;
};

/// A few rings that replace all rings between two radii: the points of a Gauss rule in s, weighted by the pressure.
using Rule = std::vector<Ring>;
constexpr int rule_order = 10;

/// The part of the patch between two rows of the table. In it the pressure divided by the whole load is linear in s.
struct Piece {
  double inner, outer;  ///< radii
  double inner_pressure, outer_pressure;

  double width() const { return (outer - inner) * (outer + inner); }  ///< difference of s
  double load() const { return (inner_pressure + outer_pressure) / 2 * width(); }
};

Rule rule_of(const Piece& piece) {
  using Gauss = boost::math::quadrature::gauss<double, rule_order>;
  Rule rule;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    for (double t : {-Gauss::abscissa()[i], Gauss::abscissa()[i]}) {
      const double fraction = (1 + t) / 2;
      const double radius = std::sqrt(piece.inner * piece.inner + fraction * piece.width());
      const double pressure = (1 - fraction) * piece.inner_pressure + fraction * piece.outer_pressure;
      rule.push_back(
          {std::clamp(radius, piece.inner, piece.outer), Gauss::weights()[i] / 2 * piece.width() * pressure});
    }
  }
  return rule;
}

/// Returns the Gauss rule that replaces two rules together, by Lanczos' recurrence.
Rule merged(const Rule& left, const Rule& right, double inner, double outer) {
  Rule all = left;
  all.insert(all.end(), right.begin(), right.end());
  const auto count = static_cast<Eigen::Index>(all.size());
  const double middle = std::sqrt((inner * inner + outer * outer) / 2);
  const double half = (outer - inner) * (outer + inner) / 2;
  Eigen::VectorXd place(count), vector(count);
  double load = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Ring& ring = all[static_cast<std::size_t>(i)];
    place[i] = (ring.radius - middle) * (ring.radius + middle) / half;
    vector[i] = std::sqrt(ring.load);
    load += ring.load;
  }
  vector.normalize();
  Eigen::MatrixXd basis(count, rule_order);
  Eigen::VectorXd diagonal(rule_order), beside(rule_order);
  Eigen::Index order = 0;
  while (order < std::min<Eigen::Index>(rule_order, count)) {
    basis.col(order) = vector;
    const Eigen::VectorXd next = place.cwiseProduct(vector);
    diagonal[order] = vector.dot(next);
    vector = next;
    for (int twice = 0; twice < 2; ++twice) {
      vector -= basis.leftCols(order + 1) * (basis.leftCols(order + 1).transpose() * vector);
    }
    beside[order] = vector.norm();
    ++order;
    if (!(beside[order - 1] > 1e-14)) break;  // the two rules have no further radius
    vector /= beside[order - 1];
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal.head(order), beside.head(order - 1));
  Rule rule;
  for (Eigen::Index i = 0; i < order; ++i) {
    const double radius = std::sqrt(middle * middle + half * solver.eigenvalues()[i]);
    const double fraction = solver.eigenvectors()(0, i) * solver.eigenvectors()(0, i);
    rule.push_back({std::clamp(radius, inner, outer), fraction * load});
  }
  return rule;
}

/// Neighbouring pieces. A Gauss rule replaces the pieces if k is at least one width of the block away from the block.
struct Block {
  double inner_square, outer_square, width;
  Rule rule;                   ///< empty if the block comes too near to the centre
  Piece piece;                 ///< the first piece
  double pivoting_moment = 0;  ///< moment of pure pivoting; only if the block has one piece
  std::size_t next;            ///< next block that is no part of this one; for a block of one piece the following block

  bool far_from(double square) const { return square <= inner_square - width || square >= outer_square + width; }
};

void require_table(const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure) {
  const auto reject = [](Eigen::Index row, const std::string& rule) {
    throw std::domain_error(fmt::format("TabulatedPressureLaw: row {}: {}", row + 1, rule));
  };
  if (rho.size() != pressure.size() || rho.size() < 2) {
    throw std::domain_error(fmt::format(
        "TabulatedPressureLaw: two or more rows are needed, got {} rho and {} pressures", rho.size(), pressure.size()));
  }
  const Eigen::Index last = rho.size() - 1;
  if (rho[0] != 0) reject(0, fmt::format("rho must begin at 0, got {}", rho[0]));
  for (Eigen::Index i = 0; i <= last; ++i) {
    if (i > 0 && !(rho[i] >= rho[i - 1])) reject(i, fmt::format("rho must not decrease, got {}", rho[i]));
    if (i > 0 && rho[i] == 0) reject(i, "rho = 0 must be in one row only");
    if (i > 1 && rho[i] == rho[i - 2]) {
      reject(i, fmt::format("no more than two rows, a step, may have the same rho, got {}", rho[i]));
    }
    if (!(pressure[i] >= 0) || !std::isfinite(pressure[i])) {
      reject(i, fmt::format("the pressure must be finite and >= 0, got {}", pressure[i]));
    }
  }
  if (rho[last] != 1) reject(last, fmt::format("rho must end at 1, got {}", rho[last]));
  if (!(pressure.maxCoeff() > 0)) throw std::domain_error("TabulatedPressureLaw: the pressure is 0 in every row");
}

/// Returns the rho of the sharpest bends: steps of the pressure, and changes of its slope in s above the mean slope.
std::vector<double> sharpest_bends(const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure) {
  constexpr std::size_t most = 32;
  struct Bend {
    double rho, sharpness;
  };
  std::vector<Bend> bends;
  const double largest = pressure.maxCoeff();
  const Eigen::Index last = rho.size() - 1;
  const auto slope = [&](Eigen::Index i) {
    if (i > last) return pressure[last] == 0 ? 0.0 : infinity;
    const double change = (pressure[i] - pressure[i - 1]) / largest;
    return change == 0 ? 0.0 : change / ((rho[i] - rho[i - 1]) * (rho[i] + rho[i - 1]));
  };
  for (Eigen::Index i = 1; i <= last; ++i) {
    const double before = slope(i), after = slope(i + 1);
    const double sharpness = before == after ? 0 : std::abs(after - before) * rho[i] * rho[i];
    if (sharpness > 1) bends.push_back({rho[i], sharpness});
  }
  std::ranges::sort(bends, std::greater{}, &Bend::sharpness);
  std::vector<double> kinks;
  for (std::size_t i = 0; i < std::min(bends.size(), most); ++i) kinks.push_back(bends[i].rho);
  std::ranges::sort(kinks);
  kinks.erase(std::unique(kinks.begin(), kinks.end()), kinks.end());
  return kinks;
}

}  // namespace

/// The patch: a disc inside the second row of the table, and rings around this disc.
class TabulatedPressureLaw::Rings {
 public:
  struct Sum {
    double force;
    double moment;
    double deficit;  ///< moment of pure pivoting minus moment
    double missing;  ///< load minus force
  };

  Rings(const Eigen::ArrayXd& given_rho, const Eigen::ArrayXd& given_pressure)
      : rho(given_rho), pressure(given_pressure) {
    std::vector<Piece> pieces;
    const Eigen::ArrayXd relative = pressure / pressure.maxCoeff();
    for (Eigen::Index i = 1; i < rho.size(); ++i) {
      if (rho[i] > rho[i - 1]) pieces.push_back({rho[i - 1], rho[i], relative[i - 1], relative[i]});
    }
    double load = 0;
    for (const Piece& piece : pieces) load += piece.load();
    if (!(load > 1e-100)) refuse_centre();
    for (Piece& piece : pieces) {
      piece.inner_pressure /= load;
      piece.outer_pressure /= load;
    }
    const Piece& middle = pieces.front();
    radius_ = middle.outer;
    flat_load_ = middle.outer_pressure * middle.width();
    round_load_ = (middle.inner_pressure - middle.outer_pressure) * middle.width() / 2;
    std::vector<Piece> cut;
    for (const Piece& piece : std::span(pieces).subspan(1)) add_narrow_parts(piece, cut);
    if (!cut.empty()) add_blocks(cut);
    const Sum sliding = sum(infinity);
    const Sum pivoting = sum(0);
    load_ = sliding.force;
    pivoting_moment_ = pivoting.moment;
    // Curves are sampled from k = 4e-18 on. For smaller k the library treats Phi as linear.
    constexpr double slow = 0x1p-57;
    constexpr double slower = 0x1p-100;
    if (!(std::abs(sum(slow).force * (slower / slow) / sum(slower).force - 1) < 1e-13)) refuse_centre();
  }

  Resistance resistance(double k) const {
    const Sum of_all = sum(k);
    return {std::min(of_all.force / load_, 1.0), of_all.moment / load_};
  }

  double moment_deficit(double k) const { return sum(k).deficit / pivoting_moment_; }
  double force_deficit(double k) const { return sum(k).missing / load_; }

  Eigen::ArrayXd rho, pressure;  ///< the table

 private:
  [[noreturn]] static void refuse_centre() {
    throw std::runtime_error(
        "TabulatedPressureLaw: rows within rho = 1e-11 decide how the patch resists slow sliding, and no k >= 4e-18 "
        "tells how; if the pressure is 0 farther out, take the radius of the loaded part as that of the patch");
  }

  static void add_narrow_parts(const Piece& piece, std::vector<Piece>& parts) {
    constexpr double widest = 1.06;  // ratio of the radii
    constexpr double faint = 1e-200;
    if (!(piece.load() > faint)) return;
    const double octaves = std::log(piece.outer / piece.inner) / std::log(widest);
    const int count = std::max(1, static_cast<int>(std::ceil(octaves)));
    Piece part = piece;
    for (int i = 1; i <= count; ++i) {
      part.outer = i == count ? piece.outer : piece.inner * std::pow(piece.outer / piece.inner, double(i) / count);
      const double fraction = (part.outer - piece.inner) * (part.outer + piece.inner) / piece.width();
      part.outer_pressure =
          i == count ? piece.outer_pressure : (1 - fraction) * piece.inner_pressure + fraction * piece.outer_pressure;
      if (part.load() > faint) parts.push_back(part);
      part.inner = part.outer;
      part.inner_pressure = part.outer_pressure;
    }
  }

  /// Appends the block of these pieces, then the blocks of the two halves of these pieces.
  void add_blocks(std::span<const Piece> pieces) {
    const double inner = pieces.front().inner;
    const double outer = pieces.back().outer;
    const std::size_t here = blocks_.size();
    blocks_.push_back(
        {inner * inner, outer * outer, (outer - inner) * (outer + inner), {}, pieces.front(), 0, here + 1});
    if (pieces.size() == 1) {
      Block& block = blocks_[here];
      block.rule = rule_of(pieces.front());
      for (const auto& [radius, load] : block.rule) block.pivoting_moment += load * radius;
      return;
    }
    const double middle = (inner * inner + outer * outer) / 2;
    const auto beyond = std::ranges::lower_bound(pieces, middle, {}, [](const Piece& p) { return p.inner * p.inner; });
    const auto half = std::clamp<std::ptrdiff_t>(beyond - pieces.begin(), 1, std::ssize(pieces) - 1);
    add_blocks(pieces.first(static_cast<std::size_t>(half)));
    const std::size_t second = blocks_.size();
    add_blocks(pieces.subspan(static_cast<std::size_t>(half)));
    Block& block = blocks_[here];
    block.next = blocks_.size();
    if (block.outer_square <= 2 * block.inner_square) {
      block.rule = merged(blocks_[here + 1].rule, blocks_[second].rule, inner, outer);
    }
  }

  Sum sum(double k) const {
    Sum total = disc(k);
    const double square = k * k;
    for (std::size_t i = 0; i < blocks_.size();) {
      const Block& block = blocks_[i];
      if (!block.rule.empty() && block.far_from(square)) {
        add_far(block.rule, k, total);
        i = block.next;
      } else {
        if (block.next == i + 1) add_near(block.piece, block.pivoting_moment, k, total);
        ++i;
      }
    }
    return total;
  }

  /// Returns the sum over the disc inside the second row, the sum of a uniform disc and a paraboloid.
  Sum disc(double k) const {
    static const PressureLaw flat = PressureLaw::uniform(), round(1);
    Sum total{0, 0, 0, 0};
    const Slip slip = k <= radius_ ? Slip{k / radius_, 1} : Slip{1, radius_ / k};
    for (const auto& [law, load] : {std::pair{&flat, flat_load_}, {&round, round_load_}}) {
      if (load == 0) continue;
      const auto [force, moment] = (*law)(slip);
      total.force += load * force;
      total.moment += load * radius_ * moment;
      total.deficit += load * radius_ * ((*law)({0, 1}).moment * law->moment_deficit(slip));
      total.missing += load * law->force_deficit(slip);
    }
    return total;
  }

  static void add_far(const Rule& rule, double k, Sum& total) {
    const RingFunctions& functions = RingFunctions::table();
    const bool inside = k <= rule.front().radius;  // k lies within all rings, else outside all
    for (const auto& [radius, load] : rule) {
      const double q = inside ? k / radius : radius / k;
      const auto [a, d] = functions((1 - q) * (1 + q));
      const double half = q / 2 * a, loss = q * q * d;
      total.force += load * (inside ? half : 1 - loss);
      total.missing += load * (inside ? 1 - half : loss);
      total.moment += load * radius * (inside ? 1 - loss : half);
      total.deficit += load * radius * (inside ? loss : 1 - half);
    }
  }

  static void add_near(const Piece& piece, double pivoting_moment, double k, Sum& total) {
    const double square = k * k;
    const double width = piece.width() / square;
    const auto inner = NearRings::at((piece.inner - k) * (piece.inner + k) / square);
    const auto outer = NearRings::at((piece.outer - k) * (piece.outer + k) / square);
    const auto mean = [&](double inner_once, double inner_twice, double outer_once, double outer_twice) {
      const double change = outer_twice - inner_twice;
      return (piece.inner_pressure * (change - width * inner_once) +
              piece.outer_pressure * (width * outer_once - change)) /
             width * square;
    };
    const double moment = k * mean(inner.moment, inner.moment_again, outer.moment, outer.moment_again);
    const double force = mean(inner.force, inner.force_again, outer.force, outer.force_again);
    total.force += force;
    total.missing += piece.load() - force;
    total.moment += moment;
    // Psi is nearly 2/pi, its value at k = a, so this difference loses no digits.
    total.deficit += pivoting_moment - moment;
  }

  double radius_ = 1;
  double flat_load_ = 0;
  double round_load_ = 0;
  std::vector<Block> blocks_;  ///< each block is followed by its parts
  double load_ = 1;
  double pivoting_moment_ = 0;
};

TabulatedPressureLaw::TabulatedPressureLaw(std::string name, const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure)
    : name_(std::move(name)) {
  require_table(rho, pressure);
  kinks_ = sharpest_bends(rho, pressure);
  rings_ = std::make_shared<const Rings>(rho, pressure);
}

Eigen::Index TabulatedPressureLaw::rows() const { return rings_->rho.size(); }

std::optional<TabulatedPressureLaw> TabulatedPressureLaw::coarser() const {
  const auto& [rho, pressure] = std::tie(rings_->rho, rings_->pressure);
  const Eigen::Index last = rho.size() - 1;
  std::vector<Eigen::Index> kept;
  bool before_stays = false;
  for (Eigen::Index i = 0; i <= last; ++i) {
    const bool at_step = (i > 0 && rho[i] == rho[i - 1]) || (i < last && rho[i] == rho[i + 1]);
    const bool stays = i == 0 || i == last || at_step || !before_stays;
    if (stays) kept.push_back(i);
    before_stays = stays;
  }
  if (std::ssize(kept) == rho.size()) return std::nullopt;
  const Eigen::ArrayXd fewer = pressure(kept);
  if (!(fewer.maxCoeff() > 0)) return std::nullopt;
  return TabulatedPressureLaw(name_, rho(kept), fewer);
}

Resistance TabulatedPressureLaw::operator()(Slip slip) const {
  require_slip("TabulatedPressureLaw", slip);
  return rings_->resistance(slip.sliding / slip.pivoting);
}

double TabulatedPressureLaw::moment_deficit(Slip slip) const {
  require_slip("TabulatedPressureLaw", slip);
  return rings_->moment_deficit(slip.sliding / slip.pivoting);
}

double TabulatedPressureLaw::force_deficit(Slip slip) const {
  require_slip("TabulatedPressureLaw", slip);
  return rings_->force_deficit(slip.sliding / slip.pivoting);
}

}  // namespace contensou::reduction
