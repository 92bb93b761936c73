#pragma once

#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contensou/reduction/slip.hpp"

namespace contensou::reduction {

/// A friction law of a circular patch is any value that turns a Slip into a Resistance.
///
/// What the library relies on. The first three are checked at some 40 slips when a Law is made of it, to 1e-6:
///   - degree 0: the answer depends on the ratio k = sliding/pivoting alone;
///   - Phi > 0 and Psi > 0 for k > 0, Psi(0) > 0;
///   - Phi(k) = Phi'(0) k + o(k) with Phi'(0) > 0 and 1 - Psi/Psi(0) = O(k) at 0; k Psi has a limit and k (1 - Phi) is
///     bounded at infinity;
///   - Phi and Psi continuous and piecewise smooth, Phi/(k Psi) of finitely many maxima and minima;
///   - the call is const and may come from several threads at once.
///
/// A law may state more; each of these is used when it is there:
///   - `static constexpr std::string_view name`, or a member function `name()`, for messages and tables;
///   - `double moment_deficit(Slip) const`, 1 - Psi/Psi(0) without the subtraction (keeps digits for k << 1);
///   - `double force_deficit(Slip) const`, 1 - Phi without the subtraction (keeps digits for k >> 1, where a drive next
///     to 1 leaves nothing else of friction);
///   - `static constexpr SlidingBounds sliding_bounds`, its two-sided bound of the stop time;
///   - `kinks()`, every k where Phi or Psi is not smooth (1 unless stated: where the rim of the patch is at rest). A
///     kink that is not named costs accuracy of the steppers, and of the curves only time.
///
/// A law says nothing of how motions under it are solved: closed forms are found by a law's type (closed_solution),
/// never by its name.
template <class L>
concept FrictionLaw = std::copy_constructible<L> && requires(const L& law, Slip slip) {
  { law(slip) } -> std::convertible_to<Resistance>;
};

/// Bounds of m in  tau* = P + m S  over all starts (README (R6)): P and S are the times of pure pivoting and pure
/// sliding.
struct SlidingBounds {
  double min;
  double max;
};

/// Any friction law as one value: what the rest of the library computes with. Copies share one function: they are
/// cheap.
class Law {
 public:
  /// @param law  kept as a copy
  /// @throws std::domain_error  if the law is not as FrictionLaw lists: the message says what was measured, and where
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

  // No moves: a Law that was moved from would be none.
  Law(const Law&) = default;
  Law& operator=(const Law&) = default;
  ~Law() = default;

  /// @return  Phi and Psi
  Resistance operator()(Slip slip) const { return function_->resistance(slip); }

  /// 1 - Psi/Psi(0).
  double moment_deficit(Slip slip) const { return function_->moment_deficit(slip); }

  /// 1 - Phi.
  double force_deficit(Slip slip) const { return function_->force_deficit(slip); }

  /// Whether the law states its force_deficit, so that it keeps digits where Phi is next to 1.
  bool states_force_deficit() const { return function_->states_force_deficit(); }

  const std::string& name() const { return function_->name; }

  /// The law that this was made from if its type is L itself, else null: a law derived from L is another law.
  template <FrictionLaw L>
  const L* as() const {
    const auto* function = dynamic_cast<const FunctionOf<L>*>(function_.get());
    return function ? &function->law : nullptr;
  }

  /// Psi(0), the moment of pure pivoting.
  double pivoting_moment() const { return function_->pivoting_moment; }

  /// Phi'(0), the viscosity of slow sliding over a pivoting patch.
  double force_slope() const { return function_->force_slope; }

  /// The law's own bounds of the stop time, if it states any.
  const std::optional<SlidingBounds>& sliding_bounds() const { return function_->sliding_bounds; }

  /// The k where Phi or Psi may not be smooth.
  const std::vector<double>& kinks() const { return function_->kinks; }

 private:
  /// A law of any type, with what is read from it once.
  struct Function {
    virtual ~Function() = default;
    virtual Resistance resistance(Slip slip) const = 0;
    virtual double moment_deficit(Slip slip) const = 0;
    virtual double force_deficit(Slip slip) const = 0;
    virtual bool states_force_deficit() const = 0;
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

  std::shared_ptr<const Function> function_;
};

}  // namespace contensou::reduction
