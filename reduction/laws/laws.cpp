#include "contensou/reduction/laws.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <boost/math/special_functions/gamma.hpp>

#include "contensou/reduction/tabulated_pressure_law.hpp"
#include "numerics/gauss_function.hpp"

namespace contensou::reduction {

using std::numbers::pi;

Resistance PadeLaw::operator()(Slip slip) const {
  require_slip("PadeLaw", slip);
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    return {3 * pi * k / (8 + 3 * pi * k), 3 * pi / (16 + 15 * pi * k)};
  }
  const double inverse_k = slip.pivoting / slip.sliding;
  return {3 * pi / (8 * inverse_k + 3 * pi), 3 * pi * inverse_k / (16 * inverse_k + 15 * pi)};
}

double PadeLaw::moment_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    return 15 * pi * k / (16 + 15 * pi * k);
  }
  return 15 * pi / (16 * (slip.pivoting / slip.sliding) + 15 * pi);
}

double PadeLaw::force_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) return 8 / (8 + 3 * pi * (slip.sliding / slip.pivoting));
  const double inverse_k = slip.pivoting / slip.sliding;
  return 8 * inverse_k / (8 * inverse_k + 3 * pi);
}

EllipticLaw::EllipticLaw(double moment) : moment_(moment) {
  if (moment >= min_moment && moment <= 1) return;
  throw std::domain_error(fmt::format("EllipticLaw: the moment C must be from {} to 1, got {}", min_moment, moment));
}

std::string EllipticLaw::name() const {
  return moment_ == hertz_moment ? "elliptic" : fmt::format("elliptic:{}", moment_);
}

Resistance EllipticLaw::operator()(Slip slip) const {
  require_slip("EllipticLaw", slip);
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    const double root = std::sqrt(k * k + moment_ * moment_);
    return {k / root, moment_ * (moment_ / root)};
  }
  const double inverse_k = slip.pivoting / slip.sliding;
  const double rim = moment_ * inverse_k;
  const double root = std::sqrt(1 + rim * rim);
  return {1 / root, moment_ * (rim / root)};
}

double EllipticLaw::moment_deficit(Slip slip) const {
  if (slip.sliding > slip.pivoting) return 1 - (*this)(slip).moment / moment_;
  require_slip("EllipticLaw", slip);
  const double k = slip.sliding / slip.pivoting;
  const double root = std::sqrt(k * k + moment_ * moment_);
  return k / root * (k / (root + moment_));
}

double EllipticLaw::force_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) return 1 - (*this)(slip).force;
  require_slip("EllipticLaw", slip);
  const double rim = moment_ * (slip.pivoting / slip.sliding);
  const double root = std::sqrt(1 + rim * rim);
  return rim / root * (rim / (1 + root));
}

