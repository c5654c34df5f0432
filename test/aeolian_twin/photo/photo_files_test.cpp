#include "aeolian_twin/photo/photo_files.hpp"

#include <filesystem>

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(PhotoFiles, AFolderHoldsPhotosInOrderOfTheirNames) {
  const TemporaryFolder folder;
  for (const char* name :
       {"b.JPG", "a.png", "c.tiff", "a_overlay.jpg", "a_profile.csv", "notes.txt", ".hidden"})
    folder.write(name, "");
  std::filesystem::create_directory(folder.file("folder.jpg"));
  const auto list = list_photos({folder.path(), "x/single.jpg"}, "");
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].folder, folder.path());
  EXPECT_EQ(list[0].files,
            (std::vector<std::string>{folder.file("a.png"), folder.file("b.JPG"), folder.file("c.tiff")}));
  EXPECT_EQ(list[1].folder, "");
  EXPECT_EQ(list[1].files, std::vector<std::string>{"x/single.jpg"});
}

TEST(PhotoFiles, ResultsLieBesideThePhotoOrInTheFolderAskedFor) {
  EXPECT_EQ(output_stem("a/b/photo.one.jpg", ""), "a/b/photo.one");
  EXPECT_EQ(output_stem("./photo.jpg", ""), "photo");
  EXPECT_EQ(output_stem("a/photo.jpg", "out/"), "out/photo");
}

TEST(PhotoFiles, NoTwoPhotosWriteTheSameFiles) {
  EXPECT_EQ(error_of([] {
              list_photos({"a/x.jpg", "b/x.jpg"}, "out");
            }),
            "photos 'a/x.jpg' and 'b/x.jpg': would both write out/x_profile.csv");
  EXPECT_EQ(error_of([] {
              list_photos({"x.jpg", "./x.tif"}, "");
            }),
            "photos 'x.jpg' and './x.tif': would both write x_profile.csv");
  EXPECT_EQ(list_photos({"a/x.jpg", "b/x.jpg"}, "").size(), 2U);
}

}  // namespace
}  // namespace aeolian
