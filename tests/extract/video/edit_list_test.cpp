#include "extract/video/edit_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>

#include "extract/tracking/time_check.h"
#include "extract/video/container.h"
#include "tests/support/temporary_folder.h"

namespace stride::video {
namespace {

using testing::HasSubstr;

std::string bytes(std::uint64_t value, int count) {
  std::string text;
  for (int i = count - 1; i >= 0; --i) text += static_cast<char>(value >> 8 * i & 255);
  return text;
}
std::string box(const std::string& name, const std::string& content) {
  return bytes(content.size() + 8, 4) + name + content;
}

struct Entry {
  double lasts_s, from_s;  // from < 0: nothing is shown
  double rate = 1;
};

/// A movie of 1000 units a second with a sound and a video track of 600; `wide`: version 1.
std::string moov(const std::vector<Entry>& entries, bool wide = false) {
  const int each = wide ? 8 : 4;
  std::string list = bytes(wide ? 1U << 24 : 0, 4) + bytes(entries.size(), 4);
  for (const Entry& e : entries)
    list +=
        bytes(static_cast<std::uint64_t>(1000 * e.lasts_s), each) +
        bytes(e.from_s < 0 ? ~std::uint64_t{0} : static_cast<std::uint64_t>(600 * e.from_s), each) +
        bytes(static_cast<std::uint64_t>(65536 * e.rate), 4);
  const auto track = [&](const std::string& kind, const std::string& edits) {
    return box("trak", edits + box("mdia", box("mdhd", std::string(12, '\0') + bytes(600, 4) +
                                                           std::string(8, '\0')) +
                                               box("hdlr", std::string(8, '\0') + kind)));
  };
  return box("mvhd", std::string(12, '\0') + bytes(1000, 4)) + track("soun", "") +
         track("vide", box("edts", box("elst", list)));
}

TEST(EditList, IsReadInBothWidths) {
  for (const bool wide : {false, true}) {
    const auto edits = edits_in(moov({{0.5, -1}, {2, 1.5, 0.25}}, wide));
    ASSERT_EQ(edits.size(), 2u);
    EXPECT_TRUE(std::isnan(edits[0].from_s));
    EXPECT_DOUBLE_EQ(edits[1].lasts_s, 2);
    EXPECT_DOUBLE_EQ(edits[1].from_s, 1.5);
    EXPECT_DOUBLE_EQ(edits[1].rate, 0.25);
  }
}

TEST(EditList, OfAPlainRecordingSaysNothing) {
  EXPECT_EQ(text_of(std::vector<Edit>{}), "");
  EXPECT_EQ(text_of(edits_in(moov({{4, 0.083}}))), "");  // B-frames: it starts two frames on
  EXPECT_EQ(text_of(edits_in(moov({{0.02, -1}, {4, 0}}))), "");  // priming of the sound
  EXPECT_EQ(text_of(edits_in(moov({{1, 0}, {3, 1}}))), "");      // pieces that follow one another
}

TEST(EditList, TellsWhatPlayersMakeOfTheTime) {
  EXPECT_EQ(text_of(edits_in(moov({{1, 0}, {4, 1, 0.25}}))),
            "4 s play at 0.25 times the recorded speed");
  EXPECT_EQ(text_of(edits_in(moov({{1, 0}, {1, 2}}))),
            "a cut at 1 s, from 1 s of the recording to 2 s");
  EXPECT_EQ(text_of(edits_in(moov({{0.5, -1}, {2, 0}}))), "nothing is shown for 0.5 s from 0 s");
  EXPECT_EQ(text_of(edits_in(moov({{0.5, 0}, {2, 0.5, 0}}))), "one picture stands for 2 s");
}

TEST(EditList, OfManyPiecesTellsTheFirst) {
  std::vector<Entry> pieces;
  for (int i = 0; i < 157; ++i) pieces.push_back({3.2, 0});
  EXPECT_EQ(text_of(edits_in(moov(pieces))),
            "a cut at 3.2 s, from 3.2 s of the recording to 0 s; "
            "a cut at 6.4 s, from 3.2 s of the recording to 0 s; "
            "a cut at 9.6 s, from 3.2 s of the recording to 0 s; and 153 more of the kind");
}

TEST(EditList, IsToldWithACure) {
  using tracking::doubt_of_edits;
  EXPECT_THAT(doubt_of_edits(edits_in(moov({{4, 0, 0.25}}))), HasSubstr("-ignore_editlist 1"));
  EXPECT_THAT(doubt_of_edits(edits_in(moov({{1, 0}, {1, 2}}))), HasSubstr("trim the clip"));
  EXPECT_EQ(doubt_of_edits(edits_in(moov({{4, 0}}))), "");
}

TEST(EditList, ThatIsCutOffOrAbsurdIsNone) {
  const std::string whole = moov({{1, 0}, {4, 1, 0.25}});
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_LE(edits_in(whole.substr(0, size)).size(), 2u);
  EXPECT_TRUE(edits_in(box("mvhd", std::string(20, '\0'))).empty());  // no units
}

TEST(EditList, IsFoundBehindTheFramesOfAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.mov", std::ios::binary)
      << box("ftyp", "qt  ") << box("mdat", std::string(1000, 'x'))
      << box("moov", moov({{2, 0, 0.5}}));
  ASSERT_EQ(read_edits(folder / "a.mov").size(), 1u);
  EXPECT_DOUBLE_EQ(read_edits(folder / "a.mov")[0].rate, 0.5);
  EXPECT_TRUE(read_edits(folder / "none.mov").empty());
}

}  // namespace
}  // namespace stride::video
