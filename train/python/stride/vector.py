"""Many runners."""

import numpy

from ._stride import Error, Runners
from .arrays import bound_arrays
from .spaces import Box, spaces_of

try:
    from gymnasium.vector import AutoresetMode, VectorEnv

    NEXT_STEP = AutoresetMode.NEXT_STEP
except ImportError:
    VectorEnv, NEXT_STEP = object, "NextStep"


class StrideVectorEnv(VectorEnv):
    """n runners that step side by side in `threads` threads (0: one a core), without the GIL.

    The arrays that reset() and step() return, `infos` included, are written anew by the next call:
    copy what is to be kept. After the end of an episode the next step ignores that runner's action
    and starts its next episode (Gymnasium's AutoresetMode.NEXT_STEP).

    After reset(seed=s) runner i lives through the episodes of the seeds s + i, s + i + n,
    s + i + 2 n, ...: each is what StrideEnv.reset(seed=...) gives. Options as of StrideEnv.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 100, "autoreset_mode": NEXT_STEP}

    def __init__(self, num_envs=None, threads=0, n=None, render_mode=None, **options):
        if n is None:
            n = 1 if num_envs is None else num_envs
        if render_mode not in (None, "rgb_array"):
            raise Error(f"render_mode = {render_mode!r}: must be None or 'rgb_array'")
        self.render_mode = render_mode
        self._runners = Runners(dict(options, n=n, threads=threads))
        self.num_envs = n
        self.single_observation_space, self.single_action_space = spaces_of(self._runners)
        self.observation_names = self._runners.observation_names
        self.action_names = self._runners.action_names
        self.observation_space = self._batched(self.single_observation_space)
        self.action_space = self._batched(self.single_action_space)
        self._arrays = bound_arrays(self._runners, n)
        self.infos = {
            name: self._arrays[name]
            for name in ("forward", "ligament", "distance_m", "time_s", "failed", "phase", "phi")
        }
        self._started = False

    def _batched(self, space):
        shape = (self.num_envs, *space.shape)
        low, high = numpy.broadcast_to(space.low, shape), numpy.broadcast_to(space.high, shape)
        return Box(low, high, shape, space.dtype)

    def reset(self, *, seed=None, options=None):
        if options:
            raise Error(f"reset: options {options}: there are none; give them to StrideVectorEnv()")
        if seed is None:
            seed = int(numpy.random.default_rng().integers(2**62))
        if isinstance(seed, (list, tuple, numpy.ndarray)):
            if len(seed) != self.num_envs:
                raise Error(f"seed: {len(seed)} seeds, {self.num_envs} are needed, or one")
            for i, each in enumerate(seed):
                self._runners.reset_one(i, int(each))
        else:
            if not 0 <= int(seed) < 2**64:
                raise Error(f"seed = {seed}: must be in [0, 2**64)")
            self._runners.reset(int(seed))
        self._started = True
        return self._arrays["observations"], self.infos

    def step(self, actions):
        if not self._started:
            raise Error("step: call reset() first")
        self._runners.step(actions)
        arrays = self._arrays
        return (
            arrays["observations"],
            arrays["rewards"],
            arrays["terminated"],
            arrays["truncated"],
            self.infos,
        )

    @property
    def poses(self):
        """What a potential compares, a row a runner."""
        return self._arrays["pose"]

    def render(self):
        """A picture of each runner."""
        if self.render_mode is None:
            return None
        return tuple(self._runners.picture(i, 640, 360) for i in range(self.num_envs))

    def close(self, **_):
        pass
