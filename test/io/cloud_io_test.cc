// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/cloud_io.h"

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "semslam/base/random.h"

#include "support/file_size_limit.h"
#include "support/files.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::TemporaryFolder;

struct Sample {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Rgb> colors;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> segments;
  std::vector<std::uint32_t> objects;
  std::vector<float> confidences;
  std::vector<float> entropies;

  CloudView View() const {
    return {.positions = positions,
            .colors = colors,
            .normals = normals,
            .labels = labels,
            .segments = segments,
            .objects = objects,
            .confidences = confidences,
            .entropies = entropies};
  }
};

Sample MakeSample(std::size_t size) {
  Random random(1);
  Sample sample;
  for (std::size_t i = 0; i < size; ++i) {
    const auto number = [&] { return static_cast<float>(random.Uniform(-2, 2)); };
    sample.positions.emplace_back(number(), number(), number());
    sample.normals.push_back(Eigen::Vector3f(number(), number(), number()).normalized());
    const auto byte = [&] { return static_cast<std::uint8_t>(random.Index(256)); };
    sample.colors.push_back({byte(), byte(), byte()});
    sample.labels.push_back(random.Index(80));
    sample.segments.push_back(random.Index(4000000000U));
    sample.objects.push_back(random.Index(100));
    sample.confidences.push_back(static_cast<float>(random.Uniform()));
    sample.entropies.push_back(static_cast<float>(random.Uniform()));
  }
  return sample;
}

class CloudIoTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string path_ = (folder_.path() / "cloud.pcd").string();
  Sample sample_ = MakeSample(1000);
};

TEST_F(CloudIoTest, ReadsBackWhatItWrote) {
  WritePcd(path_, sample_.View());
  const CloudColumns cloud = ReadPcd(path_);
  EXPECT_EQ(cloud.positions, sample_.positions);
  EXPECT_EQ(cloud.colors, sample_.colors);
  EXPECT_EQ(cloud.normals, sample_.normals);
  EXPECT_EQ(cloud.labels, sample_.labels);
}

TEST_F(CloudIoTest, PclReadsColourAndLabel) {
  WritePcd(path_,
           {.positions = sample_.positions, .colors = sample_.colors, .labels = sample_.labels});
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path_, cloud), 0);
  ASSERT_EQ(cloud.size(), sample_.positions.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(Eigen::Vector3f(cloud[i].getVector3fMap()), sample_.positions[i]);
    EXPECT_EQ((Rgb{cloud[i].r, cloud[i].g, cloud[i].b}), sample_.colors[i]);
    EXPECT_EQ(cloud[i].a, 255);
    EXPECT_EQ(cloud[i].label, sample_.labels[i]);
  }
}

TEST_F(CloudIoTest, PclReadsPositionsAndColours) {
  WritePcd(path_, {.positions = sample_.positions, .colors = sample_.colors});
  pcl::PointCloud<pcl::PointXYZRGBA> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path_, cloud), 0);
  ASSERT_EQ(cloud.size(), sample_.positions.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(Eigen::Vector3f(cloud[i].getVector3fMap()), sample_.positions[i]);
    EXPECT_EQ((Rgb{cloud[i].r, cloud[i].g, cloud[i].b}), sample_.colors[i]);
    EXPECT_EQ(cloud[i].a, 255);
  }
}

TEST_F(CloudIoTest, PclFindsEveryFieldUnderItsNameAndType) {
  WritePcd(path_, sample_.View());
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read(path_, cloud), 0);
  std::string fields;
  for (const auto& field : cloud.fields) {
    EXPECT_EQ(field.count, 1u) << field.name;
    fields += field.name + (field.datatype == pcl::PCLPointField::FLOAT32  ? ":f "
                            : field.datatype == pcl::PCLPointField::UINT32 ? ":u "
                                                                           : ":? ");
  }
  EXPECT_EQ(fields,
            "x:f y:f z:f rgba:u normal_x:f normal_y:f normal_z:f label:u segment:u object:u "
            "confidence:f entropy:f ");
  EXPECT_EQ(cloud.width, sample_.positions.size());
  EXPECT_EQ(cloud.height, 1u);
}

