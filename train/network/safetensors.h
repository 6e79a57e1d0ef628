#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stride::network {

/// Named arrays in a file of the safetensors format: 8 bytes length, a JSON header, the data.
/// Supports F32, F64, I64 and U8. Arrays are row-major in the file and column-major in memory, so
/// matrices are transposed.
class Tensors {
 public:
  struct Tensor {
    std::string type;  // F32, F64, I64, U8
    std::vector<std::int64_t> shape;
    std::string bytes;  // little-endian
  };

  std::map<std::string, std::string> metadata;
  std::map<std::string, Tensor> tensors;
  std::string file;  // where it was loaded from, for error messages

  /// A vector is of shape [n], a matrix of shape [rows, columns].
  template <typename Derived>
  void put(const std::string& name, const Eigen::DenseBase<Derived>& value);
  void put(const std::string& name, std::int64_t value);
  void put_number(const std::string& name, double value);
  void put_bytes(const std::string& name, std::string_view bytes);

  /// Reads an array of known size. Throws Error naming file and tensor if it is missing, has
  /// another size or type, or holds a number that is not finite.
  template <typename Derived>
  void get(const std::string& name, Eigen::DenseBase<Derived>& value) const;
  std::int64_t integer(const std::string& name) const;
  double number(const std::string& name) const;
  const std::string& bytes(const std::string& name) const;
  bool has(const std::string& name) const { return tensors.contains(name); }
  /// Number of elements.
  std::int64_t size(const std::string& name) const;
  /// Throws Error naming file and key if it is missing.
  const std::string& meta(const std::string& key) const;

 private:
  const Tensor& find(const std::string& name, std::string_view type) const;
};

/// Errors name the file and the defect (truncated, not safetensors, …).
Tensors load_tensors(const std::filesystem::path& file);
/// Writes atomically.
void save(const Tensors& tensors, const std::filesystem::path& file);

extern template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::MatrixXf>&);
extern template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::MatrixXd>&);
extern template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::VectorXf>&);
extern template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::VectorXd>&);
extern template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::MatrixXf>&) const;
extern template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::MatrixXd>&) const;
extern template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::VectorXf>&) const;
extern template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::VectorXd>&) const;

}  // namespace stride::network
