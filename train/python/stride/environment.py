"""One runner."""

import numpy

from ._stride import Error, Runners
from .arrays import bound_arrays
from .spaces import spaces_of

try:
    from gymnasium import Env
except ImportError:

    class Env:
        """What Gymnasium's base class offers and this environment uses."""

        spec = None

        @property
        def unwrapped(self):
            return self

        def __enter__(self):
            return self

        def __exit__(self, *_):
            self.close()


class StrideEnv(Env):
    """ "Learning to Run": 18 muscles, an action is the excitation of each in [0, 1] for 0.01 s.

    Options, by keyword:

    rules            "clean", or "nips2017": the competition with its oddities
    difficulty       0 flat; 1 obstacles; 2 obstacles and weak muscles
    max_obstacles    3
    engine           "planar", or "simbody": the reference, slower
    accuracy         1e-3, of the integration
    max_steps        1000
    observation      "competition": its 41 values; "all"; "agent": the features of Stride's agents
    action_repeat    1
    reference        calibrated run (.calibrated.csv) on which episodes start
    reference_share  1, share of the episodes that do
    potential        Potential: `info` then has phase and phi; the observation of an agent the phase
    model            .osim instead of the model of the competition

    reset(seed=s) starts the episode that the C++ environment gives for s, bit by bit. Without a
    seed the next episode is drawn from `np_random`, which reset(seed=s) seeds.

    `info` has `forward` and `ligament`, the parts of the reward; `distance_m` and `time_s` since
    the reset; `failed`, whether the state could not be integrated; `phase`, `phi`.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 100}

    def __init__(self, render_mode=None, width_px=640, height_px=360, **options):
        if render_mode not in (None, "rgb_array"):
            raise Error(f"render_mode = {render_mode!r}: must be None or 'rgb_array'")
        for name in ("n", "threads"):
            if name in options:
                raise Error(f"{name}: unknown option; StrideVectorEnv has it")
        self.render_mode = render_mode
        self._size_px = width_px, height_px
        self._runners = Runners(options)
        self._arrays = bound_arrays(self._runners, 1)
        self.observation_space, self.action_space = spaces_of(self._runners)
        self.observation_names = self._runners.observation_names
        self.action_names = self._runners.action_names
        self.metadata = dict(self.metadata, render_fps=100 / options.get("action_repeat", 1))
        self._np_random = None
        self._running = self._started = False

    @property
    def np_random(self):
        if self._np_random is None:
            self._np_random = numpy.random.default_rng()
        return self._np_random

    @np_random.setter
    def np_random(self, value):
        self._np_random = value

    def reset(self, *, seed=None, options=None):
        if options:
            raise Error(f"reset: options {options}: there are none; give them to StrideEnv()")
        if seed is not None:
            if not 0 <= int(seed) < 2**64:
                raise Error(f"seed = {seed}: must be in [0, 2**64)")
            self._np_random = numpy.random.default_rng(int(seed))
            self._np_random_seed = int(seed)
        else:
            seed = self.np_random.integers(2**63)
        self._runners.reset_one(0, int(seed))
        self._running = self._started = True
        return self._arrays["observations"][0].copy(), self._info()

    def step(self, action):
        if not self._running:
            raise Error("step: call reset() first, also after the end of an episode")
        self._runners.step(action)
        arrays = self._arrays
        terminated = bool(arrays["terminated"][0])
        truncated = bool(arrays["truncated"][0])
        self._running = not (terminated or truncated)
        reward = float(arrays["rewards"][0])
        return arrays["observations"][0].copy(), reward, terminated, truncated, self._info()

    def _info(self):
        arrays = self._arrays
        return {
            "forward": float(arrays["forward"][0]),
            "ligament": float(arrays["ligament"][0]),
            "distance_m": float(arrays["distance_m"][0]),
            "time_s": float(arrays["time_s"][0]),
            "failed": bool(arrays["failed"][0]),
            "phase": float(arrays["phase"][0]),
            "phi": float(arrays["phi"][0]),
        }

    @property
    def pose(self):
        """What a potential compares: pelvis height, then x, y of both knees and feet, m."""
        return self._arrays["pose"][0].copy()

    @property
    def state(self):
        """All 54 numbers of the dynamics: q, u, activations, fibre lengths."""
        return self._runners.state(0)

    def render(self):
        """The runner from its right side, uint8 [height, width, 3]."""
        if self.render_mode is None:
            return None
        if not self._started:
            raise Error("render: call reset() first")
        return self._runners.picture(0, *self._size_px)

    def close(self):
        pass