namespace {

struct NamedLaw {
  std::string_view name;
  std::string_view meaning;
  Law (*law)();
};

constexpr std::array laws_with_meaning{
    NamedLaw{"exact", "pressure of Hertz, (1 - rho^2)^(1/2)", []() -> Law { return HertzLaw{}; }},
    NamedLaw{"pade", "approximation of exact by V. F. Zhuravlev (1998)", []() -> Law { return PadeLaw{}; }},
    NamedLaw{"uniform", "uniform pressure over the patch", []() -> Law { return PressureLaw::uniform(); }},
    NamedLaw{"punch", "pressure of a flat rigid punch, (1 - rho^2)^(-1/2)",
             []() -> Law { return PressureLaw::punch(); }},
    NamedLaw{"ring", "pressure on the rim alone", []() -> Law { return PressureLaw::ring(); }},
    NamedLaw{"paraboloid", "pressure of a soft foundation, 1 - rho^2",
             []() -> Law { return PressureLaw::paraboloid(); }},
    NamedLaw{"elliptic", "ellipse as limit surface, with the Psi(0) of exact; used for grasping and in physics engines",
             []() -> Law { return EllipticLaw{}; }},
};

const NamedLaw* named(std::string_view name) {
  const auto* found = std::ranges::find(laws_with_meaning, name, &NamedLaw::name);
  return found == laws_with_meaning.end() ? nullptr : found;
}

/// Returns the law of a patch whose pressure is uniform outside eta times the patch radius, and 0 inside.
Law annulus(double eta) {
  const Eigen::ArrayXd rho = (Eigen::ArrayXd(4) << 0, eta, eta, 1).finished();
  const Eigen::ArrayXd pressure = (Eigen::ArrayXd(4) << 0, 0, 1, 1).finished();
  return TabulatedPressureLaw(fmt::format("annulus:{}", eta), rho, pressure);
}

/// Returns the law of the pressure (1 - rho^K)^(1/K) (N. Xydas, I. Kao, doi:10.1177/02783649922066673) as a table. The
/// points lie closest at the rim, where the pressure is steep. The errors of Phi and Psi are below 4e-7.
Law soft(double exponent) {
  const Eigen::ArrayXd rho = Eigen::ArrayXd::LinSpaced(2001, 0, std::numbers::pi / 2).sin();
  Eigen::ArrayXd pressure = (1 - rho.pow(exponent)).max(0).pow(1 / exponent);
  pressure.tail<1>() = 0;
  return TabulatedPressureLaw(fmt::format("soft:{}", exponent), rho, pressure);
}

Law member(const LawFamily& family, std::string_view typed) {
  double number = 0;
  const std::size_t plus = typed.starts_with("+") && !typed.starts_with("+-") ? 1 : 0;
  const auto [end, error] = std::from_chars(typed.data() + plus, typed.data() + typed.size(), number);
  if (error != std::errc() || end != typed.data() + typed.size() || !std::isfinite(number)) {
    throw std::domain_error(fmt::format("'{}' is not a number; {} of {} is needed, as in {}:{}", typed, family.letter,
                                        family.meaning, family.name, family.example));
  }
  if (!(number >= family.min && number <= family.max)) {
    throw std::domain_error(fmt::format("{} is required", family.allowed));
  }
  return family.law(number);
}

}  // namespace

const std::vector<Law>& paper_laws() {
  static const std::vector<Law> laws{HertzLaw{}, PadeLaw{}};
  return laws;
}

std::vector<std::string_view> names_of_laws() {
  std::vector<std::string_view> names;
  for (const NamedLaw& law : laws_with_meaning) names.push_back(law.name);
  return names;
}

const std::vector<Law>& named_laws() {
  static const std::vector<Law> laws = [] {
    std::vector<Law> list;
    for (const NamedLaw& each : laws_with_meaning) list.push_back(*find_law(each.name));
    return list;
  }();
  return laws;
}

std::string_view meaning_of_law(std::string_view name) {
  const NamedLaw* found = named(name);
  return found == nullptr ? "" : found->meaning;
}

const std::vector<LawFamily>& law_families() {
  static const std::vector<LawFamily> families{
      {"pressure", "P", "pressure (1 - rho^2)^P", "-1 < P <= 25 (the limit P -> -1 is the law ring)", 0.5,
       std::nextafter(-1.0, 0.0), PressureLaw::max_p, [](double p) -> Law { return PressureLaw(p); }},
      {"annulus", "ETA", "uniform pressure between ETA and 1 times the patch radius",
       "0 < ETA <= 0.999 (0 is the law uniform)", 0.65, std::numeric_limits<double>::min(), 0.999, annulus},
      {"soft", "K", "pressure of a soft finger, (1 - rho^K)^(1/K), as a table of 2001 points",
       "1 <= K <= 50 (2 is the law exact, 50 nearly uniform)", 4, 1, 50, soft},
      {"elliptic", "C", "ellipse as limit surface, with Psi(0) = C", "0.001 <= C <= 1", 0.6, EllipticLaw::min_moment, 1,
       [](double c) -> Law { return EllipticLaw(c); }},
  };
  return families;
}

