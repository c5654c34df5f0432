#pragma once

#include <string>

#include <cairo/cairo.h>

#include "aeolian_core/measure/photo_setup.hpp"

namespace aeolian {

/// A paper strip for the straightedge's top face: markers of DICT_4X4_50 and a scale, on pages of A4 in
/// pieces to be put end to end.
///
/// Its upper border is the casting edge (y = 0), x runs to the right from its left end; the markers' centres
/// stand at y < 0.
class PrintedStrip {
 public:
  /// At least so long [m], with markers of that size [m]. Throws Error for a size outside of 5 to 100 mm and
  /// for a length that needs more than the dictionary's 50 markers.
  PrintedStrip(double length, double marker_size);

  double length() const { return pitch_ * static_cast<double>(markers_.centres.size()); }
  double width() const;
  std::size_t pieces() const;
  const PhotoSetup::Markers& markers() const { return markers_; }
  /// The section of the setup file that says where the markers are.
  std::string yaml() const;

  std::size_t pages() const;
  /// Draws a page (from 0) at 1 unit per millimetre, from the upper left corner of A4 landscape.
  void draw(cairo_t* cairo, std::size_t page) const;

 private:
  PhotoSetup::Markers markers_;
  double pitch_ = 0;  ///< from marker to marker [m]
};

/// Writes the strip at true size, and its yaml() beside it under the same name with .yaml. Gives the path of
/// the latter.
std::string write_strip(const PrintedStrip& strip, const std::string& pdf);

}  // namespace aeolian
