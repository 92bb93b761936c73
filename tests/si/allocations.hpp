#pragma once

/// Returns the number of calls of operator new in this program.
long allocations();
