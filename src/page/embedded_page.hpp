#pragma once

#include <string_view>

namespace contensou::page {

/// The page that was built with the program, one HTML file; empty if none was (CONTENSOU_PAGE).
std::string_view embedded_page();

}  // namespace contensou::page
