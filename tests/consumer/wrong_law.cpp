// Does not compile: a law takes a Slip and returns a Resistance. The test reads the compiler's message.
#include <contensou/reduction/stop_time.hpp>

struct Mine {
  double operator()(double k) const { return k; }
};

contensou::reduction::StopTime stop() { return contensou::reduction::stop_time({Mine{}, 0.1}, {.u = 1, .v = 1}); }
