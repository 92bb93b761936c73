#include "laws/remembered_law.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace contensou::reduction {

namespace {

struct Remembered {
  Resistance friction;
  double moment_deficit;
};

/// A law, and the values of the law that were computed so far.
class Memory {
 public:
  explicit Memory(const Law& given) : law(given) {}

  const Law law;

  Remembered at(Slip slip) {
    {
      const std::lock_guard lock(guard_);
      if (const auto found = known_.find(slip); found != known_.end()) return found->second;
    }
    const Remembered made{law(slip), law.moment_deficit(slip)};  // without a lock: other threads go on
    const std::lock_guard lock(guard_);
    known_.emplace(slip, made);
    return made;
  }

 private:
  struct Hash {
    std::size_t operator()(const Slip& slip) const {
      constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
      const auto bits = [](double speed) { return std::bit_cast<std::uint64_t>(speed); };
      return ((bits(slip.sliding) * odd ^ bits(slip.pivoting)) * odd) >> 20;
    }
  };
  struct Same {
    bool operator()(const Slip& a, const Slip& b) const { return a.sliding == b.sliding && a.pivoting == b.pivoting; }
  };

  std::mutex guard_;
  std::unordered_map<Slip, Remembered, Hash, Same> known_;
};

/// @tparam StatesForceDeficit  Law::states_force_deficit of the given law
template <bool StatesForceDeficit>
class RememberedLaw {
 public:
  explicit RememberedLaw(std::shared_ptr<Memory> memory) : memory_(std::move(memory)) {}

  const Law& law() const { return memory_->law; }
  std::string name() const { return law().name(); }
  std::vector<double> kinks() const { return law().kinks(); }

  Resistance operator()(Slip slip) const { return memory_->at(slip).friction; }
  double moment_deficit(Slip slip) const { return memory_->at(slip).moment_deficit; }
  double force_deficit(Slip slip) const requires StatesForceDeficit { return law().force_deficit(slip); }

 private:
  std::shared_ptr<Memory> memory_;
};

}  // namespace

Law remembered(const Law& law) {
  auto memory = std::make_shared<Memory>(law);
  if (law.states_force_deficit()) return RememberedLaw<true>(std::move(memory));
  return RememberedLaw<false>(std::move(memory));
}

const Law& original(const Law& law) {
  if (const auto* kept = law.as<RememberedLaw<true>>()) return kept->law();
  if (const auto* kept = law.as<RememberedLaw<false>>()) return kept->law();
  return law;
}

}  // namespace contensou::reduction
