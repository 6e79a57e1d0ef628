#include "extract/io/gnuplot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "extract/io/error.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(Gnuplot, PrintsAnyTextAsItIsAndRunsNothingInIt) {
  const TemporaryFolder folder;
  for (const std::string text :
       {"run`touch ran`.mp4", "run$(touch ran).mp4", "O'Brien's", "'", "''a''", "a'''; touch ran;'",
        "a\"b\\n", "; touch ran", "%s%n@macro", "| touch ran", "<touch ran", "un_der^score{}",
        "Zoë 走る"})
    EXPECT_EQ(run_gnuplot("set print '-'\nprint " + gnuplot_string(text), folder.path()),
              text + "\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Gnuplot, TakesNoLineEndForTheEndOfATitle) {
  EXPECT_EQ(gnuplot_string("a\nsystem 'touch ran'\r"), R"('a system '."'".'touch ran'."'".' ')");
}

TEST(Gnuplot, WritesToAFileWhoseNameLooksLikeACommand) {
  const TemporaryFolder folder;
  for (const std::string name : {"|touch ran", "<touch ran", "a`touch ran`'b.csv"})
    run_gnuplot("set table " + gnuplot_file(name) + "\nplot [0:1] x\n", folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / "ran"));
  EXPECT_TRUE(std::filesystem::exists(folder / "|touch ran"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a`touch ran`'b.csv"));
  EXPECT_ERROR(gnuplot_file("a\nb"), "must not hold a line end");
}

TEST(Gnuplot, SaysWhatItComplainedAbout) {
  EXPECT_ERROR(run_gnuplot("plot nothing_of_that_name\n"), "undefined variable");
}

}  // namespace
}  // namespace stride
