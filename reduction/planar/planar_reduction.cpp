#include "contensou/reduction/planar_reduction.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

namespace {

/// The motion that stays at the centre.
struct Rest final : PlanarOrbit::Motion {
  explicit Rest(const Vector2d& at) : x(at) {}
  Vector2d at(double) const override { return x; }
  Vector2d at_end() const override { return x; }
  Vector2d x;
};

void require_point(const Vector2d& x) {
  if (!x.allFinite()) throw std::domain_error(fmt::format("({}, {}) is no point of the plane", x[0], x[1]));
}

/// Returns the reason why a system without a scaling has none.
std::string reason_of(const PlanarSymmetries& found) {
  using Verdict = PlanarSymmetries::Verdict;
  return found.verdict == Verdict::none        ? "no scaling was found"
         : found.verdict == Verdict::undecided ? "the field's noise, or its kinks, hide whether it has a scaling"
         : std::ranges::all_of(found.generators, &Generator::everywhere)
             ? "no generator is a scaling"
             : "no scaling holds throughout, only within sectors in which the field is smooth: across their borders "
               "orbits are no copies of one another";
}

}  // namespace

PlanarReduction reduce(const SmoothField& field, const Vector2d& start, const PlanarSymmetries& found) {
  if (field.basis.values) return by_factor(field, start);
  std::string why_not;
  if (found.scaling) {
    Vector2d around = sampled_about(field, start);
    if (found.scaling->fixes(around)) around.array() += around.lpNorm<Eigen::Infinity>();
    try {
      return PlanarReduction(field, *found.scaling, around, found.residual);
    } catch (const std::domain_error& refused) {
      why_not = refused.what();
    }
  } else {
    why_not = reason_of(found);
  }
  auto solved = solved_by_factor(field, start);
  if (solved->form.empty()) solved->why_not = why_not + ", and " + solved->why_not;
  return PlanarReduction(std::move(solved));
}

PlanarReduction by_factor(const SmoothField& field, const Vector2d& start) {
  return PlanarReduction(solved_by_factor(field, start));
}

PlanarReduction reduce(const SmoothField& field, const Vector2d& start) {
  return reduce(field, start, find_symmetries(field, sampled_about(field, start)));
}

PlanarOrbit PlanarReduction::Solution::orbit_from_centre() const {
  return PlanarOrbit(std::make_shared<const Rest>(centre));
}

std::vector<LevelPoint> PlanarReduction::Solution::levels(const std::vector<Vector2d>& path) const {
  std::vector<LevelPoint> all(path.size());
  const double turned = turn ? std::log(turn->factor) : 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    try {
      if (const auto integral = path[i] == centre ? std::nullopt : first_integral(path[i])) {
        all[i] = {*integral, factor(path[i])};
        if (turned != 0) all[i].integral -= turned * std::round((*integral - all.front().integral) / turned);
      }
    } catch (const std::domain_error&) {
      // The point has no first integral.
    }
  }
  return all;
}

std::string_view name(PlanarEnd end) {
  constexpr std::string_view names[]{"centre",   "infinity",  "rest",        "border",
                                     "periodic", "undecided", "equilibrium", "cycle"};
  return names[static_cast<std::size_t>(end)];
}

PlanarReduction::PlanarReduction(SmoothField field, const Generator& scaling, const Vector2d& around, double noise)
    : solution_(solved_by_scaling(std::move(field), scaling, around, noise)) {}
PlanarReduction::PlanarReduction(std::shared_ptr<const Solution> solution) : solution_(std::move(solution)) {}

const SmoothField& PlanarReduction::field() const { return solution_->field; }
std::string_view PlanarReduction::form() const { return solution_->form; }
const Generator* PlanarReduction::scaling() const { return solution_->scaling ? &*solution_->scaling : nullptr; }
const Flow* PlanarReduction::flow() const { return solution_->flow(); }
const Vector2d& PlanarReduction::centre() const { return solution_->centre; }
bool PlanarReduction::star() const { return solution_->star; }
const std::vector<PlanarRay>& PlanarReduction::rays() const { return solution_->rays; }
const std::vector<PlanarSector>& PlanarReduction::sectors() const { return solution_->sectors; }
const PlanarTurn* PlanarReduction::turn() const { return solution_->turn ? &*solution_->turn : nullptr; }
std::string_view PlanarReduction::kind() const { return solution_->kind; }
const std::string& PlanarReduction::undecided() const { return solution_->undecided; }
const std::string& PlanarReduction::why_not() const { return solution_->why_not; }
const std::vector<TriedForm>& PlanarReduction::tried() const { return solution_->tried; }
std::string PlanarReduction::formula() const { return solution_->formula(); }

double PlanarReduction::factor(const Vector2d& x) const {
  require_point(x);
  return solution_->factor(x);
}

std::vector<FactorPiece> PlanarReduction::factor_pieces(const Vector2d& low, const Vector2d& high) const {
  return solution_->factor_pieces(low, high);
}

