#include "extract/io/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "extract/io/error.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

using testing::ElementsAre;

TEST(Csv, SaysWhereAByteOfATextIs) {
  EXPECT_EQ(place_of_byte("ab\ncd", 0), "line 1, column 1");
  EXPECT_EQ(place_of_byte("ab\ncd", 3), "line 2, column 1");
  EXPECT_EQ(place_of_byte("ab\ncd", 4), "line 2, column 2");
  EXPECT_EQ(place_of_byte("", 9), "line 1, column 1");
}

TEST(Csv, ReadsWhateverASpreadsheetMakesOfATable) {
  const std::string utf16 = {'\xff', '\xfe', 'x', 0,   ',', 0,   'y', 0,    '\n',
                             0,      '1',    0,   ',', 0,   '2', 0,   '\n', 0};
  for (const std::string& text :
       {std::string("x,y\n1,2\n"), std::string("x;y\r\n1;2\r\n"), std::string("x\ty\r1\t2"),
        std::string("\xef\xbb\xbfx,y\n1,2"), std::string("\"x\",\"y\"\n\"1\",\"2\"\n"),
        std::string("x,y,\n1,2,\n"), std::string("x,y\n1,2,,\n"), std::string("\n x , y \n\n1,2\n"),
        utf16}) {
    SCOPED_TRACE(text);
    const TextTable table = read_text_table(text, "t.csv");
    ASSERT_EQ(table.lines.size(), 2u);
    EXPECT_THAT(table.lines[0].cells, ElementsAre("x", "y"));
    EXPECT_THAT(table.lines[1].cells, ElementsAre("1", "2"));
  }
}

TEST(Csv, TakesADecimalCommaForOneWhereTheCommaDoesNotSeparate) {
  const TextTable table = read_text_table("Time;\"knee, right/0/X\"\n0,033;-3,5e-1\n", "t.csv");
  EXPECT_THAT(table.lines[0].cells, ElementsAre("Time", "knee, right/0/X"));
  EXPECT_THAT(table.lines[1].cells, ElementsAre("0.033", "-3.5e-1"));
}

TEST(Csv, KeepsCommentsApartWithTheNumberOfTheirLine) {
  const TextTable table = read_text_table("# unit: px,\n\nx\n1\n", "t.csv");
  ASSERT_EQ(table.comments.size(), 1u);
  EXPECT_EQ(table.comments[0].cells[0], "unit: px");
  EXPECT_EQ(table.lines[0].number, 3);
}

TEST(Csv, TakesEverySpellingOfAMissingNumberForNone) {
  for (const char* none : {"", " ", "nan", "NaN", "-nan", "NA", "N/A", "n/a", "null", "NULL",
                           "None", "<NA>", "#N/A"}) {
    const auto value = cell_number(none);
    ASSERT_TRUE(value.has_value()) << none;
    EXPECT_TRUE(std::isnan(*value)) << none;
  }
  EXPECT_EQ(cell_number("+1.5"), 1.5);
  for (const char* text : {"x", "1.5px", "1,5", "inf", "--1"}) EXPECT_FALSE(cell_number(text));
}

TEST(Csv, NamesBrokenUtf16) {
  EXPECT_ERROR(read_text_table(std::string("\xff\xfe\x00\xd8x", 5), "t.csv"),
               "t.csv: is in UTF-16, broken after");
}

}  // namespace
}  // namespace stride
