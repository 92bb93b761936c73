#include "options/output_options.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/portraits/layout.hpp"
#include "output/help.hpp"
#include "platform/descriptor.hpp"
#include "platform/output_file.hpp"

namespace contensou::program {

namespace {

constexpr long standard_digits = 6, max_threads = 1024;

bool is_one_of(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// Returns the formats of a kind as file endings.
std::string endings_of(const OutputKind& kind) {
  std::vector<std::string> endings = kind.formats;
  std::ranges::replace(endings, std::string("text"), std::string("txt"));
  return fmt::format("{}", fmt::join(endings, ", "));
}

/// Returns the part of a file name after its last dot; empty without a dot.
std::string ending_of(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension.empty() ? extension : extension.substr(1);
}

}  // namespace

std::vector<std::string> with_pictures(std::vector<std::string> first, const std::vector<std::string>& last) {
  std::erase(first, "tex");
  for (std::string_view picture : portraits::picture_formats()) first.emplace_back(picture);
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

ExitStatus Output::write(std::string_view content) const {
  write_output(path, content);
  return ExitStatus::done;
}

ExitStatus Output::write(const Answer& answer) const {
  write(render(answer, format, digits));
  return answer.passed ? ExitStatus::done : ExitStatus::check_failed;
}

ExitStatus Output::write(const std::vector<portraits::Figure>& figures) const {
  return write(drawn(figures, picture.value()));
}

namespace {

/// Prints once that the font is not installed, and which font replaces it.
void tell_substitute(const std::string& font) {
  static std::once_flag told;
  std::call_once(told, [&] {
    const std::string substitute = portraits::substitute_of(font);
    if (substitute.empty()) return;
    std::cerr << fmt::format("contensou: --font {}: no such font is installed; drawn in {}\n", quotation(font),
                             substitute);
  });
}

}  // namespace

std::string drawn(const std::vector<portraits::Figure>& figures, portraits::PictureFormat format) {
  using enum portraits::PictureFormat;
  const std::string& font = figures.front().font;
  if (!font.empty() && format != svg && format != gp && format != tex) tell_substitute(font);
  try {
    return format == portraits::PictureFormat::gif ? portraits::render_film(figures)
                                                   : portraits::render(figures.front(), format);
  } catch (const portraits::GnuplotError& error) {
    throw FileFailure(error.what());
  }
}

std::string usual_group() { return shared_group("Output in general", "output"); }

void OutputOptions::add(CLI::App& app) {
  app.option_defaults()->group("Output");
  const OutputKind& usual = kinds_.front();
  std::string endings, formats;
  bool has_text = false;
  for (const OutputKind& kind : kinds_) {
    const std::string which = &kind == &usual ? "" : fmt::format("; for {}: ", kind.noun);
    endings += which + endings_of(kind);
    formats += fmt::format("{}{} (default {})", which, fmt::join(kind.formats, ", "), kind.standard);
    has_text = has_text || is_one_of(kind.formats, "text");
  }
  file_.add(app, "-o,--output", "FILE",
            fmt::format("output file (default {}); allowed endings: {}",
                        usual.path == "-"                 ? "-, standard output"
                        : is_one_of(usual.formats, "csv") ? usual.path + ", or -, standard output, for numbers"
                                                          : usual.path,
                        endings));
  app.option_defaults()->group(usual_group());
  format_.add(app, "--format", "FORMAT", "format of an output without an ending: " + formats);
  if (!has_text) return;
  digits_.add(app, "--digits", "N",
              fmt::format("significant digits in text and in a table of tex, 1 to 17 (default {})", standard_digits),
              whole_number(1, 17));
}

Output OutputOptions::read(std::size_t place) const {
  const OutputKind& kind = kinds_.at(place);
  const std::string path = file_.given() ? file_.text() : default_path(kind);
  if (path.empty()) throw BadInput("-o '': a file name is needed, or - for standard output");
  const std::string format = read_format(kind, path);
  const bool has_rounded_text = is_one_of(kind.formats, "text") && is_one_of(kind.formats, "csv");  // not run files
  const auto picture = is_one_of(kind.formats, "svg") ? portraits::find_picture_format(format) : std::nullopt;
  if (digits_.given() && !((format == "text" || (format == "tex" && !picture)) && has_rounded_text)) {
    digits_.reject(
        picture ? "a picture has no digits"
        : has_rounded_text
            ? fmt::format("{} always has all digits; choose text, with --format text or the ending txt", format)
            : fmt::format("{} always has all digits: leave it out", kind.noun));
  }
  return {path, format, picture, {static_cast<int>(digits_.value_or(standard_digits))}};
}

std::string OutputOptions::default_path(const OutputKind& kind) const {
  if (kind.path == "-" || !format_.given() || format_.text() == ending_of(kind.path)) return kind.path;
  if (!portraits::find_picture_format(format_.text())) return "-";
  return std::filesystem::path(kind.path).replace_extension(format_.text()).string();
}

std::string OutputOptions::read_format(const OutputKind& kind, const std::string& path) const {
  if (format_.given() && !is_one_of(kind.formats, format_.text())) {
    format_.reject(no_such("format", format_.text(), kind.formats, false));
  }
  const std::string ending = path == "-" ? "" : ending_of(path);
  const std::string by_ending = ending == "txt" ? "text" : ending;
  const bool guessable = path == "-" || kind.formats.size() == 1 || is_one_of(kind.formats, "text");
  if (by_ending.empty() ? !format_.given() && !guessable : ending == "text" || !is_one_of(kind.formats, by_ending)) {
    file_.reject(fmt::format("{} is written as {}, not as {}", kind.noun, endings_of(kind), quotation(ending)));
  }
  if (by_ending.empty()) return format_.given() ? format_.text() : kind.standard;
  if (format_.given() && format_.text() != by_ending) {
    format_.reject(fmt::format("the file {} says otherwise: leave out one of them", path));
  }
  return by_ending;
}

namespace {

constexpr double min_side = 40, max_side = 2000;
constexpr double single_column = 85, double_column = 170;

portraits::AskedSize parse_size(const std::string& typed) {
  if (typed == "single") return {single_column, {}};
  if (typed == "double") return {double_column, {}};
  constexpr const char* wanted = "single, double, or width and height in mm are needed, as in 180x120";
  const std::size_t cross = typed.find('x');
  if (cross == std::string::npos) throw NotAllowed(wanted);
  std::vector<double> sides;
  try {
    sides = {parse_number(typed.substr(0, cross)), parse_number(typed.substr(cross + 1))};
  } catch (const BadInput& error) {
    throw NotAllowed("{}; {}", error.what(), wanted);
  }
  for (double side : sides) {
    if (side >= min_side && side <= max_side) continue;
    throw NotAllowed("width and height must be {} to {} mm", min_side, max_side);
  }
  return {sides[0], sides[1]};
}

std::string parse_font(const std::string& typed) {
  // Picture formats would take other characters for the end of the name of the font.
  const auto forbidden = [](char c) {
    return static_cast<unsigned char>(c) < ' ' || std::string_view("'\",;:<>&\\").find(c) != std::string_view::npos;
  };
  if (typed.empty() || std::ranges::any_of(typed, forbidden))
    throw NotAllowed("the name of a font is needed, as in 'DejaVu Serif'");
  return typed;
}

}  // namespace

std::string figure_group() { return shared_group("Size and font of the picture", "picture"); }

void FigureOptions::add(CLI::App& app, bool several) {
  app.option_defaults()->group(figure_group());
  size_.add(app, "--size", "WxH",
            fmt::format("width and height in millimetres, each {} to {}; or the word single or double, the width of a "
                        "column ({} mm) or a page ({} mm) of a journal",
                        min_side, max_side, single_column, double_column),
            parse_size);
  font_.add(app, "--font", "NAME", "font of svg, pdf, png, eps and gif (default sans-serif)", parse_font);
  if (several) return;
  title_.add(app, "--title", "TEXT", "title of the figure; the word none removes title and subtitle");
  dpi_.add(app, "--dpi", "N", "resolution of a png in dots per inch, 50 to 1200 (default 300)", whole_number(50, 1200));
}

void require_picture(const std::string& names, const Output& output) {
  if (names.empty() || output.picture) return;
  throw BadInput("{}: {} is no picture; leave that out, or write one, as in -o figure.svg", names, output.format);
}

portraits::Figure FigureOptions::apply(portraits::Figure figure, const std::string& format) const {
  if (title_.given()) {
    figure.title = title_.text() == "none" ? "" : portraits::shortened(title_.text(), 200);
    figure.subtitle = "";
  }
  if (font_.given() && format == "tex")
    font_.reject("a tex has the font of the document that it stands in: leave it out");
  figure.font = font_.value_or("");
  if (dpi_.given() && format != "png") dpi_.reject(fmt::format("a {} has no dots: leave it out", format));
  figure.dpi = static_cast<double>(dpi_.value_or(static_cast<long>(figure.dpi)));
  return size().height_mm ? figure : portraits::trimmed(std::move(figure));
}

void BulkOptions::add(CLI::App& app) {
  app.option_defaults()->group(usual_group());
  threads_.add(app, "--threads", "N", "number of threads (default: all cores); results do not depend on this number",
               whole_number(1, max_threads));
  progress_.add(app, "--progress", "WHEN",
                "progress on standard error: always, never, or auto (default), which means for long work on a terminal",
                one_of<std::optional<ShowProgress>>(
                    {{"auto", std::nullopt}, {"always", ShowProgress::always}, {"never", ShowProgress::never}}));
}

int BulkOptions::threads() const {
  const long cores = std::thread::hardware_concurrency();
  return static_cast<int>(threads_.value_or(std::clamp(cores, 1L, max_threads)));
}

ShowProgress BulkOptions::progress(const std::string& output) const {
  return progress_.value_or(std::nullopt).value_or(progress_if_watched(output));
}

ShowProgress progress_if_watched(const std::string& output) {
  const bool watched = is_terminal(Stream::error) && (output != "-" || !is_terminal(Stream::output));
  return watched ? ShowProgress::of_long_work : ShowProgress::never;
}

}  // namespace contensou::program
