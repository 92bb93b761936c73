#include "embedded_page.hpp"

namespace contensou::page {

std::string_view embedded_page() { return {}; }

}  // namespace contensou::page
