#pragma once

#include <functional>
#include <string>

namespace aeolian {

/// Writes a file beside its place and renames it: at every moment `path` is the old file or the whole new
/// one.
///
/// `write` gets the temporary path (same directory, same extension) and writes the file. If it throws, the
/// temporary file is removed and `path` is untouched. Throws Error naming the path and the system's reason
/// when the directory does not exist or cannot be written.
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

/// The same for text that is at hand.
void write_text_atomically(const std::string& path, const std::string& text);

/// Creates a directory and its parents; throws Error with the system's reason when that fails or it cannot be
/// written.
void make_directory(const std::string& path);

}  // namespace aeolian
