// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "semslam/base/error.h"
#include "semslam/place/vocabulary.h"
#include "semslam/place/vocabulary_training.h"

#include "place/random_descriptors.h"

namespace semslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class VocabularyFileTest : public testing::Test {
 protected:
  VocabularyFileTest() {
    folder_ =
        fs::temp_directory_path() / ("semslam_vocabulary_" + std::to_string(::getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  ~VocabularyFileTest() override { fs::remove_all(folder_); }

  static std::string Read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void Write(const std::string& content) const {
    std::ofstream(path(), std::ios::binary) << content;
  }
  fs::path path() const { return folder_ / "vocabulary"; }

  // The text of the error, which must be an InputError of one line that names the file.
  std::string LoadError(const std::string& content) const {
    Write(content);
    try {
      Vocabulary::Load(path());
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_THAT(text, HasSubstr(path().string()));
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      return text;
    }
    return "no error";
  }

  const Vocabulary vocabulary_ =
      TrainVocabulary(RandomPlaces(3, 2, 40, 1), {.branching = 3, .depth = 3}, 1);
  fs::path folder_;
};

void ExpectSame(const Vocabulary& a, const Vocabulary& b) {
  EXPECT_EQ(a.branching(), b.branching());
  EXPECT_EQ(a.depth(), b.depth());
  EXPECT_EQ(a.num_words(), b.num_words());
  ASSERT_EQ(a.nodes().size(), b.nodes().size());
  for (std::size_t i = 0; i < a.nodes().size(); ++i) {
    EXPECT_EQ(a.nodes()[i].first_child, b.nodes()[i].first_child);
    EXPECT_EQ(a.nodes()[i].num_children, b.nodes()[i].num_children);
    EXPECT_EQ(a.nodes()[i].weight, b.nodes()[i].weight);
    EXPECT_EQ(a.descriptors()[i], b.descriptors()[i]);
  }
}

TEST_F(VocabularyFileTest, BinaryGivesTheSameBack) {
  vocabulary_.SaveBinary(path());
  ExpectSame(Vocabulary::Load(path()), vocabulary_);
}

TEST_F(VocabularyFileTest, TextGivesTheSameBack) {
  vocabulary_.SaveText(path());
  ExpectSame(Vocabulary::Load(path()), vocabulary_);
}

TEST_F(VocabularyFileTest, ReadsTextWhoseNodesComeDepthFirst) {
  // As the stock file has them; with a word's weight in the notation with an exponent, blanks at
  // the ends of lines, and carriage returns.
  const auto line = [](int parent, int leaf, int grey, const std::string& weight) {
    std::string text = std::to_string(parent) + " " + std::to_string(leaf);
    for (int i = 0; i < 32; ++i) text += " " + std::to_string(grey + i);
    return text + " " + weight + " \r\n";
  };
  Write("2 2 0 0\n" + line(0, 0, 10, "0") + line(0, 0, 20, "0") + line(1, 1, 11, "1.5") +
        line(1, 1, 12, "2.5e-1") + line(2, 1, 21, "3"));
  const Vocabulary vocabulary = Vocabulary::Load(path());
  EXPECT_EQ(vocabulary.num_words(), 3u);
  ASSERT_EQ(vocabulary.nodes().size(), 6u);
  EXPECT_EQ(vocabulary.nodes()[4].weight, 0.25F);
  EXPECT_EQ(vocabulary.descriptors()[5].bits[0] & 0xffff, 21u + (22u << 8));
  EXPECT_EQ(vocabulary.nodes()[1].num_children, 2u);
  EXPECT_EQ(vocabulary.nodes()[2].first_child, 5u);
}

TEST_F(VocabularyFileTest, CopiesStayUsableWhenTheFirstIsGone) {
  vocabulary_.SaveBinary(path());
  auto first = std::make_unique<Vocabulary>(Vocabulary::Load(path()));
  const Vocabulary copy = *first;
  first.reset();
  ExpectSame(copy, vocabulary_);
}

TEST_F(VocabularyFileTest, RefusesABinaryCutAnywhere) {
  vocabulary_.SaveBinary(path());
  const std::string whole = Read(path());
  for (std::size_t size = 0; size < whole.size(); size += size < 200 ? 1 : 97) {
    EXPECT_NE(LoadError(whole.substr(0, size)), "no error") << "cut to " << size << " bytes";
  }
  EXPECT_NE(LoadError(whole + '\0'), "no error");
}

TEST_F(VocabularyFileTest, RefusesABinaryWithAnyByteChanged) {
  vocabulary_.SaveBinary(path());
  const std::string whole = Read(path());
  for (std::size_t i = 0; i < whole.size(); i += i < 200 ? 1 : 13) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    EXPECT_NE(LoadError(changed), "no error") << "byte " << i;
  }
}

TEST_F(VocabularyFileTest, RefusesATextCutInsideALine) {
  vocabulary_.SaveText(path());
  const std::string whole = Read(path());
  for (std::size_t size = 0; size < whole.size(); size += size < 300 ? 1 : 101) {
    if (size > 0 && whole[size - 1] == '\n') continue;
    EXPECT_NE(LoadError(whole.substr(0, size)), "no error") << "cut to " << size << " bytes";
  }
}

TEST_F(VocabularyFileTest, NeverCrashesOnATextWithAnyByteChanged) {
  vocabulary_.SaveText(path());
  const std::string whole = Read(path());
  for (std::size_t i = 0; i < whole.size(); i += 7) {
    std::string changed = whole;
    changed[i] = static_cast<char>(i * 31 + 5);
    LoadError(changed);  // An error, or another vocabulary; checks the form of the error.
  }
}

TEST_F(VocabularyFileTest, SaysWhatIsWrongAndWhere) {
  std::string numbers;
  for (int i = 0; i < 32; ++i) numbers += " 7";
  EXPECT_THAT(LoadError(""), HasSubstr("no content"));
  EXPECT_THAT(LoadError("hello"), HasSubstr("found neither"));
  EXPECT_THAT(LoadError("10 6 0 0\n"), HasSubstr("found none"));
  EXPECT_THAT(LoadError("10 6 1 0\n"), HasSubstr(":1: scoring"));
  EXPECT_THAT(LoadError("10 99 0 0\n"), HasSubstr(":1: depth"));
  EXPECT_THAT(LoadError("99999999999999999999 6 0 0\n"), HasSubstr(":1: branching"));
  EXPECT_THAT(LoadError("10 6 0 0\n5 1" + numbers + " 1\n"), HasSubstr(":2: parent"));
  EXPECT_THAT(LoadError("10 6 0 0\n0 1" + numbers + " nan\n"), HasSubstr(":2: weight"));
  EXPECT_THAT(LoadError("10 6 0 0\n0 1" + numbers + " -1\n"), HasSubstr(":2: weight"));
  EXPECT_THAT(LoadError("10 6 0 0\n0 1 256\n"), HasSubstr(":2: descriptor"));
  EXPECT_THAT(LoadError("10 6 0 0\n0 0" + numbers + " 0\n"), HasSubstr("without children"));
  EXPECT_THAT(LoadError("10 6 0 0\n0 1" + numbers + " 1\n1 1" + numbers + " 1\n"),
              HasSubstr(":3: parent: expected an inner node"));
  EXPECT_THAT(LoadError("2 1 0 0\n0 0" + numbers + " 0\n1 1" + numbers + " 1\n"),
              HasSubstr("below level 1"));
  EXPECT_THROW(Vocabulary::Load(folder_ / "missing"), InputError);
  EXPECT_THROW(Vocabulary::Load(folder_), InputError);
}

TEST_F(VocabularyFileTest, NamesAVersionItDoesNotKnow) {
  vocabulary_.SaveBinary(path());
  std::string content = Read(path());
  content[8] = 9;
  EXPECT_THAT(LoadError(content), HasSubstr("expected version 1 of the format, found 9"));
}

TEST_F(VocabularyFileTest, SaysThatAFileCannotBeWritten) {
  EXPECT_THROW(vocabulary_.SaveBinary(folder_ / "missing" / "orb.voc"), InputError);
}

}  // namespace
}  // namespace semslam
