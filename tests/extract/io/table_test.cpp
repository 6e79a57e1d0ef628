#include "extract/io/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "extract/io/csv.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(Table, ReadsBackEveryDoubleAsItWas) {
  const TemporaryFolder folder;
  Table table;
  table.format = "trajectory";
  table.set_meta("unit", "px");
  table.columns = {"a", "b"};
  table.rows = {{0.1, 1e-300}, {std::nan(""), -1.0 / 3.0}};
  save(table, folder / "t.csv");
  const Table loaded = load_table(folder / "t.csv", "trajectory", 1);
  EXPECT_EQ(loaded.meta("unit"), "px");
  EXPECT_EQ(loaded.columns, table.columns);
  EXPECT_EQ(loaded.rows[0], table.rows[0]);
  EXPECT_TRUE(std::isnan(loaded.rows[1][0]));
  EXPECT_EQ(loaded.rows[1][1], table.rows[1][1]);
}

TEST(Table, ReadsBackEveryTextAsItWas) {
  const TemporaryFolder folder;
  Table table;
  table.format = "trajectory";
  table.columns = {"a"};
  const std::vector<std::string> texts{"run.mp4",
                                       "two\nlines",
                                       "# stride calibrated 1\n# verdict: ok",
                                       " blank ",
                                       "tab\t",
                                       "a, b;",
                                       "back\\slash",
                                       "\"quoted\"",
                                       "it's \"quoted\"",
                                       "\r",
                                       "\x1b[2J",
                                       "caf\xe9 \n",
                                       "走る",
                                       "a: b",
                                       "\\n",
                                       ""};
  for (std::size_t i = 0; i < texts.size(); ++i) table.set_meta(std::to_string(i), texts[i]);
  save(table, folder / "t.csv");
  const Table loaded = load_table(folder / "t.csv", "trajectory", 1);
  EXPECT_EQ(loaded.metadata, table.metadata);
  EXPECT_EQ(loaded.columns, table.columns);
}

TEST(Table, WritesOrdinaryTextsAsTheyAreAndReadsOlderFiles) {
  for (const char* text : {"run 1.mp4", "back\\slash.mp4", "it's \"so\"", "-0.5", "走る.mp4"}) {
    EXPECT_EQ(one_line(text), text);
    EXPECT_EQ(from_one_line(text), text);
  }
  // Quotes that are no escaped text belong to the name.
  for (const char* text : {"\"", "\"a\\q\"", "\"a\"b\"", "\"a\\\"", "\"\\xg0\"", "\"\\x1\""})
    EXPECT_EQ(from_one_line(text), text);
  EXPECT_EQ(one_line("a\nb"), "\"a\\nb\"");
}

TEST(Table, NamesFileLineColumnAndValueOfABadCell) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "t.csv", "# stride trajectory 1\na,b\n1,2\n3,four\n");
  EXPECT_ERROR(load_csv(folder / "t.csv"), "t.csv:4: column b = 'four': must be a number or empty");
}

TEST(Table, RefusesAnotherFormatAndANewerVersion) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "t.csv", "# stride calibrated 9\na\n1\n");
  EXPECT_ERROR(load_table(folder / "t.csv", "trajectory", 1),
               "is a stride calibrated file, a trajectory file is needed");
  EXPECT_ERROR(load_table(folder / "t.csv", "calibrated", 1),
               "calibrated version 9: this program reads up to version 1");
}

TEST(Table, RefusesRaggedRowsAndRepeatedColumns) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "t.csv", "a,b\n1\n");
  EXPECT_ERROR(load_csv(folder / "t.csv"), "t.csv:2: 1 cells, but the header names 2 columns");
  write_file_atomically(folder / "t.csv", "a,a\n1,2\n");
  EXPECT_ERROR(load_csv(folder / "t.csv"), "column 'a' appears twice");
}

TEST(File, HashesLikeSha256sum) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "f", "abc");  // FIPS 180-2, appendix B.1
  EXPECT_EQ(sha256_of_file(folder / "f"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(File, LeavesTheOldFileWhenTheNewOneCannotBeWritten) {
  EXPECT_ERROR(write_file_atomically("/proc/nowhere/f", "x"), "/proc/nowhere/f");
}

}  // namespace
}  // namespace stride
