#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <variant>

#include "extract/io/error.h"
#include "train/network/policy.h"
#include "train/network/safetensors.h"
#include "train/python/module.h"

namespace stride::python {
namespace py = pybind11;
namespace {

/// A policy of either precision with the names of what it sees and does.
class AnyPolicy {
 public:
  explicit AnyPolicy(const std::filesystem::path& file) : names_(network::load_policy_names(file)) {
    const network::Tensors tensors = network::load_tensors(file);
    const auto weight = tensors.tensors.find("actor.0.weight");
    if (weight != tensors.tensors.end() && weight->second.type == "F64")
      policy_ = network::load_policy<double>(file, names_.features, names_.actions);
    else
      policy_ = network::load_policy<float>(file, names_.features, names_.actions);
  }

  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Rows operator()(const Eigen::Ref<const Rows>& features) const {
    require(features.cols() == static_cast<Eigen::Index>(names_.features.size()),
            "features: shape ({}, {}), (n, {}) is needed; make the environment with "
            "observation=\"agent\" as the agent was trained",
            features.rows(), features.cols(), names_.features.size());
    require(features.allFinite(), "features: not all are finite");
    const auto* single = std::get_if<network::Policy<float>>(&policy_);
    return single ? act(*single, features)
                  : act(std::get<network::Policy<double>>(policy_), features);
  }

  const network::PolicyNames& names() const { return names_; }

 private:
  /// A column at a time, as in training and evaluation: the same bytes whatever the number of rows.
  template <typename Scalar>
  static Rows act(const network::Policy<Scalar>& policy, const Eigen::Ref<const Rows>& features) {
    Rows actions(features.rows(), policy.actor.shape().outputs);
    typename network::Mlp<Scalar>::Workspace work;
    for (Eigen::Index i = 0; i < features.rows(); ++i) {
      const Eigen::VectorXd seen = features.row(i).transpose();
      actions.row(i) = policy.act(seen, work).transpose();
    }
    return actions;
  }

  network::PolicyNames names_;
  std::variant<std::monostate, network::Policy<float>, network::Policy<double>> policy_;
};

}  // namespace

void bind_policy(py::module_& module) {
  py::class_<AnyPolicy>(module, "Policy", "The policy of a trained agent, agent.safetensors")
      .def(py::init<std::filesystem::path>(), py::arg("file"))
      .def("__call__", &AnyPolicy::operator(), py::arg("features"),
           "Actions (n, 18) for features (n, k), without noise")
      .def_property_readonly("features", [](const AnyPolicy& p) { return p.names().features; })
      .def_property_readonly("actions", [](const AnyPolicy& p) { return p.names().actions; })
      .def_property_readonly("action_repeat",
                             [](const AnyPolicy& p) { return p.names().action_repeat; });
}

}  // namespace stride::python