PlanarCanonical PlanarReduction::canonical(const Vector2d& x) const {
  require_point(x);
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  return x == centre() ? PlanarCanonical{nothing, -infinity, nothing} : solution_->canonical(x);
}

Vector2d PlanarReduction::point(double q, double p) const { return solution_->point(q, p); }
PlanarEnd PlanarReduction::end(const Vector2d& x) const { return orbit(x).end(); }
double PlanarReduction::end_time(const Vector2d& x) const { return orbit(x).end_time(); }

double PlanarReduction::end_time_error(const Vector2d& x, const PlanarOrbit& orbit) const {
  const double time = period_or_end(orbit);
  return std::isfinite(time) && time != 0 ? solution_->end_time_error(x, orbit) : 0;
}

double PlanarReduction::end_time_error(const Vector2d& x) const { return end_time_error(x, orbit(x)); }

double PlanarReduction::first_integral(const Vector2d& x) const {
  require_point(x);
  if (x != centre()) {
    if (const auto integral = solution_->first_integral(x)) return *integral;
  }
  throw std::domain_error(
      fmt::format("the first integral has no value on an invariant curve and at the centre, got ({}, {})", x[0], x[1]));
}

std::vector<LevelPoint> PlanarReduction::levels(const std::vector<Vector2d>& path) const {
  return solution_->levels(path);
}

PlanarOrbit PlanarReduction::orbit(const Vector2d& start) const {
  require_point(start);
  if (start == centre()) return solution_->orbit_from_centre();
  return solution_->orbit(start);
}

PlanarOrbit PlanarReduction::part_of_orbit(const Vector2d& start) const {
  require_point(start);
  return start == centre() ? orbit(start) : solution_->part_of_orbit(start);
}

PlanarReduction PlanarReduction::reversed() const { return PlanarReduction(solution_->reversed()); }

namespace {

/// Returns the limit of the states next to a border. There a coordinate is a constant and a power of the time left, and
/// the constant follows from three states (Aitken's process).
Vector2d limit_at_border(const PlanarOrbit::Motion& motion) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(motion.end_time)) return {unknown, unknown};
  std::array<Vector2d, 4> x;
  try {
    for (int k = 0; k < 4; ++k) {
      x[static_cast<std::size_t>(k)] = motion.at(motion.end_time * (1 - std::pow(10, k - 9)));
    }
  } catch (const std::domain_error&) {
    return {unknown, unknown};
  }
  Vector2d end;
  for (int i = 0; i < 2; ++i) {
    const auto limit = [&](std::size_t k) -> double {
      const double last = x[k][i] - x[k + 1][i], step = x[k + 1][i] - x[k + 2][i];
      constexpr double slow = 0.97, rounding = 1e-12;
      if (std::abs(last) <= rounding * std::abs(x[k][i])) return x[k][i];
      if (!(std::abs(last) < slow * std::abs(step))) return std::copysign(infinity, last);  // as a logarithm does
      return x[k][i] - last * last / (last - step);
    };
    end[i] = limit(0);
    const double error = std::abs(end[i] - limit(1)), unit = std::pow(10, std::ceil(std::log10(error)));
    if (error > 0 && std::isfinite(unit)) end[i] = unit * std::round(end[i] / unit);
  }
  return end;
}

}  // namespace

PlanarOrbit::PlanarOrbit(std::shared_ptr<const Motion> motion) : motion_(std::move(motion)) {}
PlanarEnd PlanarOrbit::end() const { return motion_->end; }
std::optional<double> PlanarOrbit::period() const { return motion_->period(); }
double PlanarOrbit::first_slide() const { return motion_->first_slide(); }
const std::string& PlanarOrbit::undecided() const { return motion_->undecided; }
bool PlanarOrbit::unique() const { return motion_->unique; }
Vector2d PlanarOrbit::limit() const {
  switch (motion_->end) {
    case PlanarEnd::centre:
    case PlanarEnd::rest:
    case PlanarEnd::equilibrium:
      return motion_->at_end();
    case PlanarEnd::border:
      return limit_at_border(*motion_);
    default:
      return motion_->limit;
  }
}
double PlanarOrbit::end_time() const {
  return motion_->end == PlanarEnd::border && !motion_->border_time_known ? infinity : motion_->end_time;
}

Vector2d PlanarOrbit::at(double time) const {
  if (!(time >= 0)) throw std::domain_error(fmt::format("PlanarOrbit: times >= 0 are required, got {}", time));
  if (time < motion_->end_time || motion_->end == PlanarEnd::undecided) return motion_->at(time);
  switch (motion_->end) {
    case PlanarEnd::centre:
    case PlanarEnd::rest:
    case PlanarEnd::equilibrium:
      return motion_->at_end();
    default:
      throw std::domain_error(fmt::format("PlanarOrbit: the orbit ends at the time {}, at {}", motion_->end_time,
                                          motion_->end == PlanarEnd::border ? "a border" : "infinity"));
  }
}

}  // namespace contensou::reduction
