#pragma once

#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "contensou/reduction/similarity_solution.hpp"
#include "contensou/reduction/slip.hpp"

namespace contensou::reduction {

struct State;
struct Inertia;

/// A friction law of a circular patch is any value that turns a Slip into a Resistance.
///
/// What the library relies on, and checks only where it says so:
///   - degree 0: the answer depends on the ratio k = sliding/pivoting alone;
///   - Phi(k) = Phi'(0) k + o(k) with Phi'(0) > 0, Phi(infinity) = 1; Psi(0) > 0, k Psi(k) bounded;
///   - Phi and Psi continuous and piecewise smooth, with k = 1 the only likely kink.
///
/// A law may offer more; each of these is used when it is there:
///   - `static constexpr std::string_view name`, or a member function `name()`, for messages and tables;
///   - `double moment_deficit(Slip) const`, 1 - Psi/Psi(0) without the subtraction (keeps digits for k << 1);
///   - `static constexpr SlidingShare sliding_share`, its two-sided bound of the stop time;
///   - `SimilaritySolution closed_solution(double r) const`, its closed form for that r, or an empty one;
///   - `double small_mu_share(int order, double r, double ln_k) const`, its m of README (R4) up to r^(order - 1), order
///   1 or 2, in closed form;
///   - `double closed_stop_time(double mu, const State&, const Inertia&) const`, its stop time in closed form, any r;
///   - `double inner_log_rim(double r, double k) const`, ln w(k) for k <= 1 where only that part is elementary: a
///   check.
template <class L>
concept FrictionLaw = std::copy_constructible<L> && requires(const L& law, Slip slip) {
  { law(slip) } -> std::convertible_to<Resistance>;
};

/// Bounds of m in  tau* = P + m S  over all starts (README (R6)): P and S are the times of pure pivoting and pure
/// sliding.
struct SlidingShare {
  double least;
  double most;
};

/// Any friction law as one value: what the rest of the library computes with.
class Law {
 public:
  /// @throws std::domain_error  if the law's limits are not those listed at FrictionLaw
  template <class L>
  requires(!std::same_as<L, Law> && FrictionLaw<L>) Law(L law) {  // NOLINT(google-explicit-constructor): a law is a Law
    if constexpr (requires {
                    { L::name } -> std::convertible_to<std::string_view>;
                  })
      name_ = L::name;
    else if constexpr (requires {
                         { law.name() } -> std::convertible_to<std::string>;
                       })
      name_ = law.name();
    if constexpr (requires {
                    { L::sliding_share } -> std::convertible_to<SlidingShare>;
                  }) {
      sliding_share_ = L::sliding_share;
    }
    if constexpr (requires(Slip slip) {
                    { law.moment_deficit(slip) } -> std::convertible_to<double>;
                  }) {
      moment_deficit_ = [law](Slip slip) { return law.moment_deficit(slip); };
    }
    if constexpr (requires {
                    { law.closed_solution(1.0) } -> std::convertible_to<SimilaritySolution>;
                  }) {
      closed_solution_ = [law](double r) { return law.closed_solution(r); };
    }
    if constexpr (requires(const State& start, const Inertia& inertia) {
                    { law.closed_stop_time(1.0, start, inertia) } -> std::convertible_to<double>;
                  }) {
      closed_stop_time_ = [law](double mu, const State& start, const Inertia& inertia) {
        return law.closed_stop_time(mu, start, inertia);
      };
    }
    if constexpr (requires {
                    { law.inner_log_rim(1.0, 1.0) } -> std::convertible_to<double>;
                  }) {
      inner_log_rim_ = [law](double r, double k) { return law.inner_log_rim(r, k); };
    }
    if constexpr (requires {
                    { law.small_mu_share(1, 1.0, 1.0) } -> std::convertible_to<double>;
                  }) {
      small_mu_share_ = [law](int order, double r, double ln_k) { return law.small_mu_share(order, r, ln_k); };
    }
    resistance_ = std::move(law);
    read_limits();
  }

  Resistance operator()(Slip slip) const { return resistance_(slip); }

  /// 1 - Psi/Psi(0).
  double moment_deficit(Slip slip) const {
    return moment_deficit_ ? moment_deficit_(slip) : 1 - resistance_(slip).moment / pivoting_moment_;
  }

  const std::string& name() const { return name_; }

  /// The law that this was made from if it is an L, else null.
  template <FrictionLaw L>
  const L* as() const {
    return resistance_.template target<L>();
  }

  /// Psi(0), the moment of pure pivoting.
  double pivoting_moment() const { return pivoting_moment_; }

  /// Phi'(0), the viscosity of slow sliding over a pivoting patch.
  double force_slope() const { return force_slope_; }

  /// The law's own bounds of the stop time, if it states any.
  const std::optional<SlidingShare>& sliding_share() const { return sliding_share_; }

  /// The law's closed form for r = gamma mu^2/chi; empty if the law has none for this r.
  SimilaritySolution closed_solution(double r) const {
    return closed_solution_ ? closed_solution_(r) : SimilaritySolution();
  }

  /// The law's own expansion of m for small r; empty if it has none.
  const std::function<double(int order, double r, double ln_k)>& small_mu_share() const { return small_mu_share_; }

  /// The law's own stop time, for any mu, state and body that ReducedSystem takes; empty if it has none.
  const std::function<double(double mu, const State&, const Inertia&)>& closed_stop_time() const {
    return closed_stop_time_;
  }

  /// The law's own ln w(k) for k <= 1, up to a constant; empty if it has none.
  const std::function<double(double r, double k)>& inner_log_rim() const { return inner_log_rim_; }

 private:
  void read_limits();

  std::string name_ = "user's law";
  std::function<Resistance(Slip)> resistance_;
  std::function<double(Slip)> moment_deficit_;
  std::function<SimilaritySolution(double)> closed_solution_;
  std::function<double(int, double, double)> small_mu_share_;
  std::function<double(double, const State&, const Inertia&)> closed_stop_time_;
  std::function<double(double, double)> inner_log_rim_;
  std::optional<SlidingShare> sliding_share_;
  double pivoting_moment_ = std::numeric_limits<double>::quiet_NaN();
  double force_slope_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace contensou::reduction