std::optional<Law> find_law(std::string_view name) {
  static std::mutex guard;
  static std::map<std::string, Law, std::less<>> kept;  // the tables of a law take up to 1 ms
  constexpr std::size_t most = 64;
  const std::scoped_lock lock(guard);
  if (const auto found = kept.find(name); found != kept.end()) return found->second;
  const std::string_view before = name.substr(0, name.find(':'));
  const auto family = std::ranges::find(law_families(), before, &LawFamily::name);
  const bool is_member = before != name && family != law_families().end();
  const NamedLaw* const found = named(name);
  if (!is_member && found == nullptr) return std::nullopt;
  const Law law = is_member ? member(*family, name.substr(before.size() + 1)) : found->law();
  if (kept.size() == most) kept.clear();
  return kept.emplace(name, law).first->second;
}

// Notation and closed forms of V. F. Zhuravlev, 1998 (Zh98), section 1:
//   k = sliding/pivoting,  Phi = F/(N f),  Psi = M/(N f eps),  theta* = asin(1/k),  eps: patch radius
//
//   k <= 1:  Phi = (3 pi/32) k (4 - k^2)
//            Psi = (3 pi/128) (8 - 8 k^2 + 3 k^4)
//   k >= 1:  Phi = (3/(16 k)) [k^2 (4 - k^2) theta* + (k^2 + 2) sqrt(k^2 - 1)]              (1.3)
//            Psi = (3/64) [(8 - 8 k^2 + 3 k^4) theta* + 3 (2 - k^2) sqrt(k^2 - 1)]          (1.5)
//          = 2F1(-1/2, 1/2; 5/2; k^-2)  and  2F1(1/2, 1/2; 7/2; k^-2)/(5 k)
namespace {

/// Below this k the printed form is accurate to 7e-16. At this k the series needs 56 terms, at larger k fewer terms.
constexpr double series_from = 1.25;
constexpr std::size_t hertz_series_terms = 64;

/// Returns the Taylor coefficients of 2F1(a, b; c; x); each coefficient is rounded once.
constexpr std::array<double, hertz_series_terms> gauss_coefficients(long double a, long double b, long double c) {
  std::array<double, hertz_series_terms> coefficients{};
  long double coefficient = 1;
  for (std::size_t n = 0; n < hertz_series_terms; ++n) {
    coefficients[n] = static_cast<double>(coefficient);
    const auto i = static_cast<long double>(n);
    coefficient *= (a + i) * (b + i) / ((c + i) * (1 + i));
  }
  return coefficients;
}

constexpr auto force_series = gauss_coefficients(-0.5, 0.5, 2.5);
constexpr auto moment_series = gauss_coefficients(0.5, 0.5, 3.5);

/// Returns the number of terms of a series that are not negligible at x.
std::size_t terms_at(double x) {
  std::size_t terms = 1;
  for (double power = x; power > 1e-18 && terms < hertz_series_terms; power *= x) ++terms;
  return terms;
}

Resistance fast_sliding(double inverse_k) {
  const double x = inverse_k * inverse_k;
  const std::size_t terms = terms_at(x);
  double force = 0;
  double moment = 0;
  for (std::size_t n = terms; n-- > 0;) {  // sum the smallest terms first, for the least rounding
    force = force * x + force_series[n];
    moment = moment * x + moment_series[n];
  }
  return {force, moment * inverse_k / 5};
}

Resistance just_outside(double k) {
  const double s = k * k;
  const double root = std::sqrt((k - 1) * (k + 1));
  const double angle = std::atan2(1, root);  // asin(1/k) would lose 4e-14 at k = 1
  return {3 / (16 * k) * (s * (4 - s) * angle + (s + 2) * root),
          3.0 / 64 * ((8 - 8 * s + 3 * s * s) * angle + 3 * (2 - s) * root)};
}

Resistance inside(double k) {
  const double s = k * k;
  return {3 * pi / 32 * k * (4 - s), 3 * pi / 128 * (8 * (1 - s) + 3 * s * s)};
}

}  // namespace

Resistance HertzLaw::operator()(Slip slip) const {
  require_slip("HertzLaw", slip);
  if (slip.sliding <= slip.pivoting) return inside(slip.sliding / slip.pivoting);
  if (slip.sliding < series_from * slip.pivoting) return just_outside(slip.sliding / slip.pivoting);
  return fast_sliding(slip.pivoting / slip.sliding);
}

