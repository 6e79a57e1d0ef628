"""The arrays that the runners write into."""

import numpy

REALS = ("rewards", "forward", "ligament", "distance_m", "time_s", "phase", "phi")
FLAGS = ("terminated", "truncated", "failed")


def bound_arrays(runners, count):
    """A row, or an element, a runner."""
    arrays = {name: numpy.zeros(count) for name in REALS}
    arrays.update({name: numpy.zeros(count, bool) for name in FLAGS})
    arrays["observations"] = numpy.zeros((count, len(runners.observation_names)))
    arrays["pose"] = numpy.zeros((count, 9))
    runners.bind(arrays)
    return arrays
