#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace aeolian {

/// The whole content of a file, without a byte-order mark. Throws Error "WHAT 'path': the system's reason".
std::string read_text(const std::string& path, const std::string& what);

/// Takes the next line off the front of `rest`, without its line end (LF or CRLF).
std::string_view take_line(std::string_view& rest);

/// Without blanks and tabs at either end.
std::string_view trimmed(std::string_view text);

std::string lower_case(std::string_view text);

/// The extension of a file name in lower case, without the dot.
std::string extension_of(const std::string& path);

/// A decimal number, "nan" or "inf" that fills the whole text; nothing for anything else.
std::optional<double> parse_number(std::string_view text);

/// Appends the fewest digits that read back to the same number.
void append_number(std::string& text, double value);
void append_number(std::string& text, float value);

}  // namespace aeolian
