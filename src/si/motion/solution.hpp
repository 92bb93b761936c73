#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "contensou/si/motion.hpp"

namespace contensou::si {

/// A solution of the equations of motion, for times >= 0 and speeds >= 0. The default functions apply to a body on a
/// level plane that rolls on for ever; they use only the states of the motion.
class Motion::Solution {
 public:
  explicit Solution(const Experiment& of) : experiment(of) {}
  Solution(const Solution&) = delete;
  Solution& operator=(const Solution&) = delete;
  virtual ~Solution() = default;

  virtual MotionPoint at(double t) const = 0;
  virtual MotionColumns at_times(const Eigen::ArrayXd& times) const;
  virtual double stop_time() const = 0;
  virtual double spin_end() const { return spin_at_start(experiment) == 0 ? 0 : stop_time(); }
  virtual double slip_time(double speed) const;
  virtual double spin_time(double speed) const;
  virtual double slip_length() const = 0;
  virtual double spin_angle() const = 0;
  virtual double path_length(double t) const;
  virtual std::optional<Event> rest() const { return std::nullopt; }
  virtual Velocities final_motion() const { return si::final_motion(experiment); }
  virtual double rolled() const { return 0; }  ///< integral of R |omega| about horizontal axes, m; only with resistance
  virtual bool is_reduced() const { return false; }
  virtual std::vector<ReducedPiece> pieces() const { return {}; }
  virtual std::optional<double> creep_ratio() const { return std::nullopt; }
  virtual long steps() const { return 0; }

  const Experiment experiment;
};

using SolvedMotion = std::shared_ptr<const Motion::Solution>;

/// The flows that the motions of one ball share, also between threads. The first motion that needs a flow makes it.
class SharedFlows {
 public:
  /// The systems of a ball: without a drive; with a drive while the ball turns; with a drive while resistance holds it.
  enum class Of { undriven, turning, held };

  explicit SharedFlows(std::optional<reduction::Flow> undriven = {}) : known_{std::move(undriven)} {}

  reduction::Flow get(Of of, const std::function<reduction::Flow()>& made);

 private:
  std::mutex guard_;
  std::array<std::optional<reduction::Flow>, 3> known_;
};

/// Returns the integral of a function of time over [from, to]; 0 for an empty interval.
double integral_over_time(const std::function<double(double t)>& value, double from, double to, double tolerance);

/// Return the motion on a level plane without rolling friction (undriven), or any other motion (resisted).
SolvedMotion undriven_motion(const Experiment& experiment, const reduction::Law& law, SharedFlows& flows);
SolvedMotion undriven_motion_in_steps(const Experiment& experiment, const reduction::Law& law);
SolvedMotion resisted_motion(const Experiment& experiment, const reduction::Law& law, SharedFlows& flows,
                             bool in_steps = false);

SolvedMotion uncoupled_motion(const Experiment& experiment, const reduction::Law& law, double rolling_below);

/// Returns the motion under a changing load.
/// @throws std::domain_error  as Motion::reduced
SolvedMotion loaded_motion(SolvedMotion nominal, const LoadHistory& history);

}  // namespace contensou::si
