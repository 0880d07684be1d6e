// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Scene files with random damage are scenes or InputErrors, never anything else.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/base/random.h"
#include "semslam/render/scenes.h"

#include "support/sanitized.h"

namespace semslam {
namespace {

std::size_t Below(Random& random, std::size_t count) {
  return count == 0 ? 0 : random.Index(static_cast<std::uint32_t>(count));
}

// The next number in the text from a random place on: first letter and length.
std::pair<std::size_t, std::size_t> RandomNumber(const std::string& text, Random& random) {
  const std::size_t first = text.find_first_of("0123456789", Below(random, text.size()));
  if (first == std::string::npos) return {0, 0};
  const std::size_t end = std::min(text.find_first_not_of("0123456789.", first), text.size());
  return {first, end - first};
}

void Damage(std::string& text, Random& random) {
  const char* const numbers[] = {"0",   "-1",    "1e9", "1e-30", "nan",    "inf", "-0",
                                 "999", "1e400", "0.5", "x",     "[1, 2]", "{}",  "$i"};
  const std::string marks = "[]{},:-#&*!|>'\"%@`$ \n\t\\0aA";
  switch (random.Index(7)) {
    case 0:
    case 1:
    case 2: {
      const auto [first, length] = RandomNumber(text, random);
      text.replace(first, length, numbers[random.Index(std::size(numbers))]);
      break;
    }
    case 3:
      text[Below(random, text.size())] = marks[Below(random, marks.size())];
      break;
    case 4:
      text.erase(Below(random, text.size()), Below(random, 20));
      break;
    case 5: {
      const std::string piece = text.substr(Below(random, text.size()), Below(random, 120));
      text.insert(Below(random, text.size()), piece);
      break;
    }
    default:
      text[Below(random, text.size())] = static_cast<char>(random.Index(256));
  }
  if (text.empty()) text = "a";
}

class DamagedScene : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All,
                         DamagedScene,
                         ::testing::ValuesIn(SceneNames()),
                         [](const auto& test) { return test.param; });

TEST_P(DamagedScene, IsASceneOrAnInputError) {
  Random random(17);
  int num_errors = 0;
  constexpr int kTrials = testing::NumTrials(150);
  for (int i = 0; i < kTrials; ++i) {
    std::string text = SceneText(GetParam());
    const std::size_t num_damages = 1 + Below(random, 4);
    for (std::size_t k = 0; k < num_damages; ++k) Damage(text, random);
    try {
      ParseScene(text, "damaged.yaml", random());
    } catch (const InputError& error) {
      ++num_errors;
      const std::string what = error.what();
      ASSERT_EQ(what.find('\n'), std::string::npos) << what;
      ASSERT_EQ(what.find("damaged.yaml:"), 0U) << what;
    }
  }
  EXPECT_GT(num_errors, kTrials / 10);
  EXPECT_LT(num_errors, kTrials);
}

}  // namespace
}  // namespace semslam
