# One HTML file from the template, the style and the bundle of modules and compiled library; and that file as a string of
# C++.
#   cmake -D TEMPLATE= -D STYLE= -D BUNDLE= -D VERSION= -D PAGE= -D EMBEDDED= -P assemble.cmake
cmake_minimum_required(VERSION 3.25)

file(READ ${TEMPLATE} html)
foreach(part IN ITEMS STYLE BUNDLE)
  file(READ ${${part}} text)
  if(text MATCHES "</(script|style)")
    message(FATAL_ERROR "${${part}} holds an end tag and cannot stand inside a page")
  endif()
  string(REPLACE "/*${part}*/" "${text}" html "${html}")
endforeach()
string(REPLACE "@VERSION@" "${VERSION}" html "${html}")
file(WRITE ${PAGE} "${html}")

file(READ ${PAGE} hex HEX)
string(REGEX REPLACE "(..)" "\\\\x\\1" literal "${hex}")
string(LENGTH "${hex}" digits)
math(EXPR bytes "${digits} / 2")
file(WRITE ${EMBEDDED} "#include \"embedded_page.hpp\"\n
namespace contensou::page {\n
std::string_view embedded_page() {
  static constexpr char page[] = \"${literal}\";
  return {page, ${bytes}};
}\n
}  // namespace contensou::page\n")
