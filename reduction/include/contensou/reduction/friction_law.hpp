#pragma once

#if __cplusplus < 202002L
#error "C++20 is needed: compile contensou with -std=c++20"
#endif

#ifdef __FAST_MATH__
#error "contensou needs infinities, NaN and sums in the order that is written: compile without -ffast-math"
#endif

#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace contensou::reduction {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53,
              "contensou needs doubles of 64 bits after IEEE 754");

/// The motion of a circular contact patch over the plane: two speeds in one unit, both >= 0 and not both 0.
///
/// Two speeds need no infinity, unlike their ratio k = sliding/pivoting: pure sliding (pivoting = 0) and pure pivoting
/// (sliding = 0) are ordinary values.
struct Slip {
  double sliding;   ///< speed v of the patch centre
  double pivoting;  ///< rim speed w = (patch radius) |omega_z| = mu |u| of the rotation about the normal
};

/// Force and moment of friction in dimensionless form, the result of a law.
struct Resistance {
  double force;   ///< Phi = F/(N f), opposes sliding
  double moment;  ///< Psi = M/(N f (patch radius)), opposes pivoting
};

/// Returns a slip with the ratio k = sliding/pivoting, whose larger speed is 1.
///
/// @param k  from 0 (pure pivoting) to infinity (pure sliding)
/// @throws std::domain_error  if k is negative or not a number
Slip slip_of_ratio(double k);

/// Throws for a slip at which no friction law has a value.
///
/// @param law  name of the law, with which the message begins
/// @throws std::domain_error  if a speed is negative or not finite, or if both are 0: friction has no limit at rest
///                            (V. F. Zhuravlev, 1998, remark 3)
void require_slip(const char* law, Slip slip);

/// A dry friction law of a circular contact patch: any type that computes a Resistance from a Slip.
///
/// The patch slides at the speed v of its centre and pivots about its normal; w is the speed of its rim. Friction is a
/// force F = f N Phi(k) against the sliding and a moment M = f N eps Psi(k) against the pivoting, with k = v/w, the
/// load N, the coefficient of friction f and the patch radius eps.
///
/// The library requires five properties of a law. Law's constructor tests the first three at about 40 slips to 1e-6:
///   - degree 0: Phi and Psi depend on the ratio k = sliding/pivoting alone;
///   - Phi > 0 and Psi > 0 for k > 0, Psi(0) > 0;
///   - Phi(k) = Phi'(0) k + o(k) with Phi'(0) > 0, and 1 - Psi/Psi(0) = O(k), for k -> 0; k Psi has a limit and
///     k (1 - Phi) is bounded, for k -> infinity;
///   - Phi and Psi are continuous and piecewise smooth, and Phi/(k Psi) has finitely many maxima and minima;
///   - operator() is const and may run in several threads at once.
///
/// Optional members, used if they exist:
///   - `static constexpr std::string_view name`, or a member function `name()`, for messages and tables;
///   - `double moment_deficit(Slip) const`, 1 - Psi/Psi(0) without the subtraction (keeps digits for k << 1);
///   - `double force_deficit(Slip) const`, 1 - Phi without the subtraction (keeps digits for k >> 1; needed if a drive
///     next to 1 nearly cancels the friction);
///   - `static constexpr SlidingBounds sliding_bounds`, the bounds of the stop time under this law;
///   - `kinks()`, every k at which Phi or Psi is not smooth; by default k = 1, at which the centre of velocity lies on
///     the rim. A missing kink makes the steppers less accurate and the curves slower.
///
/// A law contains no solution of the motion. closed_solution chooses a closed form by the type of the law.
template <class L>
concept FrictionLaw = std::copy_constructible<L> && requires(const L& law, Slip slip) {
  { law(slip) } -> std::convertible_to<Resistance>;
};

/// A function or a type with a call operator: a candidate for a law.
template <class L>
concept Callable = std::is_function_v<std::remove_pointer_t<L>> || requires {
  &L::operator();
} || requires(const L& law, Slip slip) {
  law(slip);
};

/// Bounds, over all starts, of the coefficient m in the stop time tau* = P + m S (theory.md (R6)). P is the
/// stop time of pure pivoting, S that of pure sliding.
struct SlidingBounds {
  double min;
  double max;
};

