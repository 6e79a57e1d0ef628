#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "extract/io/error.h"

/// The statement throws stride::Error whose message contains `text`.
#define EXPECT_ERROR(statement, text)                                      \
  do {                                                                     \
    try {                                                                  \
      (void)(statement);                                                   \
      ADD_FAILURE() << #statement " throws nothing; expected: " << (text); \
    } catch (const ::stride::Error& error) {                               \
      EXPECT_THAT(std::string(error.what()), ::testing::HasSubstr(text));  \
    }                                                                      \
  } while (false)
