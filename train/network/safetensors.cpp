#include "train/network/safetensors.h"

#include <bit>
#include <cstring>
#include <type_traits>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/json/json.h"

namespace stride::network {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "safetensors is little-endian");

template <typename Scalar>
constexpr const char* kType = std::is_same_v<Scalar, float> ? "F32" : "F64";

std::size_t element_bytes(std::string_view type) {
  if (type == "F32") return 4;
  if (type == "F64" || type == "I64") return 8;
  if (type == "U8") return 1;
  return 0;
}

std::int64_t element_count(const std::vector<std::int64_t>& shape) {
  std::int64_t count = 1;
  for (const std::int64_t n : shape) count *= n;
  return count;
}

}  // namespace

template <typename Derived>
void Tensors::put(const std::string& name, const Eigen::DenseBase<Derived>& value) {
  using Scalar = typename Derived::Scalar;
  Tensor tensor{kType<Scalar>, {value.rows()}, {}};
  if (!Derived::IsVectorAtCompileTime) tensor.shape.push_back(value.cols());
  const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> transposed =
      value.derived().transpose();
  tensor.bytes.assign(reinterpret_cast<const char*>(transposed.data()),
                      static_cast<std::size_t>(transposed.size()) * sizeof(Scalar));
  tensors[name] = std::move(tensor);
}

void Tensors::put(const std::string& name, std::int64_t value) {
  Tensor tensor{"I64", {1}, std::string(8, '\0')};
  std::memcpy(tensor.bytes.data(), &value, 8);
  tensors[name] = std::move(tensor);
}

void Tensors::put_number(const std::string& name, double value) {
  put(name, Eigen::VectorXd::Constant(1, value).eval());
}

void Tensors::put_bytes(const std::string& name, std::string_view bytes) {
  tensors[name] = {"U8", {static_cast<std::int64_t>(bytes.size())}, std::string(bytes)};
}

const Tensors::Tensor& Tensors::find(const std::string& name, std::string_view type) const {
  const auto found = tensors.find(name);
  require(found != tensors.end(), "{}: tensor '{}' is missing: the file is of another model", file,
          name);
  require(found->second.type == type, "{}: tensor '{}' is of type {}, {} is needed", file, name,
          found->second.type, type);
  return found->second;
}

template <typename Derived>
void Tensors::get(const std::string& name, Eigen::DenseBase<Derived>& value) const {
  using Scalar = typename Derived::Scalar;
  const Tensor& tensor = find(name, kType<Scalar>);
  require(element_count(tensor.shape) == value.size() &&
              (tensor.shape.size() < 2 || tensor.shape[0] == value.rows()),
          "{}: tensor '{}' has {} elements, {} × {} are needed: the file is of another model", file,
          name, element_count(tensor.shape), value.rows(), value.cols());
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> transposed(value.cols(), value.rows());
  if (!tensor.bytes.empty())
    std::memcpy(transposed.data(), tensor.bytes.data(), tensor.bytes.size());
  require(transposed.allFinite(), "{}: tensor '{}' holds a number that is not finite", file, name);
  value.derived() = transposed.transpose();
}

std::int64_t Tensors::integer(const std::string& name) const {
  const Tensor& tensor = find(name, "I64");
  require(tensor.bytes.size() == 8, "{}: tensor '{}' must be one integer", file, name);
  std::int64_t value = 0;
  std::memcpy(&value, tensor.bytes.data(), 8);
  return value;
}

double Tensors::number(const std::string& name) const {
  Eigen::VectorXd value(1);
  get(name, value);
  return value[0];
}

const std::string& Tensors::bytes(const std::string& name) const { return find(name, "U8").bytes; }

std::int64_t Tensors::size(const std::string& name) const {
  const auto found = tensors.find(name);
  require(found != tensors.end(), "{}: tensor '{}' is missing: the file is of another model", file,
          name);
  return element_count(found->second.shape);
}

const std::string& Tensors::meta(const std::string& key) const {
  const auto found = metadata.find(key);
  require(found != metadata.end(), "{}: metadata '{}' is missing: not a file of ours", file, key);
  return found->second;
}