/// Any friction law as one value: the library computes with this type. Copies are cheap: they share one function.
///
///     const Law exact = HertzLaw{};
///     exact({.sliding = 1, .pivoting = 2}).force;  // Phi at k = 1/2
///
/// Accuracy  equal to the accuracy of the wrapped law. If the law has no deficit functions, deficits are computed by
///           subtraction from 1.
class Law {
 public:
  /// Copies and tests a law.
  /// @throws std::domain_error  if the law breaks a requirement of FrictionLaw; the message contains the values
  template <class L>
  requires(!std::same_as<L, Law> && FrictionLaw<L>) Law(L law) {  // NOLINT(google-explicit-constructor): a law is a Law
    auto function = std::make_shared<FunctionOf<L>>(std::move(law));
    const L& kept = function->law;
    if constexpr (requires {
                    { L::name } -> std::convertible_to<std::string_view>;
                  })
      function->name = L::name;
    else if constexpr (requires {
                         { kept.name() } -> std::convertible_to<std::string>;
                       })
      function->name = kept.name();
    if constexpr (requires {
                    { L::sliding_bounds } -> std::convertible_to<SlidingBounds>;
                  }) {
      function->sliding_bounds = L::sliding_bounds;
    }
    if constexpr (requires {
                    { kept.kinks() } -> std::convertible_to<std::vector<double>>;
                  }) {
      function->kinks = kept.kinks();
    }
    function->read_limits();
    function_ = std::move(function);
  }

  /// Rejects a callable type that is no law; the compiler's message describes the requirements.
  template <class L>
  requires(!std::same_as<L, Law> && Callable<L> && !FrictionLaw<L>)
      Law(const L&) {  // NOLINT(google-explicit-constructor): as the constructor above
    static_assert(
        FrictionLaw<L>,
        "a law is a copyable type with `Resistance operator()(Slip) const`: see FrictionLaw in friction_law.hpp");
  }

  // No move operations: a moved-from Law would be null.
  Law(const Law&) = default;
  Law& operator=(const Law&) = default;
  ~Law() = default;

  /// Returns the dimensionless force Phi and moment Psi. Throws if the wrapped law throws.
  Resistance operator()(Slip slip) const { return function_->resistance(slip); }

  /// Returns 1 - Psi/Psi(0).
  double moment_deficit(Slip slip) const { return function_->moment_deficit(slip); }

  /// Returns 1 - Phi.
  double force_deficit(Slip slip) const { return function_->force_deficit(slip); }

  /// Returns true if the law has its own force_deficit, so that 1 - Phi keeps digits for Phi next to 1.
  bool states_force_deficit() const { return function_->states_force_deficit(); }

  const std::string& name() const { return function_->name; }

  /// Returns this law with a memory of its values, for many solutions that call the law at the same k. Values and
  /// constants are the same bit for bit. Threads may share the result.
  Law remembered() const;

  /// Returns the wrapped law if its type is exactly L, else null. A type derived from L does not count as L.
  template <FrictionLaw L>
  const L* as() const {
    const auto* function = dynamic_cast<const FunctionOf<L>*>(&function_->given());
    return function ? &function->law : nullptr;
  }

  /// Returns Psi(0), the moment of pure pivoting.
  double pivoting_moment() const { return function_->pivoting_moment; }

  /// Returns Phi'(0). Slow sliding of a pivoting patch has the force f N Phi'(0) k, like viscous friction.
  double force_slope() const { return function_->force_slope; }

  /// Returns the bounds of the stop time that the law states; empty if it states none.
  const std::optional<SlidingBounds>& sliding_bounds() const { return function_->sliding_bounds; }

  /// Returns the values of k at which Phi or Psi might not be smooth.
  const std::vector<double>& kinks() const { return function_->kinks; }

 private:
  /// The wrapped law behind an interface without its type, and constants of the law that are computed once.
  struct Function {
    virtual ~Function() = default;
    virtual Resistance resistance(Slip slip) const = 0;
    virtual double moment_deficit(Slip slip) const = 0;
    virtual double force_deficit(Slip slip) const = 0;
    virtual bool states_force_deficit() const = 0;
    /// Returns the function of the law that was wrapped.
    virtual const Function& given() const { return *this; }
    void read_limits();
    void require_degree_0() const;
    void require_approach() const;

    std::string name = "user's law";
    std::optional<SlidingBounds> sliding_bounds;
    std::vector<double> kinks{1};
    double pivoting_moment = std::numeric_limits<double>::quiet_NaN();
    double force_slope = std::numeric_limits<double>::quiet_NaN();
  };

  template <class L>
  struct FunctionOf final : Function {
    explicit FunctionOf(L given) : law(std::move(given)) {}
    Resistance resistance(Slip slip) const override { return law(slip); }
    double moment_deficit(Slip slip) const override {
      if constexpr (requires {
                      { law.moment_deficit(slip) } -> std::convertible_to<double>;
                    })
        return law.moment_deficit(slip);
      else
        return 1 - resistance(slip).moment / this->pivoting_moment;
    }
    static constexpr bool has_force_deficit = requires(const L& law, Slip slip) {
      { law.force_deficit(slip) } -> std::convertible_to<double>;
    };
    double force_deficit(Slip slip) const override {
      if constexpr (has_force_deficit)
        return law.force_deficit(slip);
      else
        return 1 - resistance(slip).force;
    }
    bool states_force_deficit() const override { return has_force_deficit; }

    L law;
  };

  /// A function, and its values that were computed so far.
  struct Remembered;

  explicit Law(std::shared_ptr<const Function> function) : function_(std::move(function)) {}

  std::shared_ptr<const Function> function_;
};

}  // namespace contensou::reduction
