// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/config/settings_file.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/files.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using testing::InputErrorOf;
using testing::TemporaryFolder;

SettingsFile File(const std::string& lines) { return {"s.yaml", "%YAML:1.0\n" + lines}; }

// What reading the key `k` of a file with the line "k: value" as T throws.
template <typename T>
std::string ErrorOf(const std::string& value, const NumberRange& range = {}) {
  SettingsFile file = File("k: " + value + "\n");
  T read{};
  return InputErrorOf([&] { file.Require("k", &read, range); });
}

template <typename T>
T ValueOf(const std::string& value) {
  SettingsFile file = File("k: " + value + "\n");
  T read{};
  file.Require("k", &read);
  return read;
}

TEST(SettingsFile, ReadsNumbers) {
  EXPECT_EQ(ValueOf<double>("517.306408"), 517.306408);
  EXPECT_EQ(ValueOf<double>("-0.7   # comment"), -0.7);
  EXPECT_EQ(ValueOf<double>("+5e2"), 500);
  EXPECT_EQ(ValueOf<double>(".5"), 0.5);
  EXPECT_EQ(ValueOf<double>("8"), 8);
}

TEST(SettingsFile, ReadsAnIntegerAlsoIfItIsWrittenAsAReal) {
  EXPECT_EQ(ValueOf<int>("8"), 8);
  EXPECT_EQ(ValueOf<int>("8.0"), 8);
  EXPECT_EQ(ValueOf<int>("-3"), -3);
}

TEST(SettingsFile, RejectsARealWhereAnIntegerIsExpected) {
  EXPECT_EQ(ErrorOf<int>("8.5"), "s.yaml: k: expected an integer, found 8.5");
}

TEST(SettingsFile, RejectsAnIntegerThatDoesNotFit) {
  EXPECT_EQ(ErrorOf<int>("99999999999"),
            "s.yaml: k: expected an integer from -2147483648 to 2147483647, found 99999999999");
}

TEST(SettingsFile, SaysWhatIsAllowed) {
  EXPECT_EQ(ErrorOf<double>("-517.3", NumberRange::Positive()),
            "s.yaml: k: expected a number > 0, found -517.3");
  EXPECT_EQ(ErrorOf<double>("0", NumberRange::Positive()),
            "s.yaml: k: expected a number > 0, found 0");
  EXPECT_EQ(ErrorOf<double>("-1", NumberRange::AtLeast(0)),
            "s.yaml: k: expected a number >= 0, found -1");
  EXPECT_EQ(ErrorOf<int>("40", NumberRange::Between(1, 32)),
            "s.yaml: k: expected an integer from 1 to 32, found 40");
}

TEST(SettingsFile, RejectsWhatIsNoNumber) {
  for (const char* bad : {"abc", "12abc", "1.2.3", "517,3", "\"8\"", "true", "0x10", "1 2"}) {
    EXPECT_EQ(ErrorOf<double>(bad), std::string("s.yaml: k: expected a number, found ") + bad);
  }
}

TEST(SettingsFile, RejectsNumbersThatAreNotFinite) {
  for (const char* bad : {"nan", ".nan", "inf", "-inf", ".Inf", "1e400"}) {
    EXPECT_EQ(ErrorOf<double>(bad), std::string("s.yaml: k: expected a number, found ") + bad);
  }
}

TEST(SettingsFile, ReadsSwitches) {
  EXPECT_TRUE(ValueOf<bool>("1"));
  EXPECT_TRUE(ValueOf<bool>("true"));
  EXPECT_FALSE(ValueOf<bool>("0"));
  EXPECT_FALSE(ValueOf<bool>("False"));
  SettingsFile file = File("k: 2\n");
  bool value = false;
  EXPECT_EQ(InputErrorOf([&] { file.Read("k", &value); }),
            "s.yaml: k: expected 0, 1, true or false, found 2");
}

TEST(SettingsFile, ReadsTextWithAndWithoutQuotes) {
  EXPECT_EQ(ValueOf<std::string>("models/a b.weights  # comment"), "models/a b.weights");
  EXPECT_EQ(ValueOf<std::string>("\"a # b: c\""), "a # b: c");
  EXPECT_EQ(ValueOf<std::string>("C:/a.cfg"), "C:/a.cfg");
}

TEST(SettingsFile, LeavesTheDefaultOfAKeyThatIsNotThere) {
  SettingsFile file = File("a: 1\n");
  int value = 7;
  file.Read("k", &value);
  EXPECT_EQ(value, 7);
}

