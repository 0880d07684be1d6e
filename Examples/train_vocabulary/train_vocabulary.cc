// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Trains a vocabulary from folders of images, converts one between text and binary, or tells what
// is in one:
//   train_vocabulary train orb.voc recording1/rgb recording2/rgb
//   train_vocabulary convert ORBvoc.txt ORBvoc.voc
//   train_vocabulary info orb.voc
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <unistd.h>

#include "semslam/base/error.h"
#include "semslam/base/parallel.h"
#include "semslam/base/stopwatch.h"
#include "semslam/features/orb_extractor.h"
#include "semslam/place/vocabulary.h"
#include "semslam/place/vocabulary_training.h"

#include "run_program.h"

namespace {

namespace fs = std::filesystem;
using semslam::Descriptor;
using semslam::InputError;
using semslam::Vocabulary;

struct Arguments {
  std::function<void(const Arguments&)> command;
  fs::path input;
  fs::path output;
  std::vector<std::string> folders;
  int step = 1;
  int num_features = 1000;
  int num_threads = 0;
  semslam::VocabularyTrainingOptions training;
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
  const semslam::OrbExtractor extractor({.num_features = arguments.num_features});
  std::vector<std::vector<Descriptor>> descriptors(files.size());
  constexpr std::size_t kBatch = 32;
  for (std::size_t begin = 0; begin < files.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, files.size());
    semslam::ParallelFor(
        end - begin, 1, arguments.num_threads, [&](std::size_t first, std::size_t last) {
          for (std::size_t i = begin + first; i < begin + last; ++i) {
            const cv::Mat image = cv::imread(files[i].string(), cv::IMREAD_GRAYSCALE);
            if (image.empty()) throw InputError(files[i].string() + ": cannot be read as an image");
            descriptors[i] = extractor.Extract(image).descriptors;
          }
        });
    if (::isatty(STDERR_FILENO) != 0)
      std::fprintf(stderr, "\rfeatures of %zu / %zu images", end, files.size());
  }
  if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\n");
  return descriptors;
}

void Save(const Vocabulary& vocabulary, const fs::path& path) {
  path.extension() == ".txt" ? vocabulary.SaveText(path) : vocabulary.SaveBinary(path);
}

void Print(const Vocabulary& vocabulary, const fs::path& path) {
  std::printf("%s: %zu words, %zu nodes, %d branches, %d levels, %.1f MB\n", path.c_str(),
              vocabulary.num_words(), vocabulary.nodes().size(), vocabulary.branching(),
              vocabulary.depth(), static_cast<double>(fs::file_size(path)) / 1e6);
}

void Train(const Arguments& arguments) {
  const semslam::Stopwatch stopwatch;
  const std::vector<std::vector<Descriptor>> images = ExtractAll(arguments);
  std::size_t num_descriptors = 0;
  for (const auto& image : images) num_descriptors += image.size();
  constexpr std::size_t kFewest = 100;
  if (images.size() < 2 || num_descriptors < kFewest) {
    throw InputError("too little to learn from: expected 2 images and 100 features, found " +
                     std::to_string(images.size()) + " and " + std::to_string(num_descriptors));
  }
  const Vocabulary vocabulary =
      semslam::TrainVocabulary(images, arguments.training, arguments.num_threads);
  Save(vocabulary, arguments.output);
  Print(vocabulary, arguments.output);
  std::printf("learned from %zu images, %zu descriptors, in %.1f s\n", images.size(),
              num_descriptors, stopwatch.Seconds());
}

void Convert(const Arguments& arguments) {
  const Vocabulary vocabulary = Vocabulary::Load(arguments.input);
  Save(vocabulary, arguments.output);
  Print(vocabulary, arguments.output);
}

// How the words are spread over the tree, and how much they tell.
void Inform(const Arguments& arguments) {
  const semslam::Stopwatch stopwatch;
  const Vocabulary vocabulary = Vocabulary::Load(arguments.input);
  const double milliseconds = stopwatch.Milliseconds();
  Print(vocabulary, arguments.input);
  std::printf("loaded in %.1f ms\n", milliseconds);
  std::vector<int> levels(vocabulary.nodes().size(), 0);
  std::vector<std::size_t> num_words(static_cast<std::size_t>(vocabulary.depth()) + 1, 0);
  std::vector<float> weights;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Vocabulary::Node& node = vocabulary.nodes()[i];
    if (node.num_children == 0) {
      ++num_words[levels[i]];
      weights.push_back(node.weight);
    }
    for (std::size_t c = 0; c < node.num_children; ++c)
      levels[node.first_child + c] = levels[i] + 1;
  }
  for (std::size_t level = 1; level < num_words.size(); ++level)
    std::printf("level %zu: %zu words\n", level, num_words[level]);
  std::sort(weights.begin(), weights.end());
  std::printf("weights: least %.2f, median %.2f, most %.2f\n", weights.front(),
              weights[weights.size() / 2], weights.back());
}

void AddTrain(CLI::App& app, Arguments& arguments) {
  CLI::App* train = app.add_subcommand("train", "Train one from folders of images");
  train->add_option("OUT", arguments.output, "Vocabulary to write: text if it ends in .txt")
      ->required();
  train->add_option("FOLDERS", arguments.folders, "Folders of PNG or JPEG images")->required();
  train->add_option("--branching", arguments.training.branching, "Children of a node")
      ->check(CLI::Range(2, 256))
      ->capture_default_str();
  train->add_option("--depth", arguments.training.depth, "Levels below the root")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  train
      ->add_option("--min-descriptors", arguments.training.min_descriptors_per_node,
                   "Do not divide a node with fewer")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  train->add_option("--seed", arguments.training.seed, "Of the clustering")->capture_default_str();
  train->add_option("--step", arguments.step, "Use every so many-th image of a folder")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  train->add_option("--features", arguments.num_features, "Of an image")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  train->add_option("--threads", arguments.num_threads, "0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  train->callback([&arguments] { arguments.command = Train; });
}

void AddArguments(CLI::App& app, Arguments& arguments) {
  AddTrain(app, arguments);
  CLI::App* convert = app.add_subcommand("convert", "Convert one between text and binary");
  convert->add_option("IN", arguments.input, "Vocabulary to read, text or binary")->required();
  convert->add_option("OUT", arguments.output, "Vocabulary to write: text if it ends in .txt")
      ->required();
  convert->callback([&arguments] { arguments.command = Convert; });
  CLI::App* info = app.add_subcommand("info", "Tell what is in one");
  info->add_option("VOCABULARY", arguments.input, "Text or binary")->required();
  info->callback([&arguments] { arguments.command = Inform; });
  app.require_subcommand(1);
  app.set_version_flag("--version", "train_vocabulary " SEMSLAM_VERSION);
}

int Run(const Arguments& arguments) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  arguments.command(arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("train_vocabulary",
                               "Visual vocabularies of ORB features: train, convert, inspect.",
                               argc, argv, AddArguments, Run);
}
