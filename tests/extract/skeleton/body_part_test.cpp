#include "extract/skeleton/body_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/throws.h"

namespace stride {
namespace {

using testing::ElementsAre;

TEST(BodyPart, NamesLeadBackToTheParts) {
  for (const BodyPart part : kBodyParts) EXPECT_EQ(body_part(name(part)), part);
  EXPECT_ERROR(body_part("elbow"), "body part 'elbow': not known; use one of pelvis, knee_r, ");
}

TEST(BodyPart, RightAndLeftDifferInTheirSideAlone) {
  for (const BodyPartRow& right : kBodyPartRows) {
    const BodyPartRow& left = row(right.mirrored);
    EXPECT_EQ(side_of(right.part), -side_of(left.part)) << right.name;
    EXPECT_EQ(right.required, left.required) << right.name;
    EXPECT_EQ(right.prompt, left.prompt) << right.name;
    EXPECT_EQ(right.nouns, left.nouns) << right.name;
    EXPECT_EQ(right.osim_body.substr(0, right.osim_body.rfind('_')),
              left.osim_body.substr(0, left.osim_body.rfind('_')));
  }
}

TEST(BodyPart, EachHasAnIndexOfItsOwnInBody25) {
  std::set<int> indices;
  for (const BodyPartRow& each : kBodyPartRows) indices.insert(each.body_25);
  EXPECT_EQ(indices.size(), kBodyPartRows.size());
  EXPECT_LT(*indices.rbegin(), 25);
}

TEST(BodyPart, BonesLeadFromThePelvisToToesAndHeels) {
  std::vector<std::pair<BodyPart, BodyPart>> bones;
  for (const auto& [from, to] : kBones) bones.emplace_back(from, to);
  using enum BodyPart;
  EXPECT_THAT(bones, ElementsAre(std::pair(pelvis, knee_r), std::pair(knee_r, ankle_r),
                                 std::pair(ankle_r, toe_r), std::pair(pelvis, knee_l),
                                 std::pair(knee_l, ankle_l), std::pair(ankle_l, toe_l),
                                 std::pair(ankle_r, heel_r), std::pair(ankle_l, heel_l)));
}

}  // namespace
}  // namespace stride
