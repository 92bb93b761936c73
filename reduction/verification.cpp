#include "contensou/reduction/verification.hpp"