TEST_F(CloudIoTest, PclReadsTheValuesOfItsUnknownFields) {
  WritePcd(path_, sample_.View());
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read(path_, cloud), 0);
  ASSERT_EQ(cloud.width, sample_.positions.size());
  for (std::uint32_t i = 0; i < cloud.width; ++i) {
    EXPECT_EQ(cloud.at<std::uint32_t>(i, cloud.fields[8].offset), sample_.segments[i]);
    EXPECT_EQ(cloud.at<std::uint32_t>(i, cloud.fields[9].offset), sample_.objects[i]);
    EXPECT_EQ(cloud.at<float>(i, cloud.fields[10].offset), sample_.confidences[i]);
    EXPECT_EQ(cloud.at<float>(i, cloud.fields[11].offset), sample_.entropies[i]);
  }
}

TEST_F(CloudIoTest, PclReadsPositionsAndLabels) {
  WritePcd(path_, {.positions = sample_.positions, .labels = sample_.segments});
  pcl::PointCloud<pcl::PointXYZL> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path_, cloud), 0);
  ASSERT_EQ(cloud.size(), sample_.positions.size());
  EXPECT_EQ(cloud[999].label, sample_.segments[999]);
}

TEST_F(CloudIoTest, PclReadsNormals) {
  WritePcd(path_, {.positions = sample_.positions, .normals = sample_.normals});
  pcl::PointCloud<pcl::PointNormal> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path_, cloud), 0);
  EXPECT_EQ(Eigen::Vector3f(cloud.at(7).getNormalVector3fMap()), sample_.normals[7]);
}

TEST_F(CloudIoTest, PclReadsThePlyFileWithAllItsColumns) {
  WritePly(path_, sample_.View());
  pcl::PCLPointCloud2 raw;
  ASSERT_EQ(pcl::PLYReader().read(path_, raw), 0);
  std::string names;
  for (const auto& field : raw.fields) names += field.name + ' ';
  EXPECT_EQ(names, "x y z normal_x normal_y normal_z rgb label segment object confidence entropy ");
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  pcl::fromPCLPointCloud2(raw, cloud);
  ASSERT_EQ(cloud.size(), sample_.positions.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(Eigen::Vector3f(cloud[i].getVector3fMap()), sample_.positions[i]);
    EXPECT_EQ((Rgb{cloud[i].r, cloud[i].g, cloud[i].b}), sample_.colors[i]);
    EXPECT_EQ(cloud[i].label, sample_.labels[i]);
  }
}

TEST_F(CloudIoTest, ReadsEveryEncodingOfPcl) {
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  for (std::size_t i = 0; i < sample_.positions.size(); ++i) {
    pcl::PointXYZRGBL point;
    point.getVector3fMap() = sample_.positions[i];
    point.r = sample_.colors[i].r;
    point.g = sample_.colors[i].g;
    point.b = sample_.colors[i].b;
    point.label = sample_.labels[i];
    cloud.push_back(point);
  }
  pcl::PCDWriter writer;
  for (int encoding = 0; encoding < 3; ++encoding) {
    if (encoding == 0) writer.writeASCII(path_, cloud, 9);
    if (encoding == 1) writer.writeBinary(path_, cloud);
    if (encoding == 2) writer.writeBinaryCompressed(path_, cloud);
    const CloudColumns read = ReadPcd(path_);
    EXPECT_EQ(read.positions, sample_.positions) << encoding;
    EXPECT_EQ(read.colors, sample_.colors) << encoding;
    EXPECT_EQ(read.labels, sample_.labels) << encoding;
  }
}

TEST_F(CloudIoTest, ReadsFieldsOfOtherTypesAndPassesOverTheRest) {
  folder_.Write(
      "cloud.pcd",
      "# .PCD v0.7\nVERSION 0.7\nFIELDS label fpfh x y z\nSIZE 2 4 8 8 8\nTYPE I F F F F\n"
      "COUNT 1 2 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
      "7 0.1 0.2 1.5 2.5 3.5\n-8 0 0 4 5 6\n");
  const CloudColumns cloud = ReadPcd(path_);
  ASSERT_EQ(cloud.positions.size(), 2u);
  EXPECT_EQ(cloud.positions[0], Eigen::Vector3f(1.5F, 2.5F, 3.5F));
  EXPECT_EQ(cloud.labels[0], 7u);
  EXPECT_TRUE(cloud.colors.empty());
}

