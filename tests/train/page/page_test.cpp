#include "train/page/page.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "extract/annotation/labelled_clip.h"
#include "extract/io/data_file.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "train/page/html.h"

namespace stride::page {
namespace {

/// Everything that an HTML file names to be loaded.
std::vector<std::string> loaded(const std::string& html) {
  std::vector<std::string> names;
  const std::regex attribute("(src|href|poster|data)=\"([^\"]{0,30})");
  for (std::sregex_iterator it(html.begin(), html.end(), attribute), end; it != end; ++it)
    names.push_back((*it)[2]);
  return names;
}

void expect_self_contained(const std::string& html) {
  for (const std::string& name : loaded(html)) EXPECT_TRUE(name.starts_with("data:")) << name;
  for (const char* forbidden : {"<script", "<link", "@import", "url(http"})
    EXPECT_EQ(html.find(forbidden), std::string::npos) << forbidden;
  EXPECT_NE(html.find("width=device-width"), std::string::npos);
}

TEST(Html, TextIsEscaped) { EXPECT_EQ(escaped("a<b & \"c\">"), "a&lt;b &amp; &quot;c&quot;&gt;"); }

TEST(Html, BytesBecomeBase64) {
  EXPECT_EQ(data_uri("any carnal pleas", "png"), "data:image/png;base64,YW55IGNhcm5hbCBwbGVhcw==");
  EXPECT_EQ(data_uri("", "svg"), "data:image/svg+xml;base64,");
  EXPECT_THROW(data_uri("x", "exe"), Error);
}

TEST(Html, MarkdownTablesListsAndParagraphs) {
  const std::string html = markdown(
      "# Title\n\nSome `code` of **weight**.\n\n| a | b |\n|---|---|\n| 1 | <2> |\n\n- x\n- y\n");
  EXPECT_NE(html.find("<p>Some <code>code</code> of <strong>weight</strong>.</p>"),
            std::string::npos);
  EXPECT_NE(html.find("<th> a </th>"), std::string::npos);
  EXPECT_NE(html.find("<td> &lt;2&gt; </td>"), std::string::npos);
  EXPECT_NE(html.find("<ul>\n<li>x</li>\n<li>y</li>\n</ul>"), std::string::npos);
  EXPECT_EQ(html.find("|---|"), std::string::npos);
}

TEST(Page, OfARunTellsDistanceGaitAndCurve) {
  const std::string html = run_page(data_file("train/agents/stride"));
  expect_self_contained(html);
  EXPECT_NE(html.find("It comes 44.8 m far (1 episode, 0 falls)"), std::string::npos);
  EXPECT_NE(html.find("inside"), std::string::npos);
  EXPECT_NE(html.find("data:video/mp4"), std::string::npos);
  EXPECT_NE(html.find("data:image/svg+xml"), std::string::npos);
  EXPECT_NE(html.find("action_repeat = 3"), std::string::npos);
}

TEST(Page, OfARunRefusesAnEvaluationOfOthers) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "config.toml", "");
  for (const char* other :
       {"[1, 2]", "3", "{\"format\": 1}",
        "{\"format\": \"stride-evaluation\", \"falls\": \"none\"}",
        "{\"format\": \"stride-evaluation\", \"gait\": {\"cadence_per_min\": 1}, "
        "\"human_at_this_speed\": {\"cadence_per_min\": []}}"}) {
    write_file_atomically(folder / "evaluation.json", other);
    EXPECT_ERROR(page_of(folder.path(), ""), "evaluation.json: not what stride evaluate writes");
  }
}

TEST(Page, OfAJumpShowsTheFlight) {
  const TemporaryFolder folder;
  const std::filesystem::path video = data_file("videos/jump.mp4");
  const std::filesystem::path clicks = data_file("videos/jump.keypoints.json");
  save(tracking::track(video, tracking::clicks_on(video, clicks, 0)).trajectory,
       folder / "jump.trajectory.csv");
  const std::string html = page_of(folder / "jump.trajectory.csv", video);
  expect_self_contained(html);
  for (const char* part : {"<p class=\"verdict\">Verdict: ok.</p>", "<h2>The flight</h2>",
                           "take-off forward", "data:image/svg+xml", "do not count"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(Page, OfAnExperimentHasItsTablesAndFigures) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "results.md",
                        "# Two arms\n\n| arm | 1 k |\n|---|---|\n| a | 3 |\n");
  write_file_atomically(folder / "decisions.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
  const std::string html = page_of(folder.path(), {});
  expect_self_contained(html);
  EXPECT_NE(html.find("<h1>Two arms</h1>"), std::string::npos);
  EXPECT_NE(html.find("<td> 3 </td>"), std::string::npos);
}

TEST(Page, WhatItIsNotAboutIsToldWithTheCure) {
  const TemporaryFolder folder;
  EXPECT_ERROR(page_of(folder / "none", {}), "no such file or folder");
  EXPECT_ERROR(page_of(folder.path(), {}), "neither a run folder");
  write_file_atomically(folder / "config.toml", "");
  EXPECT_ERROR(page_of(folder.path(), {}), "has not been evaluated; `stride evaluate");
  write_file_atomically(folder / "clip.mp4", "");
  EXPECT_ERROR(page_of(folder / "clip.mp4", {}), "make one with `stride track`");
}

}  // namespace
}  // namespace stride::page
