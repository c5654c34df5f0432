#pragma once

#include <string>

namespace aeolian {

/// How a quantity is told to a person: its SI value times `factor`, with the unit's name behind.
struct Unit {
  double factor;
  std::string name;
};

/// A unit that suits lengths up to `largest` [m]: mm, cm or m.
Unit length_unit(double largest);
/// A unit that suits volumes up to `largest` [m^3]: cm³, litres or m³.
Unit volume_unit(double largest);
/// A unit that suits times up to `largest` [s]: s, min or h.
Unit time_unit(double largest);

/// Three significant digits, three decimals at most; "not available" for NaN.
std::string number_text(double value);
/// The same with the unit behind.
std::string quantity_text(double value, const Unit& unit);
/// A length in the unit that suits it.
std::string length_text(double metres);
/// With its sign and two decimals; "not available" for NaN.
std::string skill_text(double skill);
/// "45 s", "2 min", "2 min 30 s", "1 h 5 min".
std::string duration_text(double seconds);
/// With &, <, > and " in a form that HTML shows as they are.
std::string escape_html(const std::string& text);

}  // namespace aeolian
