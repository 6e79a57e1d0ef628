#include "extract/io/toml.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/throws.h"

namespace stride {
namespace {

using Words = std::vector<std::string>;

TEST(Toml, IsReadInTheOrderOfTheFile) {
  const auto settings = parse_toml(
      "zoom = 2\n"
      "[clip.one]\n"
      "name = \"a # b\"  # the rest is a comment\n"
      "height = 1.750\n"
      "[agent]\n"
      "hidden = [64, 32]\n"
      "a.b = true\n",
      "x");
  ASSERT_EQ(settings.size(), 5U);
  EXPECT_EQ(settings[0].key(), "zoom");
  EXPECT_EQ(settings[0].words, Words{"2"});
  EXPECT_EQ(settings[1].section, (Words{"clip", "one"}));
  EXPECT_EQ(settings[1].words, Words{"a # b"});
  EXPECT_EQ(settings[1].line, 3);
  EXPECT_EQ(settings[2].words, Words{"1.75"});
  EXPECT_EQ(settings[3].words, (Words{"64", "32"}));
  EXPECT_EQ(settings[4].key(), "agent.a.b");
  EXPECT_EQ(settings[4].words, Words{"true"});
}

TEST(Toml, NumbersReadBackAsTheSame) {
  for (const double number : {0.1, 1e-300, 1.0 / 3, 12345678.9, 2e22})
    EXPECT_EQ(std::stod(parse_toml(fmt::format("x = {:.17e}", number), "x")[0].words[0]), number);
  EXPECT_EQ(parse_toml("x = 9223372036854775807", "x")[0].words[0], "9223372036854775807");
}

TEST(Toml, TextsReadBackAsTheSame) {
  for (const std::string& text : {std::string("O'Brien"), std::string("a \"b\" \\c"),
                                  std::string("line\nbreak\t\x7f"), std::string("ü 走 # x")})
    EXPECT_EQ(parse_toml("x = " + toml_text(text), "x")[0].words[0], text);
  EXPECT_EQ(toml_text("plain"), "\"plain\"");
  EXPECT_EQ(parse_toml("x = " + toml_text("caf\xe9.mp4"), "x")[0].words[0], "caf\xef\xbf\xbd.mp4");
}

TEST(Toml, LettersOutsideAsciiAreInQuotesOrComments) {
  const auto settings = parse_toml(
      "\xef\xbb\xbf# größe \"\n\"größe\" = 'lé' # \ufe7f '\nx = \"a\\\"\ufe7f\"\n"
      "y = '''\n走'''\nz = \"\" # ü\n",
      "x");
  ASSERT_EQ(settings.size(), 4U);
  EXPECT_EQ(settings[0].name, "größe");
  EXPECT_EQ(settings[1].words[0], "a\"\ufe7f");
  for (const char* bare : {"größe = 1", "a\ufe7fb = 1", "a = 1 \u3000", "[clip.ü]"})
    EXPECT_ERROR(parse_toml(std::string("x = 'a'\n") + bare, "s.toml"),
                 "s.toml:2: not TOML: a letter outside ASCII must be in quotes");
}

TEST(Toml, ErrorsNameTheLine) {
  EXPECT_ERROR(parse_toml("a = 1\nb = half\n", "f.toml"), "f.toml:2: not TOML");
  EXPECT_ERROR(parse_toml("a = 1\n\na = 2\n", "f.toml"), "f.toml:3: not TOML");
  EXPECT_ERROR(parse_toml("a = 1\n[ = 2\n", "f.toml"), "f.toml:2: not TOML");
  EXPECT_ERROR(parse_toml("a = 1\nday = 2026-01-02\n", "f.toml"), "f.toml:2: must be a number");
  EXPECT_ERROR(parse_toml("a = [[1], 2]\n", "f.toml"), "f.toml:1: must be a number");
}

}  // namespace
}  // namespace stride
