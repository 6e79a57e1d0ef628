#include "extract/io/names.h"

#include <gtest/gtest.h>

namespace stride {
namespace {

enum class Fruit { apple, pear, plum };

constexpr Names<Fruit> kFruits({{Fruit::apple, "an apple"},
                                {Fruit::pear, "pear"},
                                {Fruit::plum, "plum"}});

static_assert(enumerator_count<Fruit>() == 3);
static_assert(kFruits[Fruit::pear] == "pear");

TEST(Names, AreFoundBothWays) {
  for (const auto& [value, name] : kFruits) {
    EXPECT_EQ(kFruits[value], name);
    EXPECT_EQ(kFruits.find(name), value);
  }
  EXPECT_EQ(kFruits.find("apple"), std::nullopt);
  EXPECT_EQ(kFruits.find(""), std::nullopt);
}

TEST(Names, AreListedForMessages) {
  EXPECT_EQ(kFruits.list(), "an apple, pear, plum");
  EXPECT_EQ(kFruits.list(" or "), "an apple, pear or plum");
}

}  // namespace
}  // namespace stride