TEST_F(CloudIoTest, LeavesOutPointsWithoutAPosition) {
  sample_.positions[3].y() = std::numeric_limits<float>::quiet_NaN();
  WritePcd(path_, {.positions = sample_.positions, .labels = sample_.labels});
  const CloudColumns cloud = ReadPcd(path_);
  EXPECT_EQ(cloud.positions.size(), 999u);
  EXPECT_EQ(cloud.labels[3], sample_.labels[4]);
}

TEST_F(CloudIoTest, WritesAndReadsAnEmptyCloud) {
  WritePcd(path_, {});
  EXPECT_TRUE(ReadPcd(path_).positions.empty());
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read(path_, cloud), 0);
  EXPECT_EQ(cloud.width * cloud.height, 0u);
  EXPECT_EQ(cloud.fields.size(), 3u);
}

TEST_F(CloudIoTest, WritesAndReadsFewPointsOfNoise) {
  for (std::size_t size = 1; size < 20; ++size) {
    sample_ = MakeSample(size);
    WritePcd(path_, {.positions = sample_.positions});
    EXPECT_EQ(ReadPcd(path_).positions, sample_.positions);
  }
}

TEST_F(CloudIoTest, PrintsNothing) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  WritePcd(path_, {});
  ReadPcd(path_);
  WritePcd(path_, sample_.View());
  InputErrorOf([&] { WritePcd(folder_.path() / "missing" / "cloud.pcd", sample_.View()); });
  InputErrorOf([&] { ReadPcd(folder_.path() / "missing.pcd"); });
  InputErrorOf([&] { ReadPcd(folder_.Write("empty.pcd", "")); });
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(CloudIoTest, WritesTheSameBytesEveryTime) {
  WritePcd(path_, sample_.View());
  WritePcd(folder_.path() / "again.pcd", sample_.View());
  EXPECT_EQ(testing::ReadAll(path_), testing::ReadAll(folder_.path() / "again.pcd"));
}

TEST_F(CloudIoTest, RejectsColumnsOfDifferentLengths) {
  sample_.labels.pop_back();
  EXPECT_THROW(WritePcd(path_, {.positions = sample_.positions, .labels = sample_.labels}),
               std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(CloudIoTest, RejectsHeadersThatMakeNoSense) {
  const std::string whole =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 1\nDATA ascii\n1 2 3\n";
  const auto error_with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return InputErrorOf([&] { ReadPcd(folder_.Write("bad.pcd", text)); });
  };
  EXPECT_THAT(error_with("x y z", "x y q"), HasSubstr("expected the fields x, y and z"));
  EXPECT_THAT(error_with("SIZE 4", "SIZE 3"), HasSubstr("type F3 x 1 is not known"));
  EXPECT_THAT(error_with("SIZE 4 4 4", "SIZE 4 4"), HasSubstr("expected 3 values, found 2"));
  EXPECT_THAT(error_with("POINTS 1", "POINTS -1"), HasSubstr("POINTS: expected an integer"));
  EXPECT_THAT(error_with("POINTS 1", "POINTS 2"), HasSubstr("cut short: expected 2 points"));
  EXPECT_THAT(error_with("DATA ascii", "DATA text"), HasSubstr("DATA: expected ascii, binary or"));
  EXPECT_THAT(error_with("1 2 3", "1 two 3"), HasSubstr("expected a number, found \"two\""));
  EXPECT_THAT(error_with("POINTS 1\nDATA ascii", "POINTS 2000000000\nDATA binary"),
              HasSubstr("cut short"));
}

TEST_F(CloudIoTest, LeavesNothingOnAFullDisk) {
  const testing::FileSizeLimit limit(3000);
  const CloudView cloud{.positions = sample_.positions, .colors = sample_.colors};
  EXPECT_THAT(InputErrorOf([&] { WritePcd(path_, cloud); }), HasSubstr("cannot write"));
  EXPECT_THAT(InputErrorOf([&] { WritePly(path_, cloud); }), HasSubstr("cannot write"));
  EXPECT_EQ(folder_.NumFiles(), 0u);
}

}  // namespace
}  // namespace semslam
