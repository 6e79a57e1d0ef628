#pragma once

#include <pybind11/pybind11.h>

namespace stride::python {

/// stride.Potential: Φ, targets and shaping rewards of many states at once.
void bind_potential(pybind11::module_& module);

/// stride.Policy: the actions of a trained agent for many states at once.
void bind_policy(pybind11::module_& module);

}  // namespace stride::python
