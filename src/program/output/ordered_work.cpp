#include "output/ordered_work.hpp"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace contensou::program {

namespace {

class OrderedWork {
 public:
  void run(PieceWorker& worker) {
    for (std::exception_ptr error;;) {
      long place = 0;
      {
        const std::lock_guard lock(taking_);
        if (ended_) return;
        try {
          if (!worker.take()) ended_ = true;
        } catch (...) {
          error = std::current_exception();
          ended_ = true;
        }
        if (ended_ && !error) return;
        place = taken_++;
      }
      try {
        if (!error) worker.work();
      } catch (...) {
        error = std::current_exception();
      }
      std::unique_lock lock(handing_on_);
      turn_comes_.wait(lock, [&] { return failure_ || handed_on_ == place; });
      if (failure_) return;
      try {
        if (error) std::rethrow_exception(error);
        worker.hand_on();
      } catch (...) {
        failure_ = std::current_exception();
        ended_ = true;
      }
      ++handed_on_;
      turn_comes_.notify_all();
    }
  }

  void finish() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex taking_, handing_on_;
  std::condition_variable turn_comes_;
  std::atomic<bool> ended_ = false;  ///< nothing more is taken
  long taken_ = 0;
  long handed_on_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void work_in_order(const std::vector<std::unique_ptr<PieceWorker>>& workers) {
  OrderedWork work;
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < workers.size(); ++i) {
      try {
        threads.emplace_back([&work, &worker = *workers[i]] { work.run(worker); });
      } catch (const std::system_error&) {
        break;  // the threads there are do all of it
      }
    }
    work.run(*workers.front());
  }
  work.finish();
}

}  // namespace contensou::program