double HertzLaw::moment_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    const double s = k * k;
    return s * (1 - 0.375 * s);
  }
  return 1 - (*this)(slip).moment / (3 * pi / 16);
}

double HertzLaw::force_deficit(Slip slip) const {
  if (!(slip.sliding >= series_from * slip.pivoting)) return 1 - (*this)(slip).force;
  require_slip("HertzLaw", slip);
  const double inverse_k = slip.pivoting / slip.sliding, x = inverse_k * inverse_k;
  double sum = 0;
  for (std::size_t n = std::min(terms_at(x) + 1, hertz_series_terms); n-- > 1;) sum = sum * x - force_series[n];
  return sum * x;
}

namespace {

/// Returns C = sqrt(pi) Gamma(p + 2)/(2 Gamma(p + 5/2)) = Psi(0).
Wide pivoting_moment_of(Wide p) {
  return std::sqrt(std::numbers::pi_v<Wide>) / 2 * boost::math::tgamma_delta_ratio(p + 2, Wide{0.5});
}

/// The smaller speed divided by the larger one, its square, and 1 - square, computed without this subtraction.
struct Ratio {
  double ratio;
  double square;
  double rest;
};

Ratio ratio(double smaller, double larger) {
  const double q = smaller / larger;
  return {q, q * q, (larger - smaller) / larger * (1 + q)};
}

}  // namespace

struct PressureLaw::Series {
  explicit Series(Wide p)
      : inner_force(0.5, -p - 0.5, 2),
        inner_moment(0.5, -p - 1.5, 1),
        outer_force(-0.5, 0.5, p + 2),
        outer_moment(0.5, 0.5, p + 3),
        force_slope(static_cast<double>(pivoting_moment_of(p) * (p + 1.5))),
        pivoting_moment(static_cast<double>(pivoting_moment_of(p))),
        outer_scale(static_cast<double>(1 / (2 * (p + 2)))) {}

  GaussFunction inner_force;
  GaussFunction inner_moment;
  GaussFunction outer_force;
  GaussFunction outer_moment;
  double force_slope;
  double pivoting_moment;
  double outer_scale;
};

PressureLaw::PressureLaw(double p, std::string name)
    : p_(p), name_(std::move(name)), series_(std::make_shared<const Series>(p)) {}

PressureLaw::PressureLaw(double p)
    : PressureLaw(p > -1 && p <= max_p ? p
                                       : throw std::domain_error(fmt::format(
                                             "PressureLaw: the exponent p must be > -1 and <= {}, got {}", max_p, p)),
                  fmt::format("pressure:{}", p)) {}

PressureLaw PressureLaw::uniform() { return {0, "uniform"}; }
PressureLaw PressureLaw::punch() { return {-0.5, "punch"}; }
PressureLaw PressureLaw::ring() { return {-1, "ring"}; }
PressureLaw PressureLaw::paraboloid() { return {1, "paraboloid"}; }

Resistance PressureLaw::operator()(Slip slip) const {
  require_slip("PressureLaw", slip);
  const Series& series = *series_;
  if (slip.sliding <= slip.pivoting) {
    const auto [k, square, rest] = ratio(slip.sliding, slip.pivoting);
    return {series.force_slope * k * series.inner_force(square, rest),
            series.pivoting_moment * series.inner_moment(square, rest)};
  }
  const auto [inverse_k, square, rest] = ratio(slip.pivoting, slip.sliding);
  return {series.outer_force(square, rest), series.outer_scale * inverse_k * series.outer_moment(square, rest)};
}

double PressureLaw::moment_deficit(Slip slip) const {
  if (slip.sliding > slip.pivoting) return 1 - (*this)(slip).moment / series_->pivoting_moment;
  require_slip("PressureLaw", slip);
  const auto [k, square, rest] = ratio(slip.sliding, slip.pivoting);
  return square * series_->inner_moment.deficit(square, rest);
}

double PressureLaw::force_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) return 1 - (*this)(slip).force;
  require_slip("PressureLaw", slip);
  const auto [inverse_k, square, rest] = ratio(slip.pivoting, slip.sliding);
  return square * series_->outer_force.deficit(square, rest);
}

}  // namespace contensou::reduction
