#include "train/network/safetensors.h"

#include <gtest/gtest.h>

#include <limits>

#include "extract/io/file.h"
#include "extract/io/random.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

network::Tensors example() {
  network::Tensors tensors;
  tensors.metadata = {{"format", "test"}};
  tensors.put("matrix", Eigen::MatrixXf(Eigen::Matrix<float, 2, 3>{{1, 2, 3}, {4, 5, 6}}));
  tensors.put("vector", Eigen::VectorXd{{0.1, -7}});
  tensors.put("count", std::int64_t{-5});
  tensors.put_bytes("text", "abc");
  return tensors;
}

TEST(Safetensors, ReadBackWhatWasWritten) {
  TemporaryFolder folder;
  network::save(example(), folder / "a.safetensors");
  const network::Tensors read = network::load_tensors(folder / "a.safetensors");
  Eigen::MatrixXf matrix(2, 3);
  Eigen::VectorXd vector(2);
  read.get("matrix", matrix);
  read.get("vector", vector);
  EXPECT_EQ(matrix, (Eigen::Matrix<float, 2, 3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(vector, Eigen::Vector2d(0.1, -7));
  EXPECT_EQ(read.integer("count"), -5);
  EXPECT_EQ(read.bytes("text"), "abc");
  EXPECT_EQ(read.meta("format"), "test");
}

TEST(Safetensors, AreLaidOutAsTheFormatSays) {
  TemporaryFolder folder;
  network::Tensors tensors;
  tensors.put("a", Eigen::MatrixXf(Eigen::Matrix2f{{1, 2}, {3, 4}}));
  network::save(tensors, folder / "a.safetensors");
  const std::string content = read_file(folder / "a.safetensors");
  std::uint64_t header = 0;
  std::memcpy(&header, content.data(), 8);
  EXPECT_EQ(header % 8, 0u);
  EXPECT_THAT(content.substr(8, header), ::testing::HasSubstr(R"("shape":[2,2])"));
  EXPECT_THAT(content.substr(8, header), ::testing::HasSubstr(R"("data_offsets":[0,16])"));
  float row_major[4];
  ASSERT_EQ(content.size(), 8 + header + 16);
  std::memcpy(row_major, content.data() + 8 + header, 16);
  EXPECT_EQ(row_major[1], 2);
  EXPECT_EQ(row_major[2], 3);
}

TEST(Safetensors, MissingAndMisshapenTensorsAreNamed) {
  TemporaryFolder folder;
  network::save(example(), folder / "a.safetensors");
  const network::Tensors read = network::load_tensors(folder / "a.safetensors");
  Eigen::MatrixXf matrix(3, 3);
  Eigen::MatrixXd wide(2, 3);
  EXPECT_ERROR(read.get("matrix", matrix), "tensor 'matrix' has 6 elements, 3 × 3 are needed");
  EXPECT_ERROR(read.get("matrix", wide), "is of type F32, F64 is needed");
  EXPECT_ERROR(read.get("other", matrix), "tensor 'other' is missing");
  EXPECT_ERROR(read.meta("version"), "metadata 'version' is missing");
}

TEST(Safetensors, NumbersThatAreNotFiniteAreRefused) {
  TemporaryFolder folder;
  network::Tensors tensors;
  Eigen::VectorXf value = Eigen::Vector2f(1, std::numeric_limits<float>::quiet_NaN());
  tensors.put("a", value);
  network::save(tensors, folder / "a.safetensors");
  EXPECT_ERROR(network::load_tensors(folder / "a.safetensors").get("a", value), "not finite");
}

TEST(Safetensors, DamagedFilesAreErrorsNeverCrashes) {
  TemporaryFolder folder;
  const auto file = folder / "a.safetensors";
  network::save(example(), file);
  const std::string content = read_file(file);
  for (std::size_t size = 0; size < content.size(); ++size) {
    write_file_atomically(file, content.substr(0, size));
    EXPECT_ERROR(network::load_tensors(file), "a.safetensors");
  }
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = content;
    damaged[uniform_index(random, content.size())] ^=
        static_cast<char>(1 << uniform_index(random, 8));
    write_file_atomically(file, damaged);
    try {
      network::load_tensors(file);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("a.safetensors"));
    }
  }
}

}  // namespace
}  // namespace stride
