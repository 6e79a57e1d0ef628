// The Python module stride._stride: runners that write into numpy arrays, potentials, policies.
// The classes that users see are in train/python/stride/*.py.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <opencv2/imgproc.hpp>

#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "extract/video/video_writer.h"
#include "train/ddpg/replay_buffer.h"
#include "train/film/film.h"
#include "train/python/module.h"
#include "train/python/runners.h"

namespace stride::python {
namespace py = pybind11;
namespace {

/// A C-contiguous, writable array of that many elements, as it is.
template <typename T>
std::span<T> span_of(const py::dict& arrays, const char* name, std::size_t size) {
  using Array = py::array_t<T, py::array::c_style>;
  require(arrays.contains(name) && py::isinstance<Array>(arrays[name]),
          "arrays['{}']: a C-contiguous array of its type is needed", name);
  auto array = py::reinterpret_borrow<Array>(arrays[name]);
  require(static_cast<std::size_t>(array.size()) == size,
          "arrays['{}']: has {} elements, {} are needed", name, array.size(), size);
  return {array.mutable_data(), size};
}

/// Runners with the arrays that they write into, which Python owns.
class BoundRunners {
 public:
  explicit BoundRunners(const RunnersOptions& options) : runners_(options) {}

  void bind(const py::dict& arrays) {
    const auto n = static_cast<std::size_t>(runners_.count());
    const auto real = [&](const char* name, std::size_t width = 1) {
      return span_of<double>(arrays, name, n * width);
    };
    const auto flag = [&](const char* name) { return span_of<bool>(arrays, name, n); };
    arrays_ = {.observations = real("observations", runners_.observation_names().size()),
               .rewards = real("rewards"),
               .forward = real("forward"),
               .ligament = real("ligament"),
               .distances_m = real("distance_m"),
               .times_s = real("time_s"),
               .phases = real("phase"),
               .phis = real("phi"),
               .poses = real("pose", kPoseNumbers),
               .terminated = flag("terminated"),
               .truncated = flag("truncated"),
               .failed = flag("failed")};
    owner_ = arrays;
  }

  void reset(std::uint64_t seed) {
    bound();
    const py::gil_scoped_release release;
    runners_.reset(seed, arrays_);
  }

  void reset_one(int runner, std::uint64_t seed) {
    bound();
    runners_.environment(runner);
    runners_.reset_one(runner, seed, arrays_);
  }

