// Separatrices of an equilibrium whose eigenvalues are both 0.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "contensou/reduction/planar_reduction.hpp"
#include "planar/winding.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
using std::numbers::pi;

namespace {

/// The fate of a motion that begins near an equilibrium.
struct Passage {
  enum class End { leaves, arrives, unknown } end;
  double angle = 0;    ///< direction from the equilibrium at the end, continued over turns
  double nearest = 1;  ///< smallest and largest distance from the equilibrium, in radii of the ellipse
  double farthest = 1;
};

/// Follows motions from an ellipse about an equilibrium, forwards or backwards.
class Surroundings {
 public:
  Surroundings(const PlanarReduction& steps, const Vector2d& centre, const Vector2d& half)
      : steps_(steps), centre_(centre), half_(half) {}

  Vector2d point(double angle) const {
    return centre_ + half_.cwiseProduct(Vector2d(std::cos(angle), std::sin(angle)));
  }

  Passage passage(double angle) const {
    constexpr double outside = 1.5, arrived = 1e-3, widest = 0.4, first = 0.1;
    constexpr int most = 600;
    Passage passage{Passage::End::unknown, angle};
    try {
      const Vector2d start = point(angle);
      const double speed = steps_.field()(start).cwiseQuotient(half_).norm();
      if (!(speed > 0)) return passage;
      Winding winding(steps_.part_of_orbit(start), start, centre_, half_, widest, first / speed);
      for (int i = 0; i < most && winding.advance(); ++i) {
        const double distance = winding.here().norm();
        passage.angle = angle + winding.angle();
        passage.nearest = std::min(passage.nearest, distance);
        passage.farthest = std::max(passage.farthest, distance);
        if (distance > outside || distance < arrived) {
          passage.end = distance < arrived ? Passage::End::arrives : Passage::End::leaves;
          return passage;
        }
      }
    } catch (const std::domain_error&) {
      // The field has no value at the start.
    }
    return passage;
  }

  /// Returns the angles at which separatrices start.
  std::vector<double> separatrices() const {
    constexpr int count = 96, halvings = 40;
    constexpr double apart = 1, same = 0.02;
    constexpr auto arrives = Passage::End::arrives, leaves = Passage::End::leaves;
    std::vector<double> found;
    // The ellipse is not divided at the axes, because axes often are separatrices.
    const auto angle_at = [](int i) { return 2 * pi * (i + 0.37) / count; };
    Passage last = passage(angle_at(0));
    for (int i = 1; i <= count; ++i) {
      double low = angle_at(i - 1), high = angle_at(i);
      Passage before = last, after = passage(high);
      last = after;
      bool arrived = before.end == arrives || after.end == arrives;
      if (before.end == Passage::End::unknown || after.end == Passage::End::unknown) continue;
      if (before.end == arrives && after.end == arrives) continue;
      if (!arrived && std::abs(after.angle - before.angle) < apart) continue;
      for (int k = 0; k < halvings; ++k) {
        const double middle = (low + high) / 2;
        const Passage here = passage(middle);
        if (here.end == Passage::End::unknown) break;
        const bool is_as_before =
            here.end == before.end &&
            (here.end == arrives || std::abs(here.angle - before.angle) < std::abs(here.angle - after.angle));
        if (here.end == arrives && before.end == leaves && after.end == leaves) {
          arrived = true;
          low = high = middle;
          before = after = here;
          break;
        }
        (is_as_before ? low : high) = middle;
        (is_as_before ? before : after) = here;
      }
      // Motions also differ where they touch the outer border; there they do not come near to the equilibrium.
      constexpr double near = 0.3, far = 1.3;
      const auto passes_near = [](const Passage& each) {
        return each.end == arrives ? each.farthest < far : each.nearest < near;
      };
      if (!arrived || !passes_near(before) || !passes_near(after)) continue;
      const double angle = (low + high) / 2;
      if (!found.empty() && angle - found.back() < same) {
        found.back() = (found.back() + angle) / 2;
      } else {
        found.push_back(angle);
      }
    }
    return found;
  }

 private:
  const PlanarReduction& steps_;
  Vector2d centre_, half_;
};

}  // namespace

std::vector<SeparatrixPoint> degenerate_separatrices(const SmoothField& field, const Vector2d& centre,
                                                     const Vector2d& sides) {
  constexpr double tolerance = 1e-9, radius = 0.01, smaller = 0.4;
  const PlanarReduction forth = by_steps(field, tolerance), back = forth.reversed();
  std::vector<SeparatrixPoint> points;
  for (const bool stable : {true, false}) {
    const PlanarReduction& steps = stable ? forth : back;
    const Surroundings wide(steps, centre, radius * sides), narrow(steps, centre, smaller * radius * sides);
    const std::vector<double> angles = wide.separatrices();
    if (narrow.separatrices().size() != angles.size()) return {};
    for (const double angle : angles) points.push_back({wide.point(angle), stable});
  }
  return points;
}

}  // namespace contensou::reduction
