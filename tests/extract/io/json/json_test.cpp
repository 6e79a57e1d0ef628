#include "extract/io/json/json.h"

#include <gtest/gtest.h>

#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(JsonText, ReadsBackWithNamesThatAreNotUtf8) {
  const nlohmann::ordered_json json{{"file", "caf\xe9.mp4"}, {"x", 0.1}};
  const std::string text = json_text(json);
  EXPECT_EQ(text, "{\n \"file\": \"caf\uFFFD.mp4\",\n \"x\": 0.1\n}\n");
  EXPECT_EQ(parse_json(text, "a.json", "a test")["x"], 0.1);
}

TEST(JsonText, WhatIsWrongIsToldWithItsPlace) {
  EXPECT_ERROR(parse_json("{\n \"x\": }", "a.json", "a potential"),
               "a.json: not valid JSON at line 2, column 7: expected a potential");
  EXPECT_ERROR(parse_json("", "a.json", "a potential"), "a.json: not valid JSON at line 1");
  EXPECT_ERROR(parse_json("[1e999]", "a.json", "a potential"),
               "a.json: not valid JSON: a number is too large");
}

}  // namespace
}  // namespace stride