  void step(const py::array_t<double, py::array::c_style | py::array::forcecast>& actions) {
    bound();
    const auto n = static_cast<py::ssize_t>(runners_.count());
    const bool shaped = (actions.ndim() == 2 && actions.shape(0) == n && actions.shape(1) == 18) ||
                        (n == 1 && actions.ndim() == 1 && actions.shape(0) == 18);
    require(shaped, "actions: shape {}, ({}, 18) is needed", shape_of(actions), n);
    const std::span<const double> values(actions.data(), static_cast<std::size_t>(actions.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
      require(std::isfinite(values[i]), "actions: {} at runner {}, muscle {}: must be finite",
              values[i], i / 18, runners_.action_names()[i % 18]);
    const py::gil_scoped_release release;
    runners_.step(values, arrays_);
  }

  /// RGB, [height, width, 3].
  py::array_t<std::uint8_t> picture(int runner, int width_px, int height_px) {
    const environment::RunnerEnvironment& environment = runners_.environment(runner);
    if (!film_) film_ = film::film_model(environment.engine().model());
    cv::Mat frame = film::film_frame(
        *film_,
        {environment.engine().state(), environment.kinematics(), environment.scene().obstacles},
        {.width_px = width_px, .height_px = height_px, .title = {}});
    cv::cvtColor(frame, frame, cv::COLOR_BGR2RGB);
    py::array_t<std::uint8_t> array({frame.rows, frame.cols, 3});
    for (int row = 0; row < frame.rows; ++row)
      std::copy_n(frame.ptr(row), 3 * frame.cols, array.mutable_data(row, 0, 0));
    return array;
  }

  /// The 54 numbers of the dynamics' state: q, u, activations, fibre lengths.
  py::array_t<double> state(int runner) {
    const simulation::RunnerState& state = runners_.environment(runner).engine().state();
    py::array_t<double> array(2 * simulation::kCoordinates + 2 * simulation::kMuscles);
    double* to = array.mutable_data();
    to = std::ranges::copy(state.q, to).out;
    to = std::ranges::copy(state.u, to).out;
    to = std::ranges::copy(state.activation, to).out;
    std::ranges::copy(state.fiber_length_m, to);
    return array;
  }

  const Runners& runners() const { return runners_; }

 private:
  void bound() const { require(!owner_.is_none(), "runners: bind() their arrays first"); }

  static std::string shape_of(const py::array& array) {
    return py::str(array.attr("shape")).cast<std::string>();
  }

  Runners runners_;
  StepArrays arrays_;
  py::object owner_ = py::none();  // keeps the arrays alive
  std::optional<film::FilmModel> film_;
};

RunnersOptions runners_options(const py::dict& given) {
  RunnersOptions o;
  std::string rules = "clean";
  std::optional<std::filesystem::path> reference;
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    try {
      if (name == "engine")
        o.runner.engine = value.cast<std::string>();
      else if (name == "rules")
        rules = value.cast<std::string>();
      else if (name == "difficulty")
        o.runner.difficulty = value.cast<int>();
      else if (name == "max_obstacles")
        o.runner.max_obstacles = value.cast<int>();
      else if (name == "accuracy")
        o.runner.accuracy = value.cast<double>();
      else if (name == "max_steps")
        o.runner.max_steps = value.cast<int>();
      else if (name == "reference")
        reference = value.cast<std::filesystem::path>();
      else if (name == "reference_share")
        o.runner.reference_share = value.cast<double>();
      else if (name == "model")
        o.model = value.cast<std::filesystem::path>().string();
      else if (name == "observation")
        o.observation = value.cast<std::string>();
      else if (name == "action_repeat")
        o.action_repeat = value.cast<int>();
      else if (name == "potential")
        o.potential = value.cast<Potential>();
      else if (name == "n")
        o.count = value.cast<int>();
      else if (name == "threads")
        o.threads = value.cast<int>();
      else
        throw Error(fmt::format("{}: unknown option", name));
    } catch (const py::cast_error&) {
      throw Error(
          fmt::format("{} = {}: is of the wrong type", name, py::repr(value).cast<std::string>()));
    }
  }
  o.runner.rules = competition::rules_named(rules);
  if (reference) o.runner.reference = load_calibrated(*reference);
  return o;
}

/// Writes a film of pictures [n, height, width, 3], RGB.
void write_film(const std::filesystem::path& file, const py::iterable& pictures, double rate_hz) {
  video::VideoWriter writer(file, rate_hz);
  for (const py::handle& each : pictures) {
    const auto picture =
        py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>::ensure(each);
    require(picture && picture.ndim() == 3 && picture.shape(2) == 3,
            "write_film: a picture is needed: uint8 [height, width, 3], RGB");
    const cv::Mat rgb(static_cast<int>(picture.shape(0)), static_cast<int>(picture.shape(1)),
                      CV_8UC3, const_cast<std::uint8_t*>(picture.data()));
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    writer.write(bgr);
  }
  writer.finish();
}

}  // namespace

PYBIND11_MODULE(_stride, module) {
  py::register_exception<Error>(module, "Error", PyExc_ValueError);
  module.attr("version") = version();
  module.def("data_file", &data_file, py::arg("path"));
  module.def("write_film", &write_film, py::arg("file"), py::arg("pictures"),
             py::arg("rate_hz") = 50.0);
  bind_potential(module);
  bind_policy(module);
  py::class_<BoundRunners>(module, "Runners")
      .def(py::init([](const py::dict& options) {
        return std::make_unique<BoundRunners>(runners_options(options));
      }))
      .def("bind", &BoundRunners::bind, py::arg("arrays"))
      .def("reset", &BoundRunners::reset, py::arg("seed"))
      .def("reset_one", &BoundRunners::reset_one, py::arg("runner"), py::arg("seed"))
      .def("step", &BoundRunners::step, py::arg("actions"))
      .def("picture", &BoundRunners::picture, py::arg("runner"), py::arg("width_px"),
           py::arg("height_px"))
      .def("state", &BoundRunners::state, py::arg("runner"))
      .def_property_readonly("observation_names",
                             [](const BoundRunners& o) { return o.runners().observation_names(); })
      .def_property_readonly("action_names",
                             [](const BoundRunners& o) { return o.runners().action_names(); });
}

}  // namespace stride::python
