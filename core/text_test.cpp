#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json/json.h"
#include "core/text.h"

namespace cuticle::text_test {
namespace {

TEST(Printable, WordsOfEveryScript_AreKept) {
  for (const char* text : {"", "hair.tfx: 7 strands", "Häärchen 毛 \xf0\x9f\x92\x87", "a\\b 'c' \"d\""})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, WhatATerminalObeys_IsShownAsNumbers) {
  EXPECT_EQ(printable("\x1b[31mred\r\n\x7f"), "\\x1b[31mred\\x0d\\n\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m")
      << "CSI as one character";
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u202eb")
      << "right to left from here";
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
}

TEST(Printable, BytesThatAreNoUtf8_AreShownAsNumbers) {
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "overlong";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair of UTF-16";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond U+10FFFF";
  EXPECT_EQ(printable("a\xe6\xaf"), "a\\xe6\\xaf") << "cut short";
}

TEST(Printable, LongText_IsCutBetweenCharactersAndSaysSo) {
  EXPECT_EQ(printable("abcdef", 3), "abc.. (3 more bytes)");
  EXPECT_EQ(printable("\xc3\xa4\xc3\xa4", 3), "\xc3\xa4\xc3\xa4");
  EXPECT_LT(printable(std::string(5 << 20, 'k')).size(), 2100u);
}

TEST(Printable, EveryPairOfBytes_IsJsonAfterwards) {
  for (int a = 0; a < 256; ++a)
    for (int b = 0; b < 256; b += 7) {
      const std::string shown = printable(std::string{char(a), char(b), 'x'});
      EXPECT_EQ(Json::parse(Json(shown).dump())->text(), shown);
    }
}

}  // namespace
}  // namespace cuticle::text_test
