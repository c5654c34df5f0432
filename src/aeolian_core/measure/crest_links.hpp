#pragma once

#include <vector>

#include "aeolian_core/measure/crest_rows.hpp"

namespace aeolian {

/// A crest of one row, by its number there.
struct RowPlace {
  int row = 0;
  int crest = 0;
};

/// Joins the crests of neighbouring rows into lines: each goes on to the nearest crest whose nearest it is,
/// not farther than the steepest crest would lead or a fifth of a wavelength [samples]. A line goes on after
/// `gap` rows without a crest at most.
std::vector<std::vector<RowPlace>> link_rows(const std::vector<std::vector<RowCrest>>& rows,
                                             double wavelength, int gap);

/// Joins lines that face each other: one's last crest and another's first that are nearest to each other and
/// less than `distance` apart [samples], sideways half of that. Where they overlap the first goes on to its
/// end.
std::vector<std::vector<RowPlace>> join_facing(const std::vector<std::vector<RowCrest>>& rows,
                                               const std::vector<std::vector<RowPlace>>& lines,
                                               double distance);

}  // namespace aeolian
