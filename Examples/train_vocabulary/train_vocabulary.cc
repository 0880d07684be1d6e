// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Trains a vocabulary from folders of images, or converts one between text and binary:
//   train_vocabulary orb.voc recording1/rgb recording2/rgb
//   train_vocabulary orb.voc --from ORBvoc.txt
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "semslam/base/error.h"
#include "semslam/base/parallel.h"
#include "semslam/base/stopwatch.h"
#include "semslam/features/orb_extractor.h"
#include "semslam/place/vocabulary.h"
#include "semslam/place/vocabulary_training.h"

namespace semslam {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string output;
  std::vector<std::string> folders;
  std::string from;
  std::string text;
  int step = 1;
  int num_features = 1000;
  int num_threads = 0;
  VocabularyTrainingOptions training;
};

bool IsImage(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

// Every step-th image of the folder, by name.
std::vector<fs::path> ListImages(const fs::path& folder, int step) {
  if (!fs::is_directory(folder))
    throw InputError(folder.string() + ": expected a folder of images");
  std::vector<fs::path> all;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && IsImage(entry.path())) all.push_back(entry.path());
  }
  if (all.empty()) throw InputError(folder.string() + ": expected PNG or JPEG images, found none");
  std::sort(all.begin(), all.end());
  std::vector<fs::path> images;
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(step)) {
    images.push_back(all[i]);
  }
  return images;
}

std::vector<std::vector<Descriptor>> ExtractAll(const Arguments& arguments) {
  std::vector<fs::path> files;
  for (const std::string& folder : arguments.folders) {
    const std::vector<fs::path> images = ListImages(folder, arguments.step);
    files.insert(files.end(), images.begin(), images.end());
  }
  const OrbExtractor extractor({.num_features = arguments.num_features});
  std::vector<std::vector<Descriptor>> descriptors(files.size());
  constexpr std::size_t kBatch = 32;
  for (std::size_t begin = 0; begin < files.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, files.size());
    ParallelFor(end - begin, 1, arguments.num_threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = begin + first; i < begin + last; ++i) {
        const cv::Mat image = cv::imread(files[i].string(), cv::IMREAD_GRAYSCALE);
        if (image.empty()) throw InputError(files[i].string() + ": cannot be read as an image");
        descriptors[i] = extractor.Extract(image).descriptors;
      }
    });
    std::fprintf(stderr, "\rfeatures of %zu / %zu images", end, files.size());
  }
  std::fprintf(stderr, "\n");
  return descriptors;
}

Vocabulary Train(const Arguments& arguments) {
  const std::vector<std::vector<Descriptor>> images = ExtractAll(arguments);
  std::size_t num_descriptors = 0;
  for (const auto& image : images) num_descriptors += image.size();
  constexpr std::size_t kFewest = 100;
  if (images.size() < 2 || num_descriptors < kFewest) {
    throw InputError("too little to learn from: expected 2 images and 100 features, found " +
                     std::to_string(images.size()) + " and " + std::to_string(num_descriptors));
  }
  std::fprintf(stderr, "clustering %zu descriptors\n", num_descriptors);
  return TrainVocabulary(images, arguments.training, arguments.num_threads);
}

void Run(const Arguments& arguments) {
  const Stopwatch stopwatch;
  const bool is_conversion = !arguments.from.empty();
  if (is_conversion != arguments.folders.empty()) {
    throw InputError("expected either folders of images or --from a vocabulary");
  }
  const Vocabulary vocabulary = is_conversion ? Vocabulary::Load(arguments.from) : Train(arguments);
  if (!arguments.text.empty()) vocabulary.SaveText(arguments.text);
  if (fs::path(arguments.output).extension() == ".txt") {
    vocabulary.SaveText(arguments.output);
  } else {
    vocabulary.SaveBinary(arguments.output);
  }
  std::printf("%s: %zu words, %zu nodes, %d branches, %d levels, %.1f s\n",
              arguments.output.c_str(), vocabulary.num_words(), vocabulary.nodes().size(),
              vocabulary.branching(), vocabulary.depth(), stopwatch.Seconds());
}

}  // namespace
}  // namespace semslam

namespace {

// Returns the exit code.
int ParseAndRun(int argc, char** argv) {
  semslam::Arguments arguments;
  CLI::App app("Trains a vocabulary of ORB features from folders of images, or converts one.");
  app.set_version_flag("--version", SEMSLAM_VERSION);
  app.add_option("output", arguments.output, "vocabulary to write: text if it ends in .txt")
      ->required();
  app.add_option("folders", arguments.folders, "folders of PNG or JPEG images");
  app.add_option("--from", arguments.from, "convert this vocabulary instead (text or binary)");
  app.add_option("--text", arguments.text, "write a text copy too");
  app.add_option("--branching", arguments.training.branching, "children of a node")
      ->check(CLI::Range(2, 256))
      ->capture_default_str();
  app.add_option("--depth", arguments.training.depth, "levels below the root")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  app.add_option("--min-descriptors", arguments.training.min_descriptors_per_node,
                 "do not divide a node with fewer")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  app.add_option("--seed", arguments.training.seed, "of the clustering")->capture_default_str();
  app.add_option("--step", arguments.step, "use every so many-th image of a folder")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--features", arguments.num_features, "per image")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--threads", arguments.num_threads, "0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  semslam::Run(arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return ParseAndRun(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "train_vocabulary: %s\n", error.what());
    return 1;
  }
}