Tensors load_tensors(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  Tensors tensors;
  tensors.file = path.string();
  std::uint64_t header_size = 0;
  require(content.size() >= 8, "{}: {} bytes: not a safetensors file, or truncated", tensors.file,
          content.size());
  std::memcpy(&header_size, content.data(), 8);
  require(header_size <= content.size() - 8,
          "{}: not a safetensors file, or truncated in its header", tensors.file);
  const std::string_view data = std::string_view(content).substr(8 + header_size);
  const auto header = json_or_null<Json>(std::string_view(content).substr(8, header_size));
  require(header.is_object(), "{}: not a safetensors file: its header is not JSON", tensors.file);

  for (const auto& [name, entry] : header.items()) {
    if (name == "__metadata__") {
      require(entry.is_object(), "{}: __metadata__ must be an object", tensors.file);
      for (const auto& [key, value] : entry.items())
        if (value.is_string()) tensors.metadata[key] = value.get<std::string>();
      continue;
    }
    const auto whole_numbers = [](const Json& list, std::size_t most) {
      if (!list.is_array() || list.size() > most) return false;
      for (const Json& n : list)
        if (!n.is_number_unsigned() || n.get<std::uint64_t>() > (1ULL << 40)) return false;
      return true;
    };
    require(entry.is_object() && entry.contains("dtype") && entry["dtype"].is_string() &&
                entry.contains("shape") && whole_numbers(entry["shape"], 2) &&
                entry.contains("data_offsets") && whole_numbers(entry["data_offsets"], 2) &&
                entry["data_offsets"].size() == 2,
            "{}: tensor '{}': needs dtype, shape (at most two numbers) and data_offsets",
            tensors.file, name);
    Tensors::Tensor tensor;
    tensor.type = entry["dtype"].get<std::string>();
    tensor.shape = entry["shape"].get<std::vector<std::int64_t>>();
    const auto begin = entry["data_offsets"][0].get<std::uint64_t>();
    const auto end = entry["data_offsets"][1].get<std::uint64_t>();
    require(element_bytes(tensor.type) > 0, "{}: tensor '{}': type {}: must be F32, F64, I64 or U8",
            tensors.file, name, tensor.type);
    require(begin <= end && end <= data.size(), "{}: tensor '{}' ends at byte {} of {}: truncated",
            tensors.file, name, end, data.size());
    const double bytes = static_cast<double>(element_bytes(tensor.type)) * [&] {
      double n = 1;
      for (const auto k : tensor.shape) n *= static_cast<double>(k);
      return n;
    }();
    require(bytes == static_cast<double>(end - begin),
            "{}: tensor '{}': its shape does not agree with its {} bytes", tensors.file, name,
            end - begin);
    tensor.bytes = data.substr(begin, end - begin);
    tensors.tensors[name] = std::move(tensor);
  }
  return tensors;
}

void save(const Tensors& tensors, const std::filesystem::path& file) {
  Json header = Json::object();
  header["__metadata__"] = tensors.metadata;
  std::uint64_t offset = 0;
  for (const auto& [name, tensor] : tensors.tensors) {
    header[name] = {{"dtype", tensor.type},
                    {"shape", tensor.shape},
                    {"data_offsets", {offset, offset + tensor.bytes.size()}}};
    offset += tensor.bytes.size();
  }
  std::string text = header.dump();
  text.append((8 - text.size() % 8) % 8, ' ');
  const std::uint64_t size = text.size();
  std::string content(reinterpret_cast<const char*>(&size), 8);
  content.reserve(8 + text.size() + offset);
  content += text;
  for (const auto& [name, tensor] : tensors.tensors) content += tensor.bytes;
  write_file_atomically(file, content);
}

template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::MatrixXf>&);
template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::MatrixXd>&);
template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::VectorXf>&);
template void Tensors::put(const std::string&, const Eigen::DenseBase<Eigen::VectorXd>&);
template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::MatrixXf>&) const;
template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::MatrixXd>&) const;
template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::VectorXf>&) const;
template void Tensors::get(const std::string&, Eigen::DenseBase<Eigen::VectorXd>&) const;

}  // namespace stride::network
