#pragma once

#include <optional>
#include <string>

#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "options/argument.hpp"
#include "options/law_option.hpp"

namespace contensou::program {

/// What a portrait shows and how it looks.
class PortraitOptions {
 public:
  void add(CLI::App& app);

  /// The names that were given, joined; empty if none was.
  std::string given_names() const;

  /// The request's view, window, orbits, isochrones, points and rival law.
  /// @throws BadInput  for a point outside the window, and as LawOption::read
  void read(portraits::PortraitRequest& request) const;

  portraits::PortraitStyle style() const;

 private:
  using Style = portraits::PortraitStyle;

  struct Size {
    double width_mm, height_mm;
  };

  static reduction::State parse_point(const std::string& typed);
  static portraits::Window parse_window(const std::string& typed);
  static Size parse_size(const std::string& typed);

  ArgumentOf<portraits::View> view_;
  ArgumentOf<portraits::Window> window_;
  ArgumentOf<long> orbits_, isochrones_;
  ArgumentOf<reduction::State> through_;
  ArgumentOf<Style::Arrows> arrows_;
  ArgumentOf<Style::Field> field_;
  ArgumentOf<bool> axes_, colour_, style_;
  ArgumentOf<Size> size_;
  LawOption against_;
};

}  // namespace contensou::program
