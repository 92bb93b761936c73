#include "contensou/portraits/phase_portrait.hpp"
