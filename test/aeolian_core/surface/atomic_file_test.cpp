#include "aeolian_core/surface/atomic_file.hpp"

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(WriteAtomically, ReplacesTheWholeFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "a longer old content");
  write_text_atomically(path, "new");
  EXPECT_EQ(content_of(path), "new");
  EXPECT_EQ(folder.count_files(), 1U);
}

TEST(WriteAtomically, GivesATemporaryPathBesideWithTheSameExtension) {
  const TemporaryFolder folder;
  write_atomically(folder.file("map.tif"), [&](const std::string& temporary) {
    EXPECT_EQ(std::filesystem::path(temporary).parent_path(), folder.path());
    EXPECT_EQ(std::filesystem::path(temporary).extension(), ".tif");
    EXPECT_FALSE(std::filesystem::exists(folder.file("map.tif")));
  });
  EXPECT_TRUE(std::filesystem::exists(folder.file("map.tif")));
}

TEST(WriteAtomically, KeepsTheOldFileWhenTheWriterThrows) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "old");
  EXPECT_THROW(write_atomically(path,
                                [](const std::string& temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw std::runtime_error("the writer failed");
                                }),
               std::runtime_error);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(folder.count_files(), 1U) << "the temporary file is gone";
}

TEST(WriteAtomically, NamesThePathAndTheReasonWhenItCannotWrite) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  const auto reason = [](const std::string& path) {
    return error_of([&] { write_text_atomically(path, "text"); });
  };
  EXPECT_EQ(reason(file + "/x.txt"), "cannot write '" + file + "/x.txt': Not a directory");
  EXPECT_EQ(reason(folder.file("none/x.txt")),
            "cannot write '" + folder.file("none/x.txt") + "': No such file or directory");
  EXPECT_EQ(reason("/proc/x.txt"), "cannot write '/proc/x.txt': No such file or directory");
  EXPECT_EQ(reason(folder.path()), "cannot write '" + folder.path() + "': Is a directory");
}

TEST(MakeDirectory, MakesParentsAndAcceptsWhatIsThere) {
  const TemporaryFolder folder;
  make_directory(folder.file("a/b/c"));
  make_directory(folder.file("a/b/c"));
  EXPECT_TRUE(std::filesystem::is_directory(folder.file("a/b/c")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("a/b/c")));
}

TEST(MakeDirectory, NamesThePathAndTheReasonWhenItCannot) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  EXPECT_NE(error_of([&] { make_directory(file + "/x"); }).find(file + "/x': Not a directory"),
            std::string::npos);
  EXPECT_NE(error_of([] { make_directory("/proc"); }).find("cannot write '/proc"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
