# Makes one HTML file from the template, the style, and the bundle of modules and library; then a C++ string of it.
#   cmake -D TEMPLATE= -D STYLE= -D BUNDLE= -D MODULES= -D LIBRARY= -D VERSION= -D ROOT= -D PAGE= -D EMBEDDED= -P assemble.cmake
cmake_minimum_required(VERSION 3.25)

file(READ ${TEMPLATE} html)
string(REGEX REPLACE "\n +" "\n" html "${html}")
foreach(part IN ITEMS STYLE BUNDLE)
  file(READ ${${part}} text)
  if(text MATCHES "</(script|style)")
    message(FATAL_ERROR "${${part}} holds an end tag and cannot stand inside a page")
  endif()
  string(REPLACE "/*${part}*/" "${text}" html "${html}")
endforeach()
string(REPLACE "@VERSION@" "${VERSION}" html "${html}")
foreach(part IN ITEMS MODULES LIBRARY)
  file(READ ${${part}} text)
  string(REPLACE "@${part}@" "${text}" html "${html}")
endforeach()
# Insert the licences as a comment. For Apache-2.0 and MPL-2.0 the address suffices, so their texts are left out.
file(READ ${ROOT}/LICENSE licence)
file(READ ${ROOT}/.github/THIRD_PARTY.txt others)
string(REGEX REPLACE "=+\nBSD-3-Clause\n=.*" "" others "${others}")
# Leave out the libraries that are not inside the page, the explanation of the list, and the text of MIT, which is that of LICENSE.
string(REGEX REPLACE "[^\n]+\n  Source:[^\n]*\n  Licence:[^\n]*\n  Inside:    (program|program, python|python|Windows|site)\n(  [^\n]+\n)+\n" ""
  others "${others}")
string(REGEX REPLACE "\n  Inside:[^\n]*" "" others "${others}")
string(REGEX REPLACE "^.*mozilla.org/MPL/2.0.\n" "This page contains parts of the libraries in this list, compiled. The text of MIT stands above the list, those of the other licences below,
those of Apache-2.0 and MPL-2.0 at apache.org/licenses/LICENSE-2.0 and at mozilla.org/MPL/2.0.\n" others "${others}")
string(REGEX REPLACE "\n +" "\n" others "${others}")
string(REGEX REPLACE "=+\nMIT\n=+\n[^=]*" "" others "${others}")
string(REPLACE "</html>\n" "<!--\n${licence}\n${others}-->\n</html>\n" html "${html}")
file(WRITE ${PAGE} "${html}")

# Clang warns of strings that other compilers need not support.
file(WRITE ${EMBEDDED} "#include \"embedded_page.hpp\"\n
#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n
std::string_view contensou::page::embedded_page() {
  using namespace std::literals;
  return R\"PAGE(${html})PAGE\"sv;
}\n")
