#include "extract/io/file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/throws.h"

namespace stride {
namespace {

// RFC 4648, section 10, and what FIPS 180 says of "abc".
TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of(std::string_view("\0\xff", 2)), "AP8=");
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

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
