#include "aeolian_twin/photo/photo_files.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

bool is_photo(const fs::directory_entry& entry) {
  static const std::set<std::string> extensions = {"jpg", "jpeg", "png", "tif", "tiff"};
  const std::string stem = entry.path().stem().string();
  const std::string overlay = "_overlay";
  const bool drawn = stem.size() > overlay.size() &&
                     stem.compare(stem.size() - overlay.size(), overlay.size(), overlay) == 0;
  return entry.is_regular_file() && extensions.count(extension_of(entry.path().string())) > 0 && !drawn;
}

PhotoFiles photos_in(const std::string& folder) {
  PhotoFiles photos{folder, {}};
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (is_photo(entry)) photos.files.push_back(entry.path().string());
  if (error) throw Error("folder '" + folder + "': " + error.message());
  if (photos.files.empty()) throw Error("folder '" + folder + "': has no JPEG, PNG or TIFF photo");
  std::sort(photos.files.begin(), photos.files.end());
  return photos;
}

}  // namespace

std::string output_stem(const std::string& photo, const std::string& out) {
  const fs::path path(photo);
  const fs::path folder = out.empty() ? path.parent_path() : fs::path(out);
  return (folder / path.stem()).lexically_normal().string();
}

std::vector<PhotoFiles> list_photos(const std::vector<std::string>& arguments, const std::string& out) {
  std::vector<PhotoFiles> list;
  list.reserve(arguments.size());
  for (const std::string& argument : arguments)
    list.push_back(fs::is_directory(argument) ? photos_in(argument) : PhotoFiles{"", {argument}});
  std::map<std::string, std::string> writers;
  for (const PhotoFiles& photos : list)
    for (const std::string& file : photos.files)
      if (const auto [other, first] = writers.emplace(output_stem(file, out), file); !first)
        throw Error("photos '" + other->second + "' and '" + file + "': would both write " + other->first +
                    "_profile.csv");
  return list;
}

}  // namespace aeolian
