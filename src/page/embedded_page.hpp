#pragma once

#include <string_view>

namespace contensou::page {

/// Returns the page, one HTML file, that was built into the program; empty without CONTENSOU_PAGE.
std::string_view embedded_page();

}  // namespace contensou::page
