"""Box as in Gymnasium, for where that is not installed."""

import numpy

try:
    from gymnasium.spaces import Box
except ImportError:

    class Box:
        """All arrays of a shape between two bounds."""

        def __init__(self, low, high, shape=None, dtype=numpy.float64, seed=None):
            if shape is None:
                shape = numpy.shape(low)
            self.dtype = numpy.dtype(dtype)
            self.shape = tuple(shape)
            self.low = numpy.broadcast_to(numpy.asarray(low, self.dtype), self.shape)
            self.high = numpy.broadcast_to(numpy.asarray(high, self.dtype), self.shape)
            self.seed(seed)

        def seed(self, seed=None):
            self.np_random = numpy.random.default_rng(seed)
            return seed

        def sample(self):
            """Uniform where both bounds are finite, else normal."""
            finite = numpy.isfinite(self.low) & numpy.isfinite(self.high)
            uniform = self.np_random.uniform(
                numpy.where(finite, self.low, 0), numpy.where(finite, self.high, 1)
            )
            normal = self.np_random.standard_normal(self.shape)
            return numpy.where(finite, uniform, normal).astype(self.dtype)

        def contains(self, x):
            x = numpy.asarray(x)
            return (
                x.shape == self.shape
                and numpy.can_cast(x.dtype, self.dtype)
                and bool(numpy.all(x >= self.low) and numpy.all(x <= self.high))
            )

        def __contains__(self, x):
            return self.contains(x)

        def __eq__(self, other):
            return (
                isinstance(other, Box)
                and self.shape == other.shape
                and bool(numpy.all(self.low == other.low) and numpy.all(self.high == other.high))
            )

        def __repr__(self):
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"


def spaces_of(runners):
    """Observation and action space of one runner."""
    observed = len(runners.observation_names)
    return (
        Box(-numpy.inf, numpy.inf, (observed,), numpy.float64),
        Box(0.0, 1.0, (len(runners.action_names),), numpy.float64),
    )