TEST(SettingsFile, NamesAKeyThatIsMissing) {
  SettingsFile file = File("something.else: 1\n");
  double value = 0;
  EXPECT_EQ(InputErrorOf([&] { file.Require("Camera.fx", &value); }), "s.yaml: Camera.fx: missing");
}

TEST(SettingsFile, NamesTheKeyThatWasProbablyMeant) {
  SettingsFile file = File("Camera.fy: 1\nCamera.Fx: 1\n");
  double value = 0;
  file.Require("Camera.fy", &value);
  EXPECT_EQ(InputErrorOf([&] { file.Require("Camera.fx", &value); }),
            "s.yaml: Camera.fx: missing; is it meant by Camera.Fx in line 3?");
}

TEST(SettingsFile, ListsWhatNobodyAskedForInTheOrderOfTheFile) {
  SettingsFile file = File("z: 1\nb: 2\na: 3\nViewer.PointSize: 2\n");
  int value = 0;
  file.Read("b", &value);
  EXPECT_THAT(file.UnknownKeys(),
              ElementsAre("s.yaml: line 2: z: unknown key", "s.yaml: line 4: a: unknown key"));
}

TEST(SettingsFile, RejectsAKeyGivenTwice) {
  EXPECT_EQ(InputErrorOf([] { File("a: 1\nb: 1\na: 2\n"); }),
            "s.yaml: a: given twice, in lines 2 and 4");
}

TEST(SettingsFile, RejectsAKeyWithoutValue) {
  EXPECT_EQ(InputErrorOf([] { File("a: # nothing\nb: 1\n"); }),
            "s.yaml: a: expected a value, found nothing");
}

TEST(SettingsFile, RejectsALineWithoutColon) {
  EXPECT_EQ(InputErrorOf([] { File("Camera.fx 517.3\n"); }),
            "s.yaml: line 2: expected `key: value`, found Camera.fx 517.3");
}

TEST(SettingsFile, RejectsAnotherFirstLine) {
  EXPECT_EQ(InputErrorOf([] { SettingsFile("s.yaml", "Camera.fx: 517.3\n"); }),
            "s.yaml: line 1: expected %YAML:1.0, found Camera.fx: 517.3");
  EXPECT_EQ(InputErrorOf([] { SettingsFile("s.yaml", ""); }),
            "s.yaml: line 1: expected %YAML:1.0, found nothing");
}

TEST(SettingsFile, RejectsAFileOfBytesWithoutMeaning) {
  const std::string text = InputErrorOf([] { File(std::string("\x01\x02\xff{{{[[\0\n", 10)); });
  EXPECT_TRUE(text.starts_with("s.yaml: line 2: expected `key: value`, found ??")) << text;
}

TEST(SettingsFile, PassesOverAMatrixThatNobodyReads) {
  SettingsFile file =
      File("M: !!opencv-matrix\n   rows: 1\n   cols: 1\n   dt: d\n   data: [ 1. ]\nk: 2\n");
  int value = 0;
  file.Require("k", &value);
  EXPECT_EQ(value, 2);
}

TEST(SettingsFile, RejectsAMatrixWhereANumberIsExpected) {
  SettingsFile file = File("k:\n   x: 1\n");
  double value = 0;
  EXPECT_EQ(InputErrorOf([&] { file.Require("k", &value); }),
            "s.yaml: k: expected a number, found a list or a matrix");
}

TEST(SettingsFile, RejectsAnIndentedLineAfterAValue) {
  EXPECT_EQ(InputErrorOf([] { File("a: 1\n  b: 2\n"); }),
            "s.yaml: line 3: expected `key: value`, found an indented line");
}

TEST(SettingsFile, TakesWindowsLineEndsAndAByteOrderMark) {
  SettingsFile file("s.yaml", "\xef\xbb\xbf%YAML:1.0\r\n---\r\nk: 2\r\n\r\n");
  int value = 0;
  file.Require("k", &value);
  EXPECT_EQ(value, 2);
}

TEST(SettingsFile, SaysThatTheFileIsMissing) {
  EXPECT_EQ(InputErrorOf([] { SettingsFile(std::filesystem::path("/no/such.yaml")); }),
            "/no/such.yaml: cannot read settings: No such file or directory");
}

TEST(SettingsFile, SaysThatAFolderIsNoFile) {
  EXPECT_EQ(InputErrorOf([] { SettingsFile(std::filesystem::path("/tmp")); }),
            "/tmp: expected a settings file, found a folder");
}

}  // namespace
}  // namespace semslam
