#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "extract/io/error.h"
#include "shaping/potential.h"
#include "shaping/shaping_reward.h"
#include "train/python/module.h"

namespace stride::python {
namespace py = pybind11;
namespace {

using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Flags = py::array_t<bool, py::array::c_style | py::array::forcecast>;

constexpr py::ssize_t kPose = kPoseNumbers;

std::string shape_of(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

/// Φ of poses [..., 9] at phases of the shape [...].
Reals phi(const Potential& potential, const Reals& poses, const Reals& phases) {
  require(poses.ndim() >= 1 && poses.shape(poses.ndim() - 1) == kPose &&
              poses.size() == kPose * phases.size(),
          "potential: poses of shape {} and phases of shape {}: (n, 9) and (n,) are needed",
          shape_of(poses), shape_of(phases));
  Reals values(std::vector<py::ssize_t>(poses.shape(), poses.shape() + poses.ndim() - 1));
  for (py::ssize_t i = 0; i < phases.size(); ++i) {
    Pose pose;
    std::copy_n(poses.data() + i * kPose, kPose, pose.m.begin());
    values.mutable_data()[i] = potential(pose, phases.data()[i]);
  }
  return values;
}

Reals targets(const Potential& potential, const Reals& phases) {
  std::vector<py::ssize_t> shape(phases.shape(), phases.shape() + phases.ndim());
  shape.push_back(kPose);
  Reals poses(shape);
  for (py::ssize_t i = 0; i < phases.size(); ++i) {
    const Pose pose = potential.target(phases.data()[i]);
    std::copy(pose.m.begin(), pose.m.end(), poses.mutable_data() + i * kPose);
  }
  return poses;
}

Reals rewards(const Reals& phis, const Reals& next_phis, double gamma, const Flags& terminated) {
  require(phis.size() == next_phis.size() && phis.size() == terminated.size(),
          "shaping_reward: {} values of phi, {} of next_phi, {} of terminated: as many of each are "
          "needed",
          phis.size(), next_phis.size(), terminated.size());
  require(gamma >= 0 && gamma <= 1, "gamma = {}: must be in [0, 1]", gamma);
  Reals values(std::vector<py::ssize_t>(phis.shape(), phis.shape() + phis.ndim()));
  for (py::ssize_t i = 0; i < phis.size(); ++i)
    values.mutable_data()[i] =
        shaping_reward(phis.data()[i], next_phis.data()[i], gamma, terminated.data()[i]);
  return values;
}

}  // namespace

void bind_potential(py::module_& module) {
  py::class_<Potential>(module, "Potential", "A potential for reward shaping, NAME.potential.json")
      .def_static("load", &load_potential, py::arg("file"))
      .def(
          "save", [](const Potential& p, const std::filesystem::path& file) { save(p, file); },
          py::arg("file"))
      .def("__call__", &phi, py::arg("poses"), py::arg("phases"),
           "Phi of poses (n, 9) at phases (n,): pelvis height, then x, y from the pelvis of right "
           "knee, right foot, left knee, left foot, m")
      .def("targets", &targets, py::arg("phases"), "The demonstrated poses (n, 9) at phases (n,)")
      .def("phase_at", &Potential::phase_at, py::arg("time_s"))
      .def_readonly("source", &Potential::source)
      .def_readonly("model", &Potential::model)
      .def_readonly("foot", &Potential::foot)
      .def_readonly("period_s", &Potential::period_s)
      .def_readonly("speed_m_s", &Potential::speed_m_s)
      .def_readonly("verdict", &Potential::verdict)
      .def_readwrite("weight", &Potential::weight)
      .def_readwrite("epsilon_m", &Potential::epsilon_m)
      .def_property(
          "function", [](const Potential& p) { return std::string(kInverseDistances[p.function]); },
          [](Potential& p, const std::string& word) { p.function = inverse_distance(word); })
      .def_property(
          "index", [](const Potential& p) { return std::string(kPotentialIndices[p.index]); },
          [](Potential& p, const std::string& word) { p.index = potential_index(word); });
  module.def("shaping_reward", &rewards, py::arg("phi"), py::arg("next_phi"), py::arg("gamma"),
             py::arg("terminated"),
             "F = gamma * next_phi - phi, where next_phi counts as 0 after a fall");
}

}  // namespace stride::python
